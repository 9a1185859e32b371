"""Kill the game, the editor or the TAS editor at random moments: nothing that was called saved may be lost.

    python3 tools/dev.py tool soak.kills --kills 200
    SDL_VIDEODRIVER=x11 DISPLAY=:73 python3 tools/dev.py tool soak.kills --kills 100 --what window

A child process opens the player's folder, goes on where the last one ended, and says after each save or edit what
there must be now. It is killed (SIGKILL) after a random time, also while the files are being made. Then the folder is
opened as the program would open it. ``--what``: the game (records without its window, or window) loses nothing that was
said; the editor loses at most two seconds of drawing; the TAS editor (tas without its window, or tas-window) at most
its last edit; and no file is half written.
"""

import argparse
import multiprocessing
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from hashlib import sha256
from itertools import groupby
from multiprocessing.connection import Connection
from pathlib import Path
from random import Random
from typing import Any, NamedTuple, NoReturn

from ninja_game.editor.files import lost_drafts
from ninja_game.errors import NinjaGameError
from ninja_game.files import writing
from ninja_game.files.locking import try_lock
from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from ninja_game.formats.named_level import NamedLevel
from ninja_game.levels.episodes import Entry
from ninja_game.player.attempt import Attempt
from ninja_game.player.player_data import PlayerData
from ninja_game.player.playthrough import LevelPlaythrough
from ninja_game.sim.level import Level
from ninja_game.tas import journal
from ninja_game.tas.files import open_run
from ninja_game.tas.session import TasSession
from ninja_game.tas.tracks import InputTrack
from tests.support.samples import replay_of_walk

PATIENCE = 120.0  # seconds to wait for a word of a child
Fact = tuple[str, str, int]  # what a child says: the kind of fact, such as "saved", what it is about, a number
RUN = "walk.replay.txt"  # the file that the TAS editor edits

# --- the children: each works for ever, saying each time what is saved ---


def level_of(number: int) -> Level:
    """A level for which running right is enough; each number makes another one."""
    return parse_level_string("0" * 713 + f"|5^100,566!11^160,564,130,564!0^{300 + number},100")


def entry_of(level: Level) -> Entry:
    """A level as lists have it."""
    return Entry(NamedLevel("killed", "", "", level, "killed.txt"), "game")


def passed_attempt(level: Level, wait: int) -> Attempt:
    """An attempt that passes the level after standing for ``wait`` ticks."""
    attempt = Attempt(level)
    while attempt.outcome == "running":
        attempt.tick(2 if attempt.simulation.tick >= wait else 0)
    return attempt


def play_records(folder: Path, rng: Random, pipe: Connection) -> NoReturn:
    """What the game saves, without its window: far more saves a second."""
    data = PlayerData(folder)
    while True:
        level = level_of(rng.randrange(40))
        attempt = passed_attempt(level, rng.randrange(30))
        LevelPlaythrough(data, entry_of(level)).passed(attempt)
        pipe.send(("best", level_digest(level), attempt.score))
        pipe.send(("replay", "", data.records.keep_replay(attempt.replay())))
        volume = rng.randrange(100)
        pipe.send(("about", "", volume))
        data.change_settings(data.settings.changed(volume=volume))
        pipe.send(("volume", "", volume))
        data.progress.level_passed((rng.randrange(9), rng.randrange(5)), legitimate=True)
        episode, place = data.progress.columns[0].beaten
        pipe.send(("progress", "0", episode * 5 + place))


def play_in_window(folder: Path, rng: Random, pipe: Connection) -> NoReturn:
    """The whole program: levels played by keys, replays kept, settings changed on the way."""
    from ninja_game.play.level.screen import LevelScreen
    from tests.support.menu_driver import MenuDriver

    driver = MenuDriver(folder)
    while True:
        level = level_of(rng.randrange(40))
        screen = LevelScreen(driver.app, LevelPlaythrough(driver.player, entry_of(level)))
        driver.app.push(screen)
        for _ in range(3):
            driver.keys.script = [1] * rng.randrange(1, 15) + [2] * 120
            while screen.attempt.outcome != "exit":
                driver.frames()
            if any("saved" in notice for notice in screen.play.notices):
                pipe.send(("best", level_digest(level), screen.attempt.score))
            screen.keep_replay()
            if "saved" in driver.app.notice:
                pipe.send(("replay", "", driver.player.records.replays()[0].id))
            driver.press("r")
        volume = rng.randrange(100)
        pipe.send(("about", "", volume))
        driver.app.change_settings(volume=volume)
        pipe.send(("volume", "", volume))
        screen.quit()


def draw_level(folder: Path, rng: Random, pipe: Connection) -> NoReturn:
    """The editor, by its own mouse events; says the digest of every state and when it was reached."""
    from tests.support.level_maker import Maker

    maker = Maker(folder)
    maker.open("Editor")
    if maker.top() is not maker.editor:
        maker.choose("Recover")
    session = maker.editor.session
    while True:
        maker.press(rng.choice(("9", "0", "1", "shift+g", "shift+i", "m")))
        maker.drag(*((rng.uniform(30, 760), rng.uniform(30, 570)) for _ in range(rng.randrange(1, 4))))
        session.tools.finish()
        digest = level_digest(session.draft.level)
        pipe.send(("edited", digest, time.monotonic_ns()))
        if rng.random() < 0.04:
            pipe.send(("about", digest, 0))
            session.save(folder / "levels" / "kept.txt", replacing=True)
            if session.is_saved:
                pipe.send(("saved", digest, 0))
        time.sleep(0.01)


def edit_run(folder: Path, rng: Random, pipe: Connection) -> NoReturn:
    """The TAS editor without its window: far more edits a second."""
    from tests.support.tas_edits import edit_at_random

    session = opened_run(folder)
    while True:
        edit_at_random(session, rng)
        say_and_save(session, rng, pipe)


def edit_run_in_window(folder: Path, rng: Random, pipe: Connection) -> NoReturn:
    """The TAS editor with its own keys and mouse."""
    from tests.support.tas_driver import TasDriver
    from tests.support.tas_edits import use_at_random

    at = TasDriver(folder, folder / RUN)
    if at.top() is not at.screen:
        at.choose("Recover")
        at.adopt()
    while True:
        use_at_random(at, rng)
        say_and_save(at.session, rng, pipe)


def opened_run(folder: Path) -> TasSession:
    """The run, or what was not saved of it."""
    found = next(journal.lost_runs(folder), None)
    session = TasSession(found.opened if found else open_run(folder / RUN), folder, memory="plain")
    if found:
        session.recover(found)
    return session


def digest_of_track(track: InputTrack) -> str:
    """Of keys and names; ticks without a key at the end do not count: a saved file may leave them out."""
    return sha256(track.inputs.rstrip(b"\0") + repr(track.markers).encode()).hexdigest()


def say_and_save(session: TasSession, rng: Random, pipe: Connection) -> None:
    """Say what the run is; now and then save it, which leaves out what is behind the exit."""
    pipe.send(("edited", digest_of_track(session.track), 0))
    if rng.random() < 0.05:
        exits = session.tail_behind() == "exit"
        digest = digest_of_track(session.track.up_to(session.timeline.end[0] + 1) if exits else session.track)
        pipe.send(("about", digest, 0))
        session.save(session.file.path or Path(), replacing=True)
        pipe.send(("saved", digest, 0))


# --- what must be there after a kill ---


class Game:
    """What the children of a folder said was saved: the best number by kind and key, and the volumes."""

    def __init__(self, _: Path) -> None:
        self.numbers: dict[tuple[str, str], int] = {}
        self.volumes: set[int] = set()

    def losses(self, folder: Path, facts: list[Fact]) -> Iterator[str]:
        """Facts that are lost, files half written, or that the folder cannot be opened as it was."""
        for kind, key, number in facts:
            if kind == "volume":
                self.volumes = {number}
            elif kind == "about":
                self.volumes = {*self.volumes, number} if self.volumes else set()
            else:
                place = kind, key if kind != "replay" else str(number)
                self.numbers[place] = max(number, self.numbers.get(place, 0))
        writing.tidied.clear()  # as a new process
        data = PlayerData(folder)
        bests = data.records.level_bests()
        yield from (f"not opened: {message}" for message in data.messages)
        for (kind, key), number in self.numbers.items():
            if kind == "best" and (key not in bests or bests[key].score < number):
                yield f"best of {key[:8]}: {number} was saved, {bests.get(key)} is there"
            elif kind == "replay" and data.records.replay(number) is None:
                yield f"replay {number} is gone"
            elif kind == "progress":
                episode, level = data.progress.columns[0].beaten
                if episode * 5 + level < number:
                    yield f"progress: {number} was saved, {(episode, level)} is there"
        if self.volumes and data.settings.volume not in self.volumes:
            yield f"volume: {self.volumes} was saved, {data.settings.volume} is there"
        data.close()
        known = {"settings.toml", "records.sqlite", ".settings.toml.lock", ".records.sqlite.lock"}
        known |= {"levels", "replays", "exports"}
        yield from (f"left over: {name}" for name in sorted({each.name for each in folder.iterdir()} - known))


class Drawing:
    """What the file of an editor may hold, and whether there is one for certain. ``most``: seconds that may be lost."""

    most = 2.0

    def __init__(self, _: Path) -> None:
        self.saved: set[str] = set()
        self.made = False

    def losses(self, folder: Path, facts: list[Fact], killed_at: int | None = None) -> Iterator[str]:
        """Work that is neither offered nor in the file, older than ``most``; or a file that is not as it was saved."""
        killed_at = killed_at or time.monotonic_ns()
        for kind, digest, _ in facts:
            self.saved = {digest} if kind == "saved" else self.saved | {digest} if kind == "about" else self.saved
            self.made |= kind == "saved"
        there = {level_digest(found.draft.level) for found in lost_drafts(folder)}
        file = folder / "levels" / "kept.txt"
        if self.made or file.exists():
            in_file = level_digest(load_levels(file)[0].level)
            there.add(in_file)
            if in_file not in self.saved:
                yield "the file is not as it was saved"
        drawn = [(digest, at) for kind, digest, at in facts if kind == "edited"]
        last = max((number for number, (digest, _) in enumerate(drawn) if digest in there), default=-1)
        lost = (killed_at - drawn[last + 1][1]) / 1e9 if last + 1 < len(drawn) else 0.0
        if lost > self.most:
            yield f"{lost:.2f} s lost"


class Track:
    """The run as it was last, and what its file may hold."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True)
        (folder / RUN).write_text(replay_of_walk(), "utf-8")
        self.last = digest_of_track(open_run(folder / RUN).track)
        self.saved = {self.last}

    def losses(self, folder: Path, facts: list[Fact]) -> Iterator[str]:
        """More edits than one that are lost, or a file that is not as it was saved."""
        # What changes nothing, such as undo without an edit, is not an edit that could be lost.
        edits = [each for each, _ in groupby([self.last, *(each for kind, each, _ in facts if kind == "edited")])]
        for kind, each, _ in facts:
            self.saved = {each} if kind == "saved" else self.saved | {each} if kind == "about" else self.saved
        await_locks(folder)
        session = opened_run(folder)
        self.last = digest_of_track(session.track)
        # The last edit may not have been reported, and lead back to a run that was reported long before, as undo does.
        session.history.undo()
        before = digest_of_track(session.track)
        session.history.redo()
        session.close(keep=True)
        if (lost := min((edits[::-1].index(each) for each in (self.last, before) if each in edits), default=0)) > 1:
            yield f"{lost} edits lost"
        if digest_of_track(open_run(folder / RUN).track) not in self.saved:
            yield "the file is not as it was saved"


def await_locks(folder: Path) -> None:
    """Wait until the system has freed the locks of a process that has died: on some systems that takes a moment."""
    end = time.monotonic() + PATIENCE
    for file in (folder / journal.JOURNAL_FOLDER).glob("*.jsonl"):
        while (handle := try_lock(file.with_suffix(".lock"))) is None and time.monotonic() < end:
            time.sleep(0.01)
        if handle is not None:
            os.close(handle)


# --- killing ---


class Trial(NamedTuple):
    """A child to kill. ``words``: how many it says at least; ``seconds``: after these, at the latest, it is killed."""

    child: Callable[[Path, Random, Connection], NoReturn]
    state: type[Game | Drawing | Track]
    words: Callable[[Random], int]
    seconds: float


TRIALS = {
    # Without a word: from its birth, so that opening the files is interrupted too.
    "records": Trial(play_records, Game, lambda rng: rng.choice((0, 1, 1, 1)), 0.25),
    "window": Trial(play_in_window, Game, lambda rng: rng.choice((0, 1, 1, 1)), 0.25),
    "editor": Trial(draw_level, Drawing, lambda _: 1, 2.5),
    "tas": Trial(edit_run, Track, lambda rng: rng.randrange(1, 21), 0.05),
    "tas-window": Trial(edit_run_in_window, Track, lambda rng: rng.randrange(1, 21), 0.05),
}


def live(what: str, folder: Path, seed: int, pipe: Connection) -> NoReturn:
    """What a child does until it is killed."""
    TRIALS[what].child(folder, Random(seed), pipe)


def life(what: str, folder: Path, seed: int, words: int, seconds: float) -> list[Fact]:
    """Let a child live until it has printed this many words and for some seconds more, kill it; all that it printed."""
    methods = multiprocessing.get_all_start_methods()
    context: Any = multiprocessing.get_context("fork" if "fork" in methods else "spawn")
    ours, theirs = context.Pipe(duplex=False)
    child = context.Process(target=live, args=(what, folder, seed, theirs), daemon=True)
    child.start()
    theirs.close()
    facts: list[Fact] = []
    # The last word may be cut off; what it was about counts as not said.
    with suppress(EOFError, OSError):
        while len(facts) < words and ours.poll(PATIENCE):
            facts.append(ours.recv())
    time.sleep(seconds)
    child.kill()
    child.join()
    with suppress(EOFError, OSError):
        while ours.poll():
            facts.append(ours.recv())
    ours.close()
    return facts


def kill_test(
    kills: int, seed: int, folder: Path, *, what: str = "records", report: bool = False
) -> tuple[int, list[str]]:
    """Kill this many children; how many saves and edits they had reported, and everything that is wrong."""
    rng, trial = Random(seed), TRIALS[what]
    reported = 0
    wrong: list[str] = []
    for number in range(kills):
        # Every tenth folder is a new one, so that making the files is interrupted too.
        home = folder / str(number // 10)
        if number % 10 == 0:
            state = trial.state(home)
        words = trial.words(rng)
        facts = life(what, home, rng.randrange(2**31), words, rng.random() * trial.seconds)
        reported += sum(kind != "about" for kind, _, _ in facts)
        try:
            lost = [*state.losses(home, facts), *(["it did not start"] if words and not facts else [])]
        except (NinjaGameError, OSError) as error:
            lost = [str(error)]
        wrong += [f"kill {number + 1}: {text}" for text in lost]
        if report and (lost or (number + 1) % 10 == 0):
            print(f"{number + 1} kills, {reported} saves and edits, {len(wrong)} things wrong", flush=True)
    return reported, wrong


def main() -> int:
    """Kill as the command line says and print what is wrong; exit code 1 if anything is."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--what", choices=TRIALS, default="records")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        reported, wrong = kill_test(folder=Path(folder), report=True, **vars(options))
    print(*wrong, f"{options.kills} kills, {reported} saves and edits, {len(wrong)} things wrong", sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
