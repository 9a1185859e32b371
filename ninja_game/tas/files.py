"""Runs from files and back: authors stay, and a person's text is never replaced without consent."""

from __future__ import annotations

import json
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from ninja_game.document import check_free, digest_of_file
from ninja_game.errors import DAMAGED, LevelError, NinjaGameError, ReplayError
from ninja_game.files.bundled import is_bundled
from ninja_game.files.reading import digest_of, read_bytes, read_utf8
from ninja_game.files.tree import Tree
from ninja_game.files.writing import write_atomically
from ninja_game.formats.lines import numbered_lines
from ninja_game.formats.links import is_link
from ninja_game.formats.load import load_levels, load_replays, texts_of
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel, format_of
from ninja_game.formats.recording import Recording, holds_recordings, parse_replays
from ninja_game.formats.replay.input_text import Inputs, read_inputs
from ninja_game.formats.replay.notations import in_our_notation, is_tas_text
from ninja_game.formats.replay.text import Replay, is_replay, parse_replay, write_replay
from ninja_game.runs.conversion import on_level
from ninja_game.runs.run import record_replay
from ninja_game.sim.inputs import MAX_TICKS
from ninja_game.sim.level import Body, Level
from ninja_game.tas.timeline import TICKS_BEHIND_END
from ninja_game.tas.tracks import Branches, InputTrack, branches_of_json


@dataclass(frozen=True)
class RunFile:
    """The file of a run. ``path``: None if there is no file that may be replaced.

    ``digest``, ``branches_digest``: of the bytes of the file and of the file of branches; ``track``: its content.
    """

    path: Path | None = None
    digest: str = ""
    branches_digest: str = ""
    track: InputTrack | None = None


@dataclass(frozen=True)
class OpenedRun:
    """An opened run: its recording, the input track in it, its file, and the branches beside it.

    ``moved``: the level is not the recorded one.
    """

    recording: Recording
    track: InputTrack
    file: RunFile = RunFile()
    branches: Branches = field(default_factory=Branches)
    moved: bool = False


def open_run(path: Path, *, record: int | None = None, level: Level | None = None) -> OpenedRun:
    """Open the recording number ``record`` of a file or link, or with None the only one in it.

    ``level``: where to play it, None: on its own level in its present state; on another level it has no file yet.
    ``save_run`` replaces only replay texts that it could have written itself: texts with comments, blocks or included
    files stay, and so do the game's. A level, or a text without ticks for ``level``, is a new run. Raises ReplayError,
    DemoError, LevelError; OSError for a file that cannot be opened.
    """
    texts = list(texts_of(path))
    if not any(holds_recordings(text) for _, text in texts):
        return _begun_on(path, "".join(text for _, text in texts), record, level)
    recordings = [run for file, text in texts for run in parse_replays(text, file=file, level=level, changed=True)]
    if record is None and len(recordings) > 1:
        hint = f"edit one with --record, 0 to {len(recordings) - 1}"
        if recordings[0].form == "episode":
            hint += "; `ninja-game convert` puts the episode together again"
        raise ReplayError(f"{len(recordings)} recordings", str(path), hint=hint)
    recording = next((other for other in recordings if other.record == (record or 0)), None)
    if recording is None:
        raise ReplayError(f"there is no record {record}", str(path), expected=f"0 to {len(recordings) - 1}")
    on = on_level(recording, level)
    track = track_of(on)
    if on is not recording:
        return OpenedRun(on, track, moved=True)
    elsewhere = is_link(path) or recording.of_n or is_bundled(path)
    if elsewhere or not _written_by_us(data := read_bytes(path)):
        return OpenedRun(recording, track)
    file = RunFile(path, digest_of(data), digest_of_file(branches_path(path)), track)
    return OpenedRun(recording, track, file, read_branches(path))


def _begun_on(path: Path, text: str, record: int | None, level: Level | None) -> OpenedRun:
    """A run on a level of a file without recordings, or with the inputs of its ``text`` on ``level``."""
    if level is not None and format_of(text) == "string":
        text = text.strip().removeprefix("inputs:")
        read = inputs_of_text(text, str(path)) if text.strip() else Inputs(b"")
        return new_run(NamedLevel(path.stem, "", "", level, str(path)), InputTrack(read.keys, read.markers))
    levels = load_levels(path)
    if record is None and len(levels) > 1:
        raise LevelError(f"{len(levels)} levels", str(path), hint=f"say which one: --record, 0 to {len(levels) - 1}")
    chosen = next((other for other in levels if other.record == (record or 0)), None)
    if chosen is None:
        raise LevelError(f"there is no record {record}", str(path), expected=f"0 to {len(levels) - 1}")
    return new_run(replace(chosen, level=level or chosen.level))


NO_TICKS = InputTrack(b"")


def new_run(on: NamedLevel, track: InputTrack = NO_TICKS, body: Body = "circle") -> OpenedRun:
    """A new run on a level, without a file."""
    names = {"name": on.name, "level_name": on.name, "level_author": on.author}
    replay = Replay.of_inputs(track.inputs, on.level, body=body, **names)
    return OpenedRun(Recording(on.level, replay, file=on.file), track)


def run_file_of(path: Path, digest: str, branches_digest: str) -> RunFile:
    """The file of a run in a journal, if ``open_run`` would give it this file; else none."""
    with suppress(OSError, NinjaGameError):
        if _written_by_us(read_bytes(path)):
            return RunFile(path, digest, branches_digest)
    return RunFile()


def open_recording(recording: Recording) -> OpenedRun:
    """Open a loaded recording; without a file if the file has changed since."""
    with suppress(NinjaGameError, OSError):
        path = Path(recording.file)
        if path.is_file():
            opened = open_run(path, record=recording.record, level=recording.level)
            if track_of(recording) == opened.track and same_level(recording, opened.recording):
                return opened
    return OpenedRun(recording, track_of(recording))


def runs_of_level(path: Path, origin: Recording) -> list[Recording]:
    """The recordings of a file or link that can be shown beside a run: all others of its level, with its body.

    Those without a level get the run's. Raises ReplayError if there is none, and as ``load_replays`` does.
    """
    recordings = load_replays(path, level=origin.level)
    fitting = [run for run in recordings if same_level(run, origin)]
    others = [run for run in fitting if not same_place(run, origin)]
    if not others:
        what = f"no {'other run' if fitting else 'run'} of {origin.name or 'this level'} with its body"
        raise ReplayError(what, str(path), found=f"{len(recordings)} others" if not fitting else "")
    return others


def same_level(recording: Recording, other: Recording) -> bool:
    return recording.body == other.body and level_digest(recording.level) == level_digest(other.level)


def same_place(recording: Recording, other: Recording) -> bool:
    """Whether both are the same record of the same file."""
    if not other.file or recording.record != other.record or not Path(other.file).is_file():
        return False
    return Path(recording.file).resolve() == Path(other.file).resolve()


def track_of(recording: Recording) -> InputTrack:
    """A recording as an input track: the keys of all ticks that it plays."""
    markers = (marker for marker in recording.replay.markers if marker.tick <= recording.ticks)
    return InputTrack(recording.inputs, tuple(markers))


def inputs_of_text(text: str, place: str) -> Inputs:
    """The ticks of a text: one of our replays, our notation alone, or another tool's.

    ``place``: the text's name in messages. Raises ReplayError, also for a text without ticks; LevelError.
    """
    if is_replay(text):
        replay = parse_replay(text, file=place)
        return Inputs(replay.inputs, replay.markers)
    inputs = read_inputs(in_our_notation(text, place) if is_tas_text(text) else numbered_lines(text), file=place)
    if not inputs.keys:
        raise ReplayError("there are no inputs", place, expected="keys and counts, such as R*30 RJ*10")
    return inputs


def _written_by_us(data: bytes) -> bool:
    """Whether a text contains only what we would write: no comments, blocks, included files."""
    text = data.decode("utf-8", "replace").replace("\r\n", "\n")
    with suppress(NinjaGameError):
        if is_replay(text):
            ours = iter(_facts(write_replay(parse_replay(text))))
            return all(fact in ours for fact in _facts(text))
    return False


def _facts(text: str) -> list[str]:
    """The words of a text without its first line, which has the version, and the last."""
    return [word for line in text.splitlines()[1:] if line != "end" for word in line.split()]


def recording_of_track(origin: Recording, track: InputTrack, name: str = "") -> Recording:
    """An input track as a recording without claims, with the level and the author of another one."""
    replay = replace(unclaimed_replay(origin, track), name=name or origin.name)
    return replace(origin, file=name or origin.file, replay=replay, form="replay")


def unclaimed_replay(origin: Recording, track: InputTrack) -> Replay:
    """An input track as a replay without claims, with its level inside."""
    old = origin.replay
    return Replay.of_inputs(
        track.inputs,
        origin.level,
        name=origin.name,
        author=origin.author,
        body=origin.body,
        level_name=old.level_name,
        level_author=old.level_author,
        markers=track.markers,
        made=old.made,
        co_authors=old.co_authors,
    )


def replay_of_track(origin: Recording, track: InputTrack) -> Replay:
    """An input track as our replay: with claims, or without if keys or names after its death must stay.

    An exit or a death soon after the last input, which the TAS editor shows, is included. After the exit nothing is
    kept. Raises ArgumentError for a run without ticks.
    """
    unclaimed = unclaimed_replay(origin, track)
    record = partial(
        record_replay, origin.level, track.inputs, body=origin.body, name=origin.name, author=origin.author
    )
    run = record(ticks=min(len(track) + TICKS_BEHIND_END, MAX_TICKS))
    if run.outcome == "running":
        run = record()
    track = track.up_to(run.ticks) if run.outcome == "exit" else track
    if has_tail(track, run.ticks):
        return unclaimed
    return replace(
        run,
        markers=track.markers,
        made=unclaimed.made,
        co_authors=unclaimed.co_authors,
        level_name=unclaimed.level_name,
        level_author=unclaimed.level_author,
    )


def has_tail(track: InputTrack, ticks: int) -> bool:
    """Whether an input track has keys, or names of ticks, after its first ``ticks`` ticks."""
    return any(track.inputs[ticks:]) or any(marker.tick > ticks for marker in track.markers)


def save_run(
    origin: Recording, track: InputTrack, branches: Branches, path: Path, file: RunFile, *, replacing: bool = False
) -> RunFile:
    """Write an input track, and its branches and watched formulas beside it; gives its file.

    Raises OccupiedError if that would replace another file, or one that has changed since it was read, unless
    ``replacing``; FileError, OSError if writing fails.
    """
    same_file, branches_file = path == file.path, branches_path(path)
    for file_path, known in ((path, file.digest), (branches_file, file.branches_digest)):
        check_free(file_path, digest_of_file(file_path), known if same_file else None, replacing=replacing)
    if not same_file or track != file.track or digest_of_file(path) != file.digest:
        replay = replay_of_track(origin, track)
        write_atomically(path, write_replay(_with_old_path(replay, origin) if same_file else replay))
    if len(branches) or branches.watched or branches_file.exists():
        Tree(path.parent).write(branches_file.name, json.dumps(branches.as_json(), indent=1))
    return RunFile(path, digest_of_file(path), digest_of_file(branches_file), track)


def _with_old_path(replay: Replay, origin: Recording) -> Replay:
    """A replay with the path of its level's file, as in the one that it replaces."""
    old = origin.replay
    if old.level is not None or not old.level_path:
        return replay
    return replace(
        replay,
        level=None,
        level_name="",
        level_author="",
        level_digest=level_digest(origin.level),
        level_path=old.level_path,
        level_record=old.level_record,
    )


def branches_path(path: Path) -> Path:
    return path.with_name(f"{path.name}.branches.json")


def read_branches(path: Path) -> Branches:
    """The branches beside a run; none without such a file.

    Raises ReplayError for a file with other content: saving would replace it.
    """
    branches_file = branches_path(path)
    if not branches_file.is_file():
        return Branches()
    try:
        return branches_of_json(json.loads(read_utf8(branches_file)))
    except DAMAGED as error:
        hint = "move it away, and the run opens without branches"
        raise ReplayError("not the branches of a run", str(branches_file), found=str(error)[:60], hint=hint) from None
