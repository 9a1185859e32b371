"""Every edit on the disk as soon as it is made: a program that is killed loses at most the last one.

A journal is a text of JSON lines in the player's folder: first what was opened, then each edit as the ticks that it
replaces, and the branches whenever they change. It goes when the run is saved or left.
"""

from __future__ import annotations

import json
import os
import secrets
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ninja_game.errors import NinjaGameError
from ninja_game.files.locking import hold
from ninja_game.files.reading import read_utf8
from ninja_game.files.writing import write_atomically
from ninja_game.formats.recording import Recording, parse_replays
from ninja_game.formats.replay.input_runs import Marker
from ninja_game.tas.branches import Branches, branches_of_json
from ninja_game.tas.take import Take

FOLDER = "tas"
"""In the player's folder."""

_LOCK = ".lock"


def edit_as_json(old: Take, new: Take) -> dict[str, Any]:
    """What turns one take into another: the ticks from ``at`` to ``to`` - 1 are replaced by ``keys``."""
    at = old.first_difference(new)
    tail = first_difference_from_the_end(old.inputs[at:], new.inputs[at:])
    keys = new.inputs[at : len(new) - tail]
    change: dict[str, Any] = {"at": at, "to": len(old) - tail, "keys": "".join(f"{key:x}" for key in keys)}
    return change if old.markers == new.markers else change | {"markers": [list(each) for each in new.markers]}


def first_difference_from_the_end(ours: bytes, theirs: bytes) -> int:
    """How many bytes at the end are the same."""
    return Take(ours[::-1]).first_difference(Take(theirs[::-1]))


def edited(take: Take, change: dict[str, Any]) -> Take:
    """A take after an edit of a journal. Raises ValueError, KeyError, TypeError for what is none."""
    at, to = int(change["at"]), int(change["to"])
    if not 0 <= at <= to <= len(take):
        raise ValueError("an edit of ticks that there are not")
    keys = bytes(int(digit, 16) for digit in change["keys"])
    markers = take.markers
    if "markers" in change:
        markers = tuple(Marker(int(tick), str(name)) for tick, name in change["markers"])
    return Take(take.inputs[:at] + keys + take.inputs[to:], markers)


class Journal:
    """Writes the journal of one run, from its first edit on. ``problem``: why it cannot, or ''."""

    def __init__(self, folder: Path, opened: dict[str, Any], file: Path | None = None) -> None:
        self.problem = ""
        self.opened = opened
        self._folder = folder / FOLDER
        self._file = file or self._folder / f"{secrets.token_hex(6)}.jsonl"
        self._lock: int | None = None
        self._handle: int | None = None

    def edit(self, old: Take, new: Take) -> None:
        """Note an edit."""
        self._write(edit_as_json(old, new))

    def branches(self, branches: Branches) -> None:
        """Note all branches."""
        self._write(branches.as_json())

    def _write(self, line: dict[str, Any]) -> None:
        try:
            if self._handle is None:
                self._open()
            assert self._handle is not None  # noqa: S101 - made by _open
            os.write(self._handle, (json.dumps(line, separators=(",", ":")) + "\n").encode())
            self.problem = ""
        except (OSError, NinjaGameError) as error:
            self.problem = f"What you edit cannot be kept safe: {getattr(error, 'strerror', '') or error}"

    def _open(self) -> None:
        self._folder.mkdir(parents=True, exist_ok=True)
        if self._lock is None:
            self._lock = hold(self._file.with_suffix(_LOCK))
        if not self._file.exists():
            write_atomically(self._file, json.dumps(self.opened, separators=(",", ":")) + "\n")
        self._handle = os.open(self._file, os.O_WRONLY | os.O_APPEND)

    def begin_anew(self, opened: dict[str, Any]) -> None:
        """The run was saved: what was noted so far is no longer needed."""
        self.close()
        self.opened = opened

    def close(self, *, keep: bool = False) -> None:
        """End. ``keep``: what was noted stays, to be found by the next session."""
        for handle in (self._handle, self._lock):
            if handle is not None:
                os.close(handle)
        self._handle = self._lock = None
        if not keep:
            forget(self._file)


def forget(file: Path) -> None:
    """Remove a journal."""
    for each in (file, file.with_suffix(_LOCK)):
        with suppress(OSError):
            each.unlink(missing_ok=True)


@dataclass(frozen=True)
class Recovered:
    """What a session that has died was editing: takes, first to last, branches, and what was opened."""

    recording: Recording
    takes: tuple[Take, ...]
    branches: Branches
    opened: dict[str, Any]
    file: Path


def recovered(folder: Path) -> Iterator[Recovered]:
    """What sessions that have died were editing, the newest first; those of running sessions are left out."""
    with suppress(OSError):
        files = sorted((folder / FOLDER).glob("*.jsonl"), key=lambda path: -path.stat().st_mtime)
        for file in files:
            handle = hold(file.with_suffix(_LOCK))
            if handle is None:
                continue
            try:
                yield read_journal(file)
            except (ValueError, KeyError, TypeError, AttributeError, NinjaGameError):
                continue
            finally:
                os.close(handle)


def read_journal(file: Path) -> Recovered:
    """What a journal tells; a line that was cut, and what follows it, is left out.

    Raises ValueError, KeyError, TypeError, AttributeError or NinjaGameError for one that is damaged at its begin.
    """
    lines = read_utf8(file).splitlines()
    opened = json.loads(lines[0])
    (recording,) = parse_replays(opened["replay"])
    replay = recording.replay
    takes = [Take(recording.playback(recording.ticks), replay.markers if replay else ())]
    branches = branches_of_json(opened["branches"])
    with suppress(ValueError, KeyError, TypeError, AttributeError, NinjaGameError):
        for line in lines[1:]:
            change = json.loads(line)
            if "branches" in change:
                branches = branches_of_json(change)
            else:
                takes.append(edited(takes[-1], change))
    return Recovered(recording, tuple(takes), branches, opened, file)
