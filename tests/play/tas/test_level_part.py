"""The level on the TAS editor: any tick exact, ways and ghosts, playing, other runs."""

import re
from dataclasses import replace
from functools import partial
from pathlib import Path
from random import Random
from shutil import copy

import numpy as np
import pygame
import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.errors import ReplayError
from ninja_game.files.bundled import bundled_replays
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.demo import write_demo
from ninja_game.formats.recording import Recording
from ninja_game.formats.run_time import seconds_text
from ninja_game.play.menu_screen import FormPanel
from ninja_game.play.replay.screen import SPEEDS, ReplayScreen
from ninja_game.runs.compare import SPEED_AHEAD
from ninja_game.sim.inputs import KEY_LEFT, KEY_RIGHT, Demo, with_press_bits
from ninja_game.tas.files import open_run, runs_of_level
from ninja_game.tas.goals import PRESETS
from ninja_game.tas.timeline import Timeline, difference_text
from ninja_game.tas.tracks import InputTrack
from ninja_game.tas_editor.level.other_runs import OtherRunScreen, RunFiles
from ninja_game.tas_editor.level.part import nearest_tick, object_at
from ninja_game.tas_editor.level.paths import shown_span
from ninja_game.tas_editor.screen import TasScreen
from ninja_game.tas_editor.tabs.search_tab import SearchTab
from ninja_game.tas_editor.tabs.tab import LitButton
from ninja_game.tas_editor.tabs.values_tab import ValuesTab
from tests.support.own_pack import PACK
from tests.support.samples import SPIKED, WALK, WALK_END, running, write_records
from tests.support.tas_driver import TasDriver

RUN = PACK / "certificates" / "01-2-no-hurry.exit.replay.txt"


@pytest.fixture
def run() -> Path:
    return RUN


def test_any_tick_is_that_of_a_straight_run_after_any_edits(at: TasDriver) -> None:
    editor, rng = at.editor, Random(7)
    for _ in range(40):
        if rng.random() < 0.5:
            first = rng.randrange(len(editor.track))
            keys = [rng.randrange(8) for _ in range(rng.randrange(1, 30))]
            edited = editor.track.replaced(first, first + rng.randrange(9), keys)
            assert editor.attempt(partial(at.session.change, edited))
            at.frames()
            assert at.shown_digest() == at.straight_digest(editor.cursor), "the cursor stays, the run is another"
        editor.go(rng.choice([rng.randrange(editor.last_tick + 1), editor.cursor + rng.randrange(-3, 4)]))
        at.frames()
        assert at.screen.level.picture.tick == editor.cursor
        assert at.shown_digest() == at.straight_digest(editor.cursor)


def test_playing_takes_the_cursor_along_at_the_chosen_speed(at: TasDriver) -> None:
    screen = at.screen
    editor, playing = screen.editor, screen.level.playing
    editor.go(50)
    at.press("space")
    at.frames(11)
    assert 61 <= editor.cursor <= 62
    at.press("equals")
    at.frames(1)
    assert SPEEDS[playing.speed] == 2.0
    before = editor.cursor
    at.frames(10)
    assert 19 <= editor.cursor - before <= 21
    at.press("escape")
    at.frames()
    assert not playing.on
    assert at.top() is screen
    before = editor.cursor
    at.frames(5)
    assert editor.cursor == before
    at.press("period")
    at.press("period")
    at.press("comma")
    at.frames()
    assert editor.cursor == before + 1
    assert at.shown_digest() == at.straight_digest(before + 1)


def test_it_stops_at_the_last_tick_and_begins_again(at: TasDriver) -> None:
    screen = at.screen
    editor = screen.editor
    editor.go(editor.last_tick - 3)
    at.press("space")
    at.frames(10)
    assert (editor.cursor, screen.level.playing.on) == (editor.last_tick, False)
    at.press("space")
    at.frames(5)
    assert editor.cursor < 10


def test_playback_waits_for_simulation(at: TasDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(type(at.session), "ticks_per_frame", 0)
    at.session.timeline.simulated_until = 6
    at.press("space")
    at.frames(20)
    assert (at.editor.cursor, at.screen.level.playing.on) == (5, True)


@pytest.mark.parametrize("tick", [0, 90, 200])
def test_a_click_goes_to_the_nearest_tick(at: TasDriver, tick: int) -> None:
    screen = at.screen
    positions = screen.session.timeline.positions
    left, top, *_ = screen.level.area
    factor = screen.level.picture.canvas.scale / at.app.canvas.scale
    place = left + positions[tick, 0] * factor, top + positions[tick, 1] * factor
    at.mouse(*place, click=False)
    hovered = screen.level.hover
    assert hovered is not None
    assert np.hypot(*(positions[hovered] - positions[tick])) < 3
    at.mouse(*place)
    at.mouse(700, 300, click=False)
    assert screen.editor.cursor == hovered
    assert screen.level.hover is None


def test_far_from_the_run_and_behind_its_end_no_tick_is_offered(at: TasDriver) -> None:
    timeline = at.session.timeline
    end, positions = timeline.end[0], timeline.positions
    x, y = positions[-1]
    tick = nearest_tick(positions[: end + 1], float(x), float(y), end, dragged=False)
    assert tick is None or tick <= end
    left, top, *_ = at.screen.level.area
    factor = at.screen.level.picture.canvas.scale / at.app.canvas.scale
    at.mouse(left + x * factor, top + y * factor, click=False)
    assert (at.screen.level.hover or 0) <= end
    corners = [(each, down) for each in (10.0, 780.0) for down in (10.0, 580.0)]
    far = max(corners, key=lambda at: float(np.hypot(*(positions - at).T).min()))
    at.mouse(left + far[0] * factor, top + far[1] * factor)
    assert (at.screen.level.hover, at.editor.cursor) == (None, 0)


def test_the_run_before_the_edit_is_a_ghost_where_it_was_elsewhere(at: TasDriver) -> None:
    screen = at.screen
    editor = screen.editor
    editor.go(150)
    at.frames()
    assert not screen.level.ghosts
    editor.edit(lambda track: track.replaced(100, 160, [1] * 60))
    at.frames()
    assert [ghost.label for ghost in screen.level.ghosts] == [""]
    (ghost,) = screen.level.ghosts
    assert ghost.place(1.0) == tuple(editor.session.before.positions[150])
    at.press("g")
    at.frames()
    assert not screen.level.ghosts
    at.press("g")
    editor.go(80)
    at.frames()
    assert not screen.level.ghosts, "there it was at the same place"


def test_other_runs_are_opened_chosen_and_taken_in(at: TasDriver) -> None:
    screen = at.screen
    editor, mod = screen.editor, pygame.KMOD_LCTRL
    before = editor.track
    at.chord("p", mod)
    at.frames()
    assert editor.track == before
    assert "Ctrl+O" in at.app.notice
    other = before.replaced(100, 140, [2] * 40)
    recording = screen.session.recording(other, "theirs")
    screen.level.others.open([recording, recording])
    at.frames()
    assert len({run.name for run in editor.others}) == 2
    assert len(screen.level.ghosts) == 2
    editor.select(110, 120)
    at.chord("p", mod)
    at.frames()
    assert editor.track.inputs[:110] == before.inputs[:110]
    assert [editor.track.keys_at(tick) for tick in range(110, 120)] == [2] * 10
    assert at.app.notice == f"Ticks 110 to 119 are those of {editor.others[0].name}"
    assert [editor.track.keys_at(k) for k in range(120, 200)] == [before.keys_at(k) for k in range(120, 200)]
    assert screen.session.undo()
    assert editor.track == before
    assert editor.chosen == 0, "the first of them"
    at.press("o")
    at.frames()
    assert editor.chosen == 1


@pytest.mark.parametrize("zoom", [0, 6])
def test_names_of_ghosts_lie_over_no_ninja_and_no_name(at: TasDriver, zoom: int) -> None:
    screen, recording = at.screen, load_replays(RUN)[0]
    screen.level.others.open([recording] * 3)
    at.editor.go(40)
    at.frames(2)
    camera, size = screen.level.picture.camera, screen.level.picture.surface.get_size()
    camera.zoom_at(size, screen.level.picture.canvas.point(*screen.level.picture.place(1.0)), zoom)
    at.frames(2)
    over = screen.level.paths
    assert over is not None
    x, y = screen.level.picture.place(1.0)
    ninja, names = over.canvas.rect(x - 10, y - 10, 20, 20), over.labels[-3:]
    assert len(over.labels) == 2 * len(at.editor.track.markers) + 3
    for number, name in enumerate(names):
        assert name.collidelist([ninja, *names[:number]]) < 0
        assert name.bottom <= ninja.top


def test_the_rest_of_another_run_from_the_nearest_place(at: TasDriver) -> None:
    editor = at.editor
    mine = editor.track
    screen = at.screen
    screen.level.others.open([at.session.recording(mine.replaced(60, 60, [0] * 7), "later")])
    editor.go(120)
    here, there = at.session.timeline.positions[120], editor.others[0].trajectory.positions
    speed = here - at.session.timeline.positions[119]
    faster = np.hypot(*(np.diff(there, axis=0, prepend=there[:1]) - speed).T)
    nearest = int(np.argmin(np.hypot(*(there - here).T) + SPEED_AHEAD * faster))
    editor.go(121)
    at.chord("p", pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT)
    theirs = editor.others[0].track
    assert editor.track.inputs[:121] == mine.inputs[:121]
    assert [editor.track.keys_at(121 + k) for k in range(300)] == [theirs.keys_at(nearest + 1 + k) for k in range(300)]
    assert len(editor.track) == 121 + len(theirs) - nearest - 1
    assert at.app.notice.startswith(f"From tick 121 on {editor.others[0].name} from its tick {nearest + 1} on")


def test_the_rest_of_another_run_from_its_start_has_tick_0_too(at: TasDriver) -> None:
    other = at.editor.track.replaced(0, 5, [KEY_LEFT] * 9)
    at.screen.level.others.open([at.session.recording(other, "left")])
    at.press("home")
    at.chord("p", pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT)
    assert at.editor.track.inputs == other.inputs
    assert at.app.notice == "From tick 0 on left from its tick 0 on, its start. Now: no exit yet"
    at.chord("z", pygame.KMOD_LCTRL)
    assert at.app.notice.startswith("Undone: keys from tick 0 on")


def test_the_beginning_of_another_run_before_the_rest_of_this_one(at: TasDriver) -> None:
    editor, mine = at.editor, at.editor.track
    at.screen.level.others.open([at.session.recording(mine.replaced(60, 60, [0] * 7), "later")])
    other = editor.others[0]
    at.press("home")
    at.chord("b", pygame.KMOD_LCTRL)
    assert (editor.track, at.app.notice) == (mine, "No tick is before this one: go to where your own run goes on")
    editor.go(120)
    here, there = at.session.timeline.positions[119], other.trajectory.positions
    faster = np.diff(there, axis=0, prepend=there[:1]) - (here - at.session.timeline.positions[118])
    joint = int(np.argmin(np.hypot(*(there - here).T) + SPEED_AHEAD * np.hypot(*faster.T))) + 1
    assert joint != 120
    at.choose_in_menu("Take from the other run...")
    at.choose("Its beginning, then my rest")
    assert editor.track.inputs == with_press_bits([*map(other.track.keys_at, range(joint))]) + mine.inputs[120:]
    assert editor.cursor == joint, "where this run goes on"
    assert editor.track.made.names == other.made.names
    text = f"Up to tick {joint - 1} {other.name}, then this run from its tick 120 on, not in the same state: "
    assert at.app.notice.startswith(text)
    assert at.app.notice.endswith(f"Now: {at.session.timeline.ending() or 'no exit yet'}")
    at.chord("z", pygame.KMOD_LCTRL)
    assert (editor.track, editor.cursor) == (mine, 120)


def test_where_a_joined_run_dies_the_ticks_from_the_joint_on_are_selected_for_a_search(tmp_path: Path) -> None:
    at = TasDriver(tmp_path / "player", write_records(tmp_path / "demos.txt", ("a run", SPIKED, running(300))))
    at.screen.level.others.open([at.session.recording(at.editor.track, "into spikes")])
    at.editor.edit(lambda track: track.replaced(0, len(track), bytes(300)))
    at.editor.go(5)
    at.chord("p", pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT)
    end, outcome = at.session.timeline.end
    assert outcome == "dead"
    assert at.editor.selection == (5, end + 1)
    assert at.app.notice.endswith(f"Now: {at.session.timeline.ending()}; F searches other keys up to there")
    at.press("f")
    tab = at.screen.tab
    assert isinstance(tab, SearchTab)
    assert (tab.goal.text, tab.span[0], tab.results) == ("won", 5, None), "Reach the exit sooner"
    at.press("return")
    assert tab.results is not None
    assert tab.results.title.endswith(PRESETS[0][0])
    at.close()


def test_a_splice_says_whether_both_runs_are_in_the_same_state(at: TasDriver) -> None:
    editor, mine = at.editor, at.editor.track
    at.screen.level.others.open([at.session.recording(mine.replaced(200, 240, [KEY_LEFT] * 40), "like it")])
    editor.go(200)
    at.chord("b", pygame.KMOD_LCTRL)
    assert editor.track == mine, "nothing changes"
    assert "in the same state: what follows plays as before" in at.app.notice
    events = at.session.timeline.event_ticks
    taken = next(tick for tick, names in events if "gold" in names)
    before, after = at.session.timeline.world(taken - 1), at.session.timeline.world(taken)
    text = difference_text(before, after)
    gap = np.hypot(after.ninja.x - before.ninja.x, after.ninja.y - before.ninja.y)
    steps = [np.array((n.x - n.prev_x, n.y - n.prev_y)) for n in (before.ninja, after.ninja)]
    speeds = f"{np.hypot(*(steps[1] - steps[0])):.2f} px/tick other"
    assert text.startswith(f"not in the same state: {gap:.2f} px away, {speeds}")
    assert re.search(r"; other: .*gold \d+", text)
    for slot in range(1, 6):
        before.objects[slot].x += 1.0
    assert re.search(r"other: ([^,]+, ){2}[^,]+ and [2-9] more$", difference_text(before, after))


def test_the_rest_of_another_run_goes_on_in_the_same_direction(at: TasDriver) -> None:
    """Where the other ninja comes by twice, the time at which it runs as ours does."""
    editor = at.editor
    right, left = [KEY_RIGHT], [KEY_LEFT]
    editor.edit(lambda track: track.replaced(0, len(track), right * 40))
    there_and_back = editor.track.replaced(0, 40, right * 20 + left * 60 + right * 60)
    at.screen.level.others.open([at.session.recording(there_and_back, "back and forth")])
    other = editor.others[0]
    x = other.trajectory.positions[:, 0]
    editor.go(10)
    here = at.session.timeline.positions[10, 0]
    back = 20 + int(np.argmin(np.abs(x[20:80] - here)))
    assert abs(x[back] - here) < 4, "it comes by on its way back"
    for name in ("x", "prev_x"):
        column = other.trajectory.columns[name]
        column[:20] += 0.01
        column[back] += here - x[back]
    far = np.hypot(*(other.trajectory.positions - at.session.timeline.positions[10]).T)
    assert np.argmin(far) == back, "nearest by place"
    editor.go(11)
    at.chord("p", pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT)
    assert "from its tick 11 on" in at.app.notice


def test_a_run_beside_says_who_made_it(at: TasDriver, tmp_path: Path) -> None:
    origin = at.session.origin
    demo = replace(origin, form="file", file=str(tmp_path / "theirs.txt"), replay=replace(origin.replay, author=""))
    at.screen.level.others.open([demo])
    assert at.editor.others[0].made.names == ("unknown (theirs.txt)",)


def test_a_run_of_another_level_is_refused(at: TasDriver) -> None:
    screen = at.screen
    elsewhere = PACK / "certificates" / "00-0-run-and-hop.exit.replay.txt"
    with pytest.raises(ReplayError, match="another level"):
        screen.level.others.open(load_replays(elsewhere))
    with pytest.raises(ReplayError, match="no run of"):
        runs_of_level(elsewhere, screen.session.origin)
    assert len(runs_of_level(RUN, screen.session.origin)) == 1


def test_the_list_of_other_runs_has_those_of_the_level(at: TasDriver) -> None:
    screen = at.screen
    at.chord("o", pygame.KMOD_LCTRL)
    at.frames()
    listed = at.shown(OtherRunScreen)
    for _ in bundled_replays():  # each picture reads one file at least
        if listed.rows:
            break
        at.frames()
    assert listed.rows
    assert all("no-hurry" in row.text for row in listed.rows), "names of files"
    at.press("return")
    at.frames()
    assert at.top() is screen
    assert len(screen.editor.others) == 1


def test_runs_that_reach_the_exit_are_listed_first_also_those_that_claim_nothing(tmp_path: Path) -> None:
    records = ("short", WALK, running(9)), ("long", WALK, running(40)), ("exit", WALK, running(WALK_END))
    file = write_records(tmp_path / "demos.txt", *records)
    at = TasDriver(tmp_path / "player", Path(copy(file, tmp_path / "one.txt")), record=0)
    at.chord("o", pygame.KMOD_LCTRL)
    listed = at.shown(OtherRunScreen)
    assert listed.list.empty.startswith("No other run of this level is known")
    at.wait(lambda: len(listed.rows) == 3, "the list")
    assert [row.result.partition(",")[0] for row in listed.rows] == ["all gold", "all gold", "unfinished"]
    assert listed.rows[0].result == f"all gold, {seconds_text(WALK_END)} s"
    at.close()


def test_other_records_of_the_file_that_is_open_are_listed_and_never_the_run_itself(tmp_path: Path) -> None:
    demos = write_demo(Demo(bytes([1] * 9), 9.0)), running(20), running(WALK_END), running(9)
    file = write_records(tmp_path / "box.txt", *(("a run", WALK, demo) for demo in demos))
    write_records(tmp_path / "levels.txt", ("a level", WALK, ""))
    at = TasDriver(tmp_path / "player", file, record=1)
    at.chord("o", pygame.KMOD_LCTRL)
    listed = at.shown(OtherRunScreen)
    at.wait(lambda: len(listed.rows) == 3, "the list")
    records = [row.source.record for row in listed.rows if isinstance(row.source, Recording)]
    assert records == [2, 0, 3], "of records 0 and 3 all but the keys is the same"
    assert (listed.problems, listed.without_runs) == ([], ["levels.txt"])
    at.choose("From a file ...")
    at.shown(RunFiles).open_path("box.txt")
    assert [other.name for other in at.editor.others] == ["box.txt", "box.txt 2", "box.txt 3"]
    assert at.editor.beside is at.editor.others[0]
    at.chord("s", pygame.KMOD_LCTRL)
    at.choose("Save")
    at.chord("o", pygame.KMOD_LCTRL)
    at.wait(lambda: len(at.shown(OtherRunScreen).rows) == 4, "all of them: the run has its own file now")
    at.close()


@pytest.mark.parametrize("name", ["one.demo", "two.tas", "three.TXT"])
def test_records_of_n_in_the_same_folder_are_listed_whatever_their_suffix(tmp_path: Path, name: str) -> None:
    folder = tmp_path / "runs"
    folder.mkdir()
    write_records(folder / name, ("theirs", WALK, running(WALK_END)))
    write_records(folder / "ours.demo", ("ours", WALK, running(9)))
    at = TasDriver(tmp_path / "player", folder / "ours.demo", record=0)
    at.chord("o", pygame.KMOD_LCTRL)
    listed = at.shown(OtherRunScreen)
    at.wait(lambda: listed.rows, "the list")
    assert [(row.text.split()[0], row.when) for row in listed.rows] == [(name, "Same folder")]
    at.close()


def test_a_run_that_costs_much_is_listed_as_it_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.tas_editor.level.other_runs.QUICK", 1)
    file = write_records(tmp_path / "demos.txt", ("exit", WALK, running(WALK_END)))
    at = TasDriver(tmp_path / "player", Path(copy(file, tmp_path / "one.txt")), record=0)
    at.chord("o", pygame.KMOD_LCTRL)
    listed = at.shown(OtherRunScreen)
    at.wait(lambda: listed.rows, "the list")
    assert {row.result.partition(",")[0] for row in listed.rows} == {"recording"}
    at.close()


def test_an_object_under_the_mouse_is_named_and_can_be_watched(at: TasDriver) -> None:
    level = at.screen.level
    gold = next(each for each in level.picture.run.objects if each.kind == "gold")
    left, top, *_ = level.area
    factor = level.picture.canvas.scale / at.app.canvas.scale
    place = left + gold.x * factor, top + gold.y * factor
    at.mouse(*place, click=False)
    assert level.pointed == gold
    assert f"gold {gold.id};" in at.editor.hint
    cursor = at.editor.cursor
    at.event(pygame.MOUSEBUTTONDOWN, *place, button=3)
    at.event(pygame.MOUSEBUTTONUP, *place, button=3)
    assert isinstance(at.top(), FormPanel)
    at.press("return")
    assert at.screen.tab.name == "Values"
    tab = next(tab for tab in at.screen.tabs if isinstance(tab, ValuesTab))
    assert tab.watched[-1].watch.text == f"taken({gold.id})"
    assert at.editor.cursor == cursor
    at.mouse(700, 300, click=False)
    assert level.pointed is None


def test_other_runs_come_from_any_file(at: TasDriver, tmp_path: Path) -> None:
    copy(RUN, tmp_path / "other.replay.txt")
    (tmp_path / "notes.txt").write_text("nothing of ours")
    copy(PACK / "certificates" / "00-0-run-and-hop.exit.replay.txt", tmp_path / "elsewhere.replay.txt")
    at.chord("o", pygame.KMOD_LCTRL)
    listed = at.shown(OtherRunScreen)
    assert [row.when for row in listed.rows].count("Same folder") == 1
    files = set(tmp_path.rglob("*"))
    at.press("e", "c", "delete")
    assert at.top() is listed
    assert set(tmp_path.rglob("*")) == files, "nothing is written here"
    at.choose("From a file ...")
    files_shown = at.shown(RunFiles)
    assert [path.name for path in files_shown.paths[1:]] == ["player", "other.replay.txt"], "not the run itself"
    for name in ("no such file", "~nobody there/file", "long " * 60, "notes.txt", "elsewhere.replay.txt"):
        files_shown.open_path(name)
        assert at.top() is files_shown
        assert at.app.notice
    at.press("down", "down", "return")
    assert files_shown.folder == tmp_path / "player"
    at.press("home", "return", "up")
    at.write("other.replay.txt")
    at.press("return")
    assert at.top() is at.screen
    assert [run.name for run in at.editor.others] == ["other"]


def test_buttons_beside_the_tabs_show_which_overlays_are_on(at: TasDriver) -> None:
    overlays = at.screen.level.picture.overlays
    at.press("3")
    buttons = [each for each in at.screen.strip.widgets if isinstance(each, LitButton)]
    assert [each.text for each in buttons if each.is_lit()] == ["Values", "3"]
    at.choose("3")
    at.choose("1")
    assert overlays.on == {"overlay_hitboxes"}
    at.mouse(*at.button("1").centre, click=False)
    assert at.editor.hint.startswith("Show hit boxes")


def test_the_run_is_watched_with_those_beside_it(at: TasDriver) -> None:
    at.screen.level.others.open(runs_of_level(RUN, at.session.origin))
    at.editor.edit(lambda track: track.replaced(0, 0, [0] * 3))
    at.press("escape")
    at.choose("Watch")
    viewer = at.shown(ReplayScreen)
    assert viewer.run.inputs == at.editor.track.inputs
    assert [(ghost.name, ghost.inputs) for ghost in viewer.ghosts] == [
        (other.name, other.track.inputs) for other in at.editor.others
    ]
    at.press("escape")
    at.press("g", "escape")
    at.choose("Watch")
    assert not at.shown(ReplayScreen).ghosts, "other runs are off"


def test_of_a_long_run_the_way_near_the_cursor_is_shown(at: TasDriver) -> None:
    at.editor.edit(lambda track: track.replaced(0, len(track), [0] * 20_000))
    at.wait(lambda: at.session.timeline.is_complete, "the whole run")
    at.editor.go(15_300)
    at.frames()
    assert shown_span(15_300) == (13_000, 19_000)
    left, top, *_ = at.screen.level.area
    factor = at.screen.level.picture.canvas.scale / at.app.canvas.scale
    x, y = at.session.timeline.positions[15_300]
    at.mouse(left + x * factor, top + y * factor, click=False)
    assert at.screen.level.hover is not None
    assert 13_000 <= at.screen.level.hover < 19_000


def test_another_run_is_in_the_first_picture_and_in_that_of_a_larger_window(at: TasDriver) -> None:
    screen = TasScreen(at.app, open_run(RUN), load_replays(RUN))
    screen.editor.go(100)
    at.app.replace(screen)
    picture = screen.level.picture
    for size in ((792, 600), (1280, 720)):
        pygame.display.set_mode(size)
        pygame.event.post(pygame.Event(pygame.WINDOWSIZECHANGED))
        at.frames()
        assert picture.view is not None
        (ghost,) = picture.view.ghosts
        assert ghost.place(1.0) == tuple(screen.session.timeline.positions[100])


def test_names_do_not_lie_on_each_other(at: TasDriver) -> None:
    screen = at.screen
    screen.level.others.open([load_replays(RUN)[0]] * 3)
    screen.editor.edit(lambda track: track.named(100, "here"))
    screen.editor.go(100)
    at.frames(2)
    paths = screen.level.paths
    assert paths is not None
    labels = paths.labels
    assert len(labels) == 5, "a flag, its name, three runs"
    assert all(label.collidelist([each for each in labels if each is not label]) < 0 for label in labels)
    _, y = screen.level.picture.canvas.point(*at.session.timeline.positions[100])
    assert all(label.bottom < y for label in labels[2:]), "above the ninja"


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_the_picture_goes_over_to_another_memory_with_the_run(at: TasDriver) -> None:
    picture, timeline = at.screen.level.picture, at.session.timeline
    place = picture.run.ninja.x
    timeline.__dict__.update(Timeline(timeline.level, timeline.inputs, memory="plain").__dict__)
    timeline.simulate(40)
    used = []
    for _ in range(2):
        at.editor.go(30)
        at.frames(2)
        used.append((picture.run.memory, picture.run.tick > 0, picture.run.ninja.x))
        at.editor.go(0)
        at.frames(2)
        timeline.__dict__.update(Timeline(timeline.level, timeline.inputs, memory="compiled").__dict__)
        timeline.simulate(40)
    assert [memory for memory, *_ in used] == ["plain", "compiled"]
    assert used[0][1:] == used[1][1:]
    assert used[0][2] != place


def test_the_switch_of_an_exit_is_pointed_at_too(at: TasDriver) -> None:
    run = at.screen.level.picture.run
    world = run.world
    (exit_,) = (each for each in run.objects if each.kind == "exit")
    switch = world.objects[world.objects[exit_.id + 1].partner]
    assert object_at(run, switch.x, switch.y) == replace(exit_, x=switch.x, y=switch.y)
    assert object_at(run, exit_.x, exit_.y) == exit_


def test_other_runs_in_the_folder_of_a_run_that_was_saved_again_are_listed(at: TasDriver, tmp_path: Path) -> None:
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    for name in ("other.replay.txt", "saved.replay.txt"):
        at.session.save(folder / name)
    screen = OtherRunScreen(at.app, at.screen.level.others)
    assert [(name, [each.name for each in files if isinstance(each, Path)]) for name, files in screen.places()][:1] == [
        ("Same folder", ["saved.replay.txt", "other.replay.txt"])
    ]


def test_the_last_tick_of_a_run_is_selected_behind_its_end(at: TasDriver) -> None:
    at.editor.edit(lambda track: track.replaced(len(track), len(track), [0] * 50))
    at.editor.go(3)
    at.screen.run("select_last")
    assert at.editor.selection == (3, len(at.editor.track))


def test_the_overlays_of_the_game_lie_over_the_level_also_where_it_is_zoomed(at: TasDriver) -> None:
    def picture() -> bytes:
        at.frames(2)
        return pygame.image.tobytes(at.screen.level.picture.surface, "RGB")

    for _ in range(2):
        at.editor.go(120)
        bare = picture()
        for key in "123456":
            at.press(key)
            assert len(at.screen.level.picture.overlays.on) == 1
            assert picture() != bare or key in "46", "nothing looks for the ninja, or thinks, here"
            at.press(key)
            assert picture() == bare, key
        for key in "123456":
            at.press(key)
        at.editor.go(125)
        picture()
        at.editor.go(120)
        for key in "123456":
            at.press(key)
        left = picture()
        shown = at.screen.level.picture
        shown.view.draw(shown.surface, 1.0, whole=True)
        assert picture() == left, "nothing of them stays"
        at.screen.level.picture.camera.zoom_at(at.screen.level.picture.surface.get_size(), (200, 150), 4)


def test_a_change_of_the_run_forgets_the_tick_under_the_mouse(at: TasDriver) -> None:
    level = at.screen.level
    level.point_at(9, None)
    level.update(8)
    assert level.hover == 9
    at.editor.edit(lambda track: InputTrack(track.inputs[:4]))
    level.update(8)
    assert level.hover is None
