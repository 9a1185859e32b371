"""Writes every edit to the disk as soon as it is made: a killed program loses at most the last one.

A journal is a text of JSON lines in the player's folder: first the opened run, then each edit as the ticks that it
replaces, and each change of the branches. It is deleted when the run is saved or left.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self
from zlib import crc32

from ninja_game.document import RecoveryFile, recovered_from
from ninja_game.errors import DAMAGED, FileError
from ninja_game.files.reading import open_regular
from ninja_game.files.writing import write_atomically
from ninja_game.formats.recording import parse_replays
from ninja_game.sim.loader import object_table
from ninja_game.tas.contributions import NONE, Contributions
from ninja_game.tas.files import OpenedRun, RunFile, run_file_of
from ninja_game.tas.tracks import (
    Branches,
    InputTrack,
    branches_of_json,
    checked_track,
    first_different_index,
    inputs_of_json,
    markers_of_json,
    track_as_json,
    track_of_json,
)

JOURNAL_FOLDER, JOURNAL_SUFFIX = "tas", ".jsonl"  # in the player's folder


def edit_as_json(old: InputTrack, new: InputTrack) -> dict[str, Any]:
    """The difference of two input tracks: the ticks from ``at`` to ``to`` - 1 are replaced by ``keys``.

    ``sum``: of the new track, so that a damaged edit is noticed; ``made``: all its contributions.
    """
    at = old.first_difference(new)
    tail = first_different_index(old.inputs[at:][::-1], new.inputs[at:][::-1])
    keys = new.inputs[at : len(new) - tail]
    change = {"at": at, "to": len(old) - tail, "keys": keys.hex()[1::2], "sum": _sum(new), "made": new.made.as_json()}
    return change if old.markers == new.markers else change | {"markers": [list(marker) for marker in new.markers]}


def _sum(track: InputTrack) -> int:
    return crc32(repr(track.markers).encode("utf-8", "replace"), crc32(track.inputs))


def edited(track: InputTrack, change: dict[str, Any]) -> InputTrack:
    """An input track after an edit of a journal. Raises one of DAMAGED for an invalid edit."""
    at, to = int(change["at"]), int(change["to"])
    if not 0 <= at <= to <= len(track):
        raise ValueError("an edit outside the run's ticks")
    markers = markers_of_json(change["markers"]) if "markers" in change else track.markers
    new = checked_track(track.inputs[:at] + inputs_of_json(change["keys"]) + track.inputs[to:], markers)
    if _sum(new) != change["sum"]:
        raise ValueError("an edit of another input track")
    return replace(new, made=Contributions.of_json(change["made"]) if "made" in change else NONE)


class Journal(RecoveryFile):
    """Writes the journal of one run, from its first edit on. ``opened``: its first line."""

    def __init__(self, folder: Path, opened: dict[str, Any], file: Path | None = None) -> None:
        super().__init__(folder / JOURNAL_FOLDER, JOURNAL_SUFFIX, file)
        self.opened = opened
        self._handle: int | None = None

    def note(self, line: dict[str, Any]) -> bool:
        """Write a line; whether that was possible."""
        with self.reporting():
            if self._handle is None:
                self._handle = self._open()
            # A line truncated by a full disk or a kill is completed by a line end first.
            data = b"\n" + json.dumps(line, separators=(",", ":")).encode()
            if os.write(self._handle, data) < len(data):
                raise FileError("the disk is full")
        return not self.problem

    def _open(self) -> int:
        self.lock()
        if not self.file.exists():
            write_atomically(self.file, json.dumps(self.opened, separators=(",", ":")))
        return os.open(self.file, os.O_WRONLY | os.O_APPEND)

    def begin_again(self, opened: dict[str, Any]) -> None:
        """The run was saved: earlier lines are no longer needed."""
        self.close()
        self.opened = opened

    def close(self, *, keep: bool = False) -> None:
        """End. ``keep``: keep the file for the next session."""
        if self._handle is not None:
            os.close(self._handle)
            self._handle = None
        super().close(keep=keep)


@dataclass(frozen=True)
class BesideRun:
    """Another run that is shown beside the one under edit."""

    name: str
    track: InputTrack
    made: Contributions

    def as_json(self) -> dict[str, Any]:
        return {"beside": self.name, "track": track_as_json(self.track), "made": self.made.as_json()}

    @classmethod
    def of_json(cls, kept: dict[str, Any]) -> Self:
        """The inverse of ``as_json``. Raises one of DAMAGED for anything else."""
        return cls(str(kept["beside"]), track_of_json(kept["track"]), Contributions.of_json(kept["made"]))


@dataclass(frozen=True)
class RecoveredRun:
    """The run of a crashed session. ``opened``: its first state; ``tracks``: after each edit.

    ``branches``: their last state; ``head``: the first line of the journal ``file``; ``beside``: the runs beside it.
    """

    opened: OpenedRun
    tracks: tuple[InputTrack, ...]
    branches: Branches
    head: dict[str, Any]
    file: Path
    beside: tuple[BesideRun, ...] = ()


def lost_runs(folder: Path) -> Iterator[RecoveredRun]:
    """The runs of sessions that crashed, the newest first; those of running sessions are left out."""
    return recovered_from(folder / JOURNAL_FOLDER, JOURNAL_SUFFIX, read_journal)


def read_journal(file: Path) -> RecoveredRun:
    """The edits in a journal; damaged lines are skipped.

    Raises one of DAMAGED for one whose first line is damaged, OSError.
    """
    with open_regular(file) as lines:
        header = json.loads(lines.readline())
        (recording,) = parse_replays(header["replay"])
        recording = replace(recording, file=str(header.get("source", "")))
        object_table(recording.level)
        path, digest, branches_digest = (str(header[key]) for key in ("path", "digest", "branches_digest"))
        run_file = run_file_of(Path(path), digest, branches_digest) if path else RunFile()
        tracks = [track_of_json(header["track"])]
        branches = branches_of_json(header["branches"])
        beside = [BesideRun.of_json(run) for run in header.get("beside", ())]
        for line in lines:
            with suppress(*DAMAGED):
                change = json.loads(line)
                if "beside" in change:
                    beside.append(BesideRun.of_json(change))
                elif "at" not in change:
                    branches.do(change)
                elif change.get("goes_on"):
                    tracks[-1] = edited(tracks[-1], change)
                else:
                    tracks.append(edited(tracks[-1], change))
    opened = OpenedRun(recording, tracks[0], run_file, branches_of_json(header["branches"]))
    return RecoveredRun(opened, tuple(tracks[1:]), branches, header, file, tuple(beside))
