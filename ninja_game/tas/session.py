"""A run under edit: its input track with undo, its simulation, branches, file and journal, without a window."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from ninja_game.document import History, digest_of_file
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import write_replay
from ninja_game.tas.contributions import NONE, Contributions
from ninja_game.tas.files import OpenedRun, RunFile, has_tail, recording_of_track, save_run, unclaimed_replay
from ninja_game.tas.journal import BesideRun, Journal, RecoveredRun, edit_as_json
from ninja_game.tas.timeline import EMPTY_TRAJECTORY, Timeline, Trajectory
from ninja_game.tas.tracks import Branch, Branches, InputTrack, branch_as_json, track_as_json

TICKS_PER_FRAME = 6000  # ticks simulated at once after an edit on the compiled memory: some ms
TICKS_PER_FRAME_PLAIN = 2000
OPENED = "as it was opened"


class TasSession:
    """A run under edit. ``folder``: the player's, for the journal; ``player``: the editor of the run.

    ``origin``: level, body, name and author of the run; ``moved``: it was recorded on another level. ``before_track``:
    the run before the last edit; ``before``: its trajectory; ``beside``: other runs, for the journal. Raises
    LevelError for a level that cannot be played.
    """

    def __init__(self, opened: OpenedRun, folder: Path, *, player: str = "", memory: str = "auto") -> None:
        origin = opened.recording
        if origin.author and not origin.player:
            origin = replace(origin, replay=replace(origin.replay, author="", level_author=origin.level_author))
            opened = replace(opened, recording=origin)
        self.origin: Recording = origin
        self._first, self._player = opened, player
        self.file: RunFile = opened.file
        self.branches: Branches = opened.branches
        self.moved = opened.moved
        self.history: History[InputTrack] = History(opened.track)
        self.saved = opened.track
        self.beside: list[BesideRun] = []
        self._saved_branches = self._beside_run()
        self.timeline = Timeline(self.origin.level, opened.track.inputs, body=self.origin.body, memory=memory)
        self.before: Trajectory = EMPTY_TRAJECTORY
        self.before_track = opened.track
        self._journaled = opened.track
        self._file_differs = False
        self._stroke_journaled = False
        self._branches_journaled = True
        self._undone: Branch | None = None
        self.journal = Journal(folder, self._opened())
        self.timeline.simulate(self.ticks_per_frame)

    def _opened(self) -> dict[str, object]:
        origin = self._first.recording
        text = write_replay(unclaimed_replay(origin, self.track))
        path = str(self.file.path.absolute()) if self.file.path else ""
        source = origin.file
        with suppress(OSError):  # a name that no file system accepts
            source = str(Path(source).absolute()) if Path(source).is_file() else source
        return {
            "path": path, "digest": self.file.digest, "branches_digest": self.file.branches_digest, "source": source,
            "replay": text, "track": track_as_json(self.track), "branches": self.branches.as_json(),
            "beside": [run.as_json() for run in self.beside],
        }  # fmt: skip

    @property
    def track(self) -> InputTrack:
        return self.history.draft

    @property
    def at_home(self) -> Recording:
        """``origin`` in the file that the run has now; else where it was opened."""
        return self.origin if self.file.path is None else replace(self.origin, file=str(self.file.path), record=0)

    @property
    def name(self) -> str:
        return self.origin.name or "run"

    @property
    def is_saved(self) -> bool:
        """Whether the file holds the present run."""
        return self.is_run_saved and self._beside_run() == self._saved_branches

    @property
    def is_run_saved(self) -> bool:
        """Whether the file holds the keys and the markers; branches and watched values do not count."""
        return not self._file_differs and self.track == self.saved

    def _beside_run(self) -> tuple[list[Branch], tuple[str, ...]]:
        """What the file keeps beside the run: the branches, and the watched values."""
        return list(self.branches.all), self.branches.watched

    def tail_behind(self) -> str:
        """The end, "exit" or "dead", if keys or names of ticks follow it; else "".

        After a death they prevent a replay with claims; after an exit they are left out of the replay.
        """
        self.timeline.simulate(len(self.timeline))
        end, outcome = self.timeline.end
        return outcome if end >= 0 and has_tail(self.track, end + 1) else ""

    @property
    def ticks_per_frame(self) -> int:
        """Most ticks to simulate in one picture."""
        return TICKS_PER_FRAME if self.timeline.memory == "compiled" else TICKS_PER_FRAME_PLAIN

    # --- edits ---

    def begin(self) -> None:
        """Begin a stroke: all changes until its end are one edit."""
        self.end()
        self.history.begin()
        self._look_back()

    def change(
        self,
        track: InputTrack,
        *,
        ticks: int | None = None,
        taken: Contributions | None = None,
        whole: bool = False,
        edited: bool = True,
    ) -> None:
        """Set another track, as a part of the stroke or an edit of its own, and simulate a number of ticks.

        ``ticks``: None: as many as are quick; ``taken``: the contributions of copied keys, ``whole``: which replace
        all; ``edited``: by a person, who does more than take the result of a search in ``taken``.
        """
        if track == self.track:
            return
        if not self.history.in_stroke:
            self._look_back()
        if track.inputs != self.track.inputs and not self.history.can_undo:
            self._keep_opened()
        if self._undone is not None and self.history.can_redo:
            self._keep_undone(self._undone)
        began, opened = self.history.began, self._first.track
        made = (NONE if whole else self.track.made) + (taken or NONE)
        edits = max(began.made.edits, made.edits if whole else 0)
        if edited and track.inputs != began.inputs:
            edits += 1
        made = replace(made, edits=edits)
        self.history.change(replace(track, made=opened.made if track.inputs == opened.inputs else made))
        self._follow(ticks)

    def end(self) -> None:
        self.history.end()
        self._note()
        self._stroke_journaled = False

    def undo(self) -> bool:
        self.end()
        if not self.history.can_redo:
            self._undone = self._as_branch("undone") if self.timeline.is_complete else None
        return self._step(self.history.undo)

    def redo(self) -> bool:
        return self._step(self.history.redo)

    def _step(self, step: Callable[[], bool]) -> bool:
        self.end()
        before = self.timeline.trajectory(), self.track
        if not step():
            return False
        self.before, self.before_track = before
        self._follow()
        return True

    def _look_back(self) -> None:
        """Keep the state before an edit."""
        self.before = self.timeline.trajectory()
        self.before_track = self.track

    def _follow(self, ticks: int | None = None) -> None:
        """Simulate the input track, and write it to the journal."""
        self.timeline.set_inputs(self.track.inputs)
        self.timeline.simulate(self.ticks_per_frame if ticks is None else ticks)
        self._note()

    def _credit(self) -> None:
        """Set the provenance of the run: if its keys have changed, the edits since it was opened, and their author."""
        opened, made = self._first.recording, self.track.made
        self.origin = opened if made == NONE else made.credited(opened, self._player)

    def name_player(self, player: str) -> None:
        """Name the editor of the run, who was unknown so far."""
        self._player = player
        self._credit()

    def _note(self) -> None:
        """Append the changes to the journal. Changes that could not be written become part of the next line."""
        if self.track == self._journaled:
            return
        change = edit_as_json(self._journaled, self.track)
        self._credit()
        if self.journal.note(change | {"goes_on": True} if self._stroke_journaled else change):
            self._journaled = self.track
            self._stroke_journaled = self.history.in_stroke

    # --- branches ---

    def keep_branch(self, name: str) -> int:
        """Keep the input track as a branch; its number. Missing ticks are simulated first."""
        self._change_branches({"keep": branch_as_json(self._as_branch(name))})
        return len(self.branches) - 1

    def keep_version(self, name: str) -> None:
        """Keep the input track as a branch, or continue the branch with its keys."""
        inputs = [branch.track.inputs for branch in self.branches.all]
        if self.track.inputs not in inputs:
            self.keep_branch(name)
        else:
            self._change_branches({"checkout": inputs.index(self.track.inputs)})

    def _as_branch(self, name: str) -> Branch:
        self.timeline.simulate(len(self.timeline))
        end, outcome = self.timeline.end
        gold = self.timeline.column("gold")
        return Branch(name, self.track, self.branches.current, end, outcome, int(gold[end]) if len(gold) else 0)

    def _keep_undone(self, undone: Branch) -> None:
        """Keep the run that redo leads to, before an edit drops it: if neither the run nor a branch is as good."""
        self._undone = None
        known = [*self.branches.all, self._as_branch("")]
        if undone.outcome == "exit" and not any(track.is_as_good_as(undone) for track in known):
            kept = self.branches.as_json()
            # Branches may have been dropped since, which renumbers the others.
            kept["branches"].append(branch_as_json(replace(undone, parent=self.branches.current)))
            self._change_branches(kept)

    def _keep_opened(self) -> None:
        """Keep the run as it was opened as a branch, before its first edit; that alone leaves nothing to save."""
        saved = self._beside_run() == self._saved_branches
        inputs = self.track.inputs
        if inputs and all(branch.track.inputs != inputs for branch in self.branches.all):
            self.keep_branch(OPENED)
            self._saved_branches = self._beside_run() if saved else self._saved_branches

    def checkout_branch(self, number: int) -> None:
        """Make a branch the present run; undo restores the run before. Raises ArgumentError for an unknown one."""
        self.end()
        self._change_branches({"checkout": number})
        track = self.branches.all[number].track
        self.change(track, taken=track.made, whole=True)

    def drop_branch(self, number: int) -> None:
        """Delete a branch. Raises ArgumentError for an unknown one."""
        self._change_branches({"drop": number})

    def rename_branch(self, number: int, name: str) -> None:
        """Rename a branch. Raises ArgumentError for an unknown one."""
        self._change_branches({"rename": number, "name": name})

    def show_beside(self, run: BesideRun) -> None:
        """Keep another run in the journal, so that it is there again after a crash."""
        self.beside.append(run)
        if self.journal.file.exists():
            self.journal.note(run.as_json())
        else:
            self.journal.opened["beside"].append(run.as_json())

    def watch(self, formulas: Iterable[str]) -> None:
        self._change_branches({"watch": list(formulas)})

    def _change_branches(self, change: dict[str, Any]) -> None:
        """Make a change given in the journal's words, and write it there."""
        self.branches.do(change)
        self._branches_journaled = self.journal.note(change if self._branches_journaled else self.branches.as_json())

    def recording(self, track: InputTrack | None = None, name: str = "") -> Recording:
        """An input track (None: the present one) as a recording, for comparisons and searches."""
        return recording_of_track(self.origin, self.track if track is None else track, name)

    # --- files ---

    def save(self, path: Path, *, replacing: bool = False) -> None:
        """Write run and branches. Raises OccupiedError, FileError, OSError as ``save_run`` does, ArgumentError."""
        self.end()
        self.file = save_run(self.origin, self.track, self.branches, path, self.file, replacing=replacing)
        self.saved, self._saved_branches = self.track, self._beside_run()
        self._file_differs = False
        self.journal.begin_again(self._opened())

    def close(self, *, keep: bool = False) -> None:
        """End. ``keep``: unsaved work stays in the journal, for the next session."""
        self.end()
        self.journal.close(keep=keep and not self.is_saved)

    def recover(self, run: RecoveredRun) -> None:
        """Continue a crashed session of the same run; its edits can be undone.

        Raises FileError if another window has done so already.
        """
        journal = Journal(run.file.parent.parent, run.head, run.file)
        self.journal.close()
        self.journal = journal
        for track in run.tracks:
            self.history.change(track)
        self._credit()
        self.branches, self.beside = run.branches, list(run.beside)
        # The program may have crashed after writing the file, and before starting the journal again.
        self._file_differs = self.file.path is not None and digest_of_file(self.file.path) != self.file.digest
        self._journaled = self.track
        self._follow()
