"""A short life of a player, played by a script, that shows every screen of the game: for the recorded screens."""

import shutil
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import replace
from datetime import date
from pathlib import Path
from random import Random
from threading import Thread
from typing import Self
from unittest.mock import Mock, patch

import numpy as np
import pygame
from numpy.typing import NDArray

from ninja_game import __version__
from ninja_game.editor.files import Source, draft_of
from ninja_game.editor.playtests import PlaytestMap
from ninja_game.editor.solver import Certification
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.files.bundled import CHECKOUT, bundled_replays
from ninja_game.files.user_folder import STAMPS
from ninja_game.formats.load import load_replays
from ninja_game.formats.named_level import parse_levels
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.lab.screen import LabScreen
from ninja_game.play.level.screen import LevelScreen, PausePanel
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menus.daily import DailyScreen
from ninja_game.play.menus.good_levels import GoodLevelsScreen
from ninja_game.play.menus.pack_list import PackList
from ninja_game.play.menus.packs import PackScreen
from ninja_game.play.panels.help import HelpScreen
from ninja_game.play.panels.replays import ReplaysScreen
from ninja_game.play.panels.settings import SettingsScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.sim.grid import cell_of
from ninja_game.sim.kinds import GOLD, MINE, NINJA
from ninja_game.sim.level import ObjectSpec
from tests.support.draw_log import DrawLog
from tests.support.level_maker import ROOM, examine
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import PACK, instead_of_ours
from tests.support.waiting import LONGEST

RANGE = """ninja-game level 1
name: Target practice
author: nobody
|@..........L...................|
|###............................|
|...............................|
|...........C...................|
|...............................|
|...............................|
|...............................|
|...............................|
|...............................|
|...................+..........4|
|...............................|
|...............................|
|..............................7|
|...............................|
|....Z...................Q......|
|...............................|
|...............................|
|...............................|
|...............................|
|...........................X...|
|.........x.....................|
|...............................|
|###############################|
laser drone 12,1 alternating left
chaingun drone 12,4 alternating left
gauss turret 20,10
homing launcher 25,15
zap drone 5,15 surface-cw right seeker
exit 28,20 switch 10,21
"""
"""A level in which everything that shoots sees the ninja."""

WITHOUT_CHANCE = ("ninja_game.play.main_menu.Random", "ninja_game.play.level.level_play.Random")
DATE = "2026-02-03T04:05:06+00:00"


def always_alike() -> list[object]:
    """Patches that take chance, the date, our levels and threads out of the screens; start them before the program."""
    patches = [patch(name, lambda seed=None: Random(seed or 1)) for name in WITHOUT_CHANCE]
    return [
        instead_of_ours(), *patches, patch("ninja_game.player.records.now_text", lambda: DATE),
        patch("ninja_game.runtime.run_in_background", lambda work, _: work()),
        patch("ninja_game.editor.examination.EXAMINATION_SPACING", 0.0),
    ]  # fmt: skip


def tour(driver: MenuDriver) -> Iterator[str]:
    """Go from screen to screen; the name of each, when it is shown."""
    yield from _first_steps(driver)
    yield from _an_episode(driver)
    yield from _levels(driver)
    yield from _records_and_replays(driver)
    yield from _settings(driver)
    yield from _help(driver)
    yield from _lab(driver)
    yield from _editor(driver)
    yield from _daily(driver)
    yield from _film(driver)
    yield from _packs(driver)


def home(driver: MenuDriver) -> None:
    """Back to the main menu, with no notice left."""
    driver.app.notify("")
    for _ in range(10):
        if isinstance(driver.top(), MainMenu):
            return
        # From a paused level escape leads back into it.
        driver.press("q" if isinstance(driver.top(), PausePanel) else "escape")
    raise AssertionError(f"no way home from {driver.top()}")


def _first_steps(driver: MenuDriver) -> Iterator[str]:
    """Everything as a new player sees it."""
    driver.frames(90)
    yield "main-menu"
    driver.press("escape")
    yield "leave-the-game"
    driver.press("escape")
    driver.open("Records")
    yield "records-empty"
    home(driver)
    driver.open("Play")
    driver.press("tab")
    yield "boss"
    driver.press("tab", "q")


def _an_episode(driver: MenuDriver) -> Iterator[str]:
    """The first episode, with a pause and a death on the way."""
    driver.open("Episodes")
    driver.frames(8)
    yield "episodes-new"
    driver.press("down")
    yield "episodes-locked"
    driver.press("up", "return")
    driver.frames(40)
    yield "ready-first-time"
    driver.press("space")
    driver.frames(30)
    driver.press("p")
    yield "paused"
    driver.press("p")
    driver.press("k")
    driver.frames(5)
    yield "dead"
    driver.frames(60)
    yield "dead-message"
    driver.press("space", "space", "k")
    driver.frames(20)
    driver.press("space")
    for number in range(1, 6):
        level = driver.shown(LevelScreen)
        if number == 4:
            driver.app.change_settings(show_keys=True)
            level.begin()
            driver.keys.script = [2] * 60
            driver.frames(60)
            yield "playing-with-keys"
            driver.app.change_settings(show_keys=False)
            level.retry()
        level.begin()
        driver.play_replay(number)
        driver.frames(20)
        if number in (1, 5):
            yield "passed" if number == 1 else "passed-last-of-episode"
        driver.press("space")
    driver.frames(6)
    yield "episode-passed"
    driver.frames(9, 400)
    yield "episode-passed-with-its-medal"
    driver.press("escape")
    driver.frames(6)
    yield "episodes-one-passed"


def _levels(driver: MenuDriver) -> Iterator[str]:
    """The browser, a ghost, practice, things that shoot, little time."""
    (driver.player.folder / "levels" / "target.txt").write_text(RANGE)
    (driver.player.folder / "levels" / "broken.txt").write_text("ninja-game level 1\nnonsense")
    home(driver)
    rich = driver.player.catalogue.episodes[0].levels[0]
    driver.player.marks.passed(rich.digest, 900, rich.all_gold)
    driver.open("Levels")
    driver.press("down")
    driver.frames(20)
    yield "levels"
    driver.press("return", "space")
    driver.frames(45)
    yield "playing-with-a-ghost"
    level = driver.shown(LevelScreen)
    level.attempt.lifetime = 150
    level.play.shown_lifetime = 150.0
    yield "playing-in-danger"
    driver.press("p", "q")
    driver.press("up", "up")
    driver.type("target")
    driver.frames(4)
    yield "levels-found"
    driver.type("zz")
    yield "levels-none-found"
    driver.press("backspace", "backspace", "down", "return")
    driver.shown(LevelScreen).begin()
    for ticks in (25, 20, 15, 45):
        driver.frames(ticks)
        yield f"shooting-{driver.shown(LevelScreen).attempt.simulation.tick}"
        if ticks == 20:
            driver.press("4")
            yield "shooting-rays"
            driver.press("4")
            driver.app.change_settings(sound_cues=True)
            yield "shooting-with-marks-for-sounds"
            driver.app.change_settings(sound_cues=False)
    driver.press("escape")
    home(driver)
    driver.open("Levels")
    driver.press("down", "right", "right", "return", "space")
    driver.frames(20)
    driver.press("f5")
    yield "practice"
    for key in "123456":
        driver.press(key)
    yield "practice-overlays"
    home(driver)


def _records_and_replays(driver: MenuDriver) -> Iterator[str]:
    """What was played."""
    driver.open("Records")
    yield "records"
    home(driver)
    _replays(driver)
    yield "replays-none"
    home(driver)
    driver.earn_gold()
    _replays(driver)
    yield "replays"
    driver.press("delete")
    yield "replays-delete"
    home(driver)
    _replays(driver)
    driver.press("return")
    driver.frames(80)
    yield "replay"
    driver.press("p", "equals")
    yield "replay-paused"
    home(driver)


def _replays(driver: MenuDriver) -> None:
    """The list of replays with all its files, which it reads while pictures are shown."""
    screen = driver.opened("Replays", ReplaysScreen)
    screen._read_files(LONGEST)
    screen._arrange()
    screen.redraw = True  # what a busy machine reads only now is as new as what it reads for a picture
    driver.frames()


def _settings(driver: MenuDriver) -> Iterator[str]:
    """Every page, a slider with the focus, a press that is waited for, a key that is taken."""
    driver.open("Settings")
    for page in driver.shown(SettingsScreen).titles:
        driver.settings_page(page)
        yield f"settings-{page.lower()}"
    driver.settings_page("Keyboard")
    driver.press("return")
    yield "settings-press-a-key"
    driver.press("r")
    yield "settings-key-taken"
    home(driver)


def _help(driver: MenuDriver) -> Iterator[str]:
    """Every page, at the moment when its subject has just happened."""
    screen = driver.opened("Help", HelpScreen)
    for index, topic in enumerate(screen.topics):
        screen.list.select(index)
        demonstration = screen.demonstration
        if topic == "Gauss turrets":
            for _ in range(40):
                screen.update(25)
            yield "help-gauss-turrets-aiming"
        if demonstration is not None:
            for _ in range(len(demonstration.page.inputs)):
                screen.update(25)
                happened = {event.name for event in demonstration.simulation.events}
                if happened & set(demonstration.page.shows):
                    break
            for _ in range(3):
                screen.update(25)
        yield f"help-{topic.lower().replace(' ', '-')}"
    home(driver)


def _lab(driver: MenuDriver) -> Iterator[str]:
    """Every figure, a second into its demonstration."""
    driver.open("Help")
    driver.choose("How it works")
    screen = driver.shown(LabScreen)
    for index, figure in enumerate(screen.figures):
        screen.list.select(index)
        driver.frames(40)
        yield f"lab-{figure.name}"
    home(driver)


def _editor(driver: MenuDriver) -> Iterator[str]:
    """A level in the editor, with problems, something in hand, something selected; its panels."""
    screen = driver.opened("Editor", EditorScreen)
    draft = draft_of(parse_levels(RANGE)[0])
    gold = tuple(ObjectSpec(GOLD, (300.0 + 12 * k, 200.0)) for k in range(5))
    draft = with_stamp(
        draft, Stamp({(8, 12): 7, (9, 12): 1, (10, 12): 6, (12, 17): 1}, (*gold, ObjectSpec(MINE, (300.0, 420.0))))
    )
    screen.session.begin(Source(draft))
    examine(screen)
    driver.frames(3)
    yield "editor"
    driver.press("shift+k", "m")
    driver.mouse(500, 300)
    driver.mouse(520, 330, click=False)
    yield "editor-placing-a-switch"
    driver.press("escape", "m", "m", "m", "m", "f4")
    yield "editor-selected"
    driver.press(*["escape"] * 3)
    yield "editor-menu"
    driver.press("escape", "f2")
    yield "editor-about"
    driver.press("escape")
    yield from _messages(driver, screen)
    driver.press("f1")
    yield "editor-help"
    driver.press("escape")
    screen.session.close()
    driver.app.pop()
    yield from _editor_states(driver)


def _messages(driver: MenuDriver, screen: EditorScreen) -> Iterator[str]:
    """Four messages, all that a level has, where two of them are shown, and a place beside the start in play."""
    messages = "start: {jump} jumps | switch: Now the exit | at 9,20: Mind the mine | death 3: Wait"
    tools = screen.session.tools
    tools.history.change(replace(tools.draft, says=messages))
    driver.frames(2)
    yield "editor-messages-in-the-level"
    driver.chord("m", pygame.KMOD_SHIFT)
    driver.frames(2)
    yield "editor-messages"
    driver.press("escape")
    column, row = cell_of(*next(each.values[:2] for each in tools.draft.level.objects if each.kind == NINJA))
    tools.history.change(replace(tools.draft, says=f"start: {{jump}} jumps | at {column},{row}: Mind the mine"))
    driver.press("f5", "space")
    driver.frames(5)
    yield "editor-test-with-two-messages"
    driver.press("escape")
    for _ in range(2):
        tools.undo()


def _editor_states(driver: MenuDriver) -> Iterator[str]:
    """Symmetry under the mouse, a certificate and a stale one, a test, the choice of a level, what is not saved."""
    screen = driver.opened("Editor", EditorScreen)
    screen.session.begin(Source(ROOM))
    driver.frames(2)
    for name, tile in (("tiles", True), ("objects", False)):
        for symmetry in ("left-right", "both"):
            screen.session.tools.brush.symmetry = symmetry
            screen.session.tools.pick_up(8 if tile else ObjectSpec(GOLD, (0.0, 0.0)))
            driver.mouse(200, 160, click=False)
            yield f"editor-symmetry-{symmetry}-{name}"
    screen.session.tools.brush.symmetry = "off"
    certifier = screen.session.certifier
    yield "editor-not-certified"
    run = replace(load_replays(bundled_replays()[0])[0].replay, final_tick=156, gold=0)
    route = ((60.0, 542.0), (120.0, 500.0), (180.0, 540.0))
    certifier.certification = Certification(screen.session.draft.level, run, route, end="done")
    yield "editor-certified"
    driver.mouse(300, 300)
    driver.frames()
    yield "editor-stale-certificate"
    certifier.certification = Certification(route=route)
    driver.press("f5")
    driver.frames(12)
    yield "editor-test"
    driver.press("escape")
    screen.session.add_playtest(screen.session.draft.level, bytes(3), over=True)
    maps = screen.session.edited.playtests.maps
    maps.finish()
    maps.result = PlaytestMap({(2, 22): 2, (3, 22): 1}, ((108.0, 540.0), (132.0, 540.0)))
    driver.press("f9")
    yield "editor-tests"
    driver.press("f9", "f3")
    yield "editor-list"
    stamps = driver.player.folder / STAMPS
    stamps.mkdir()
    (stamps / "range.txt").write_text(RANGE)
    driver.press("f3", "p", "down")
    yield "editor-stamps"
    driver.press("escape")
    with patch.dict(CHECKOUT, levels=PACK.parent.parent / "levels"):
        driver.app.push(GoodLevelsScreen(driver.app, lambda _: None))
        driver.frames(4)
        yield "good-levels"
    driver.press("escape")
    screen.commands.leave()
    driver.frames()
    yield "editor-leave-unsaved"
    driver.press("escape")
    screen.commands.save_as()
    driver.frames()
    yield "editor-save-as"
    driver.press("escape")
    screen.session.tools.history.change(screen.session.edited.source.draft)
    screen.commands.open()
    driver.frames(20)
    yield "editor-open"
    driver.press("escape")
    screen.session.close()
    driver.app.pop()


def _packs(driver: MenuDriver) -> Iterator[str]:
    """No pack of the player's; then one with a changed level, something dragged, its problems."""
    home(driver)
    driver.open("Levels")
    driver.choose("Packs")
    driver.frames(3)
    yield "packs-none"
    folder = driver.player.folder / "levels" / "laundry"
    shutil.copytree(PACK, folder, ignore=shutil.ignore_patterns("gallery", "README.md"))
    index, level = folder / "pack.toml", folder / "00-1-stone-to-stone.txt"
    index.write_text(index.read_text("utf-8").replace("test pack", "Laundry").replace('-go.txt", "', '", "'), "utf-8")
    level.write_text(level.read_text("utf-8").replace("@", ".@", 1).replace(".@.", ".@", 1), "utf-8")
    screen = driver.shown(PackScreen)
    screen.enter()
    driver.frames(30)
    driver.wait(lambda: screen.status.present, "the problems are known")
    driver.frames(2)
    yield "packs"
    driver.app.push(PackList(driver.app, screen.own_packs, screen.show))
    driver.frames(30)
    yield "packs-list"
    driver.press("escape")
    driver.choose("Preview")
    driver.frames(30)
    yield "packs-preview"
    driver.press("escape")
    (folder / "received").touch()
    screen.enter()
    driver.frames(30)
    yield "packs-card"
    (folder / "received").unlink()
    screen.enter()
    driver.wait(lambda: screen.status.present, "the problems are known")
    driver.frames(2)
    driver.carry(screen.shelves.row_area(2), screen.shelves.row_area(9), drop=False)
    yield "packs-dragging"
    driver.press("escape")
    driver.mouse_up()
    driver.carry(screen.shelves.row_area(0), screen.shelves.row_area(6), drop=False)
    yield "packs-dragging-an-episode"
    driver.press("escape")
    driver.mouse_up()
    packer = screen.packer
    packer.path, packer.is_busy, packer._step = folder, True, ("Certifying, 3 of 8 levels done", 0.375, 0.0)
    with patch.object(type(packer.job), "is_idle", False):
        driver.frames(2)
        yield "packs-making-ready"
    packer.is_busy, packer.text = False, ""
    driver.frames(2)
    driver.mouse(*screen.shelves.row_area(1)[:2], click=False)
    driver.press("right", "return")
    yield "packs-level-menu"
    driver.press("escape")
    driver.choose("Problems")
    yield "packs-problems"
    driver.choose("Accept it...")
    yield "packs-accept"
    driver.press("escape")
    home(driver)
    shutil.rmtree(folder)


def _daily(driver: MenuDriver) -> Iterator[str]:
    """A day whose level is made, fails, is there, was passed."""
    endless = Mock(is_alive=lambda: True)
    with ExitStack() as stack:
        stack.enter_context(patch("ninja_game.play.menus.daily.date", Today))
        stack.enter_context(patch("ninja_game.play.menus.daily.run_in_background", lambda *_: endless))
        screen = driver.opened("Daily", DailyScreen)
        maker = screen.maker
        assert maker is not None
        maker.progress = "level 3 of 8"
        driver.frames()
        yield "daily-being-made"
        maker.problem = "No level could be made for today: No space left"
        endless.is_alive = lambda: False
        driver.frames(2)
        yield "daily-problem"
        home(driver)
        pack = screen.file.parent
        pack.mkdir(parents=True)
        for name in ("pack.toml", "pars.toml", "00-0-run-and-hop.txt"):
            text = (PACK / name).read_text("utf-8").replace("00-0-run-and-hop.txt", screen.file.name)
            (pack / name.replace("00-0-run-and-hop.txt", screen.file.name)).write_text(text, "utf-8")
        screen = driver.opened("Daily", DailyScreen)
        assert screen.entry is not None
        yield "daily"
        driver.player.marks.passed(screen.entry.digest, 170, 1)
        driver.frames(2)
        yield "daily-passed"
        home(driver)


def _film(driver: MenuDriver) -> Iterator[str]:
    """A film that is being made of a replay."""
    with patch("ninja_game.play.replay.film.run_in_background", lambda *_: Thread()):
        screen = ReplayScreen(driver.app, [load_replays(bundled_replays()[1])[0]])
        driver.app.push(screen)
        driver.frames(40)
        driver.press("e")
        assert screen.export is not None
        screen.export._count, screen.export._made = 200, 90
        yield "replay-making-a-film"
        screen.export.result, screen.export.done = "No film: there is not enough memory", True
        driver.frames()
        yield "replay-no-film"
        driver.app.notify("")
        driver.press("g")
        driver.app.pop()


Tour = Callable[[MenuDriver], Iterator[str]]  # goes from screen to screen; the name of each, when it is shown


class Today(date):
    """A calendar that stands still."""

    @classmethod
    def today(cls) -> Self:
        return cls(2026, 11, 23)


def run_tour(folder: Path, size: tuple[int, int], show: Callable[[MenuDriver, str], None], steps: Tour = tour) -> None:
    """Play a whole tour in an empty folder of a player's; ``show`` is called at each screen."""
    patches = always_alike()
    for each in patches:
        each.start()  # type: ignore[attr-defined]
    driver = MenuDriver(folder, size)
    try:
        pygame.event.clear()
        for name in steps(driver):
            show(driver, name)
    finally:
        driver.close()
        for each in patches:
            each.stop()  # type: ignore[attr-defined]


def _pixels(surface: pygame.Surface) -> NDArray[np.uint8]:
    """The px of a surface; nothing of one of the page's."""
    return pygame.surfarray.array3d(surface) if "surfarray" in vars(pygame) else np.zeros(1, np.uint8)


def screens_as_texts(
    folder: Path, size: tuple[int, int] = (792, 600), steps: Tour = tour, log: DrawLog | None = None
) -> dict[str, str]:
    """What is drawn on each screen of a tour, by its name; in an empty folder of a player's."""
    log = log or DrawLog()
    shown: dict[str, str] = {}

    def show(driver: MenuDriver, name: str) -> None:
        with log.noting_calls():
            driver.app.draw()
        by_steps = _pixels(driver.app.surface)
        driver.app.stack.redraw_all()
        with log.recording(driver.app.theme.palette) as lines:
            driver.app.draw()
        # A line that is cut off may differ by one where it is smoothed.
        redrawn = _pixels(driver.app.surface)
        changed = redrawn != by_steps
        differing = np.argwhere(changed)[abs(redrawn[changed].astype(int) - by_steps[changed]) > 3]
        if len(differing):
            log.stale.append(f"{name}, px {differing.min(0)} to {differing.max(0)}")
        assert name not in shown
        shown[name] = "\n".join(lines).replace(str(folder), "FOLDER").replace(__version__, "VERSION") + "\n"

    with log.installed():
        run_tour(folder, size, show, steps)
    return shown
