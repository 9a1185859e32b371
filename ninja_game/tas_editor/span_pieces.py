"""Pieces of a span: proposed for single searches where the search of all of it finds nothing better."""

from __future__ import annotations

from ninja_game.formats.recording import Recording
from ninja_game.runs.splits import Split, run_splits
from ninja_game.runtime import NewestJob
from ninja_game.search.formula.task import SpanTask
from ninja_game.tas.goals import GOALS, RunPiece, SearchedSpan, SpanGoal, span_pieces
from ninja_game.tas.tracks import InputTrack
from ninja_game.tas_editor.editor import TasEditor

WITHOUT_REST = "End at the goal, not then the rest"

Cut = tuple[InputTrack, Recording]
Splits = tuple[InputTrack, tuple[Split, ...]]


class SpanPieces:
    """The pieces of a span in the present run. ``pieces``: () until ``refresh`` has them, and again after an edit.

    ``task``: the search of the span that found nothing.
    """

    def __init__(self, editor: TasEditor, task: SpanTask) -> None:
        self._editor, self._span = editor, (task.first, task.last)
        self._goal_alone = task.goal if task.rest else ""
        self.pieces: tuple[RunPiece, ...] = ()
        self._cut_track: InputTrack | None = None  #: the run that was cut into these pieces
        self._requested_track: InputTrack | None = None  #: the run whose splits were last asked for
        self._splits = NewestJob[Cut, Splits](lambda cut: (cut[0], run_splits(cut[1], tuple(GOALS)).splits))

    def refresh(self) -> None:
        session, track, splits = self._editor.session, self._editor.track, self._splits.result
        if self._cut_track is track:
            return
        self.pieces = ()
        if splits is not None and splits[0] is track:
            pieces = span_pieces(SearchedSpan(session, *self._span), splits[1])
            if self._goal_alone and self._span[1] <= len(track):
                pieces.insert(1, RunPiece(*self._span, WITHOUT_REST, SpanGoal(self._goal_alone)))
            self._cut_track, self.pieces = track, tuple(pieces)
        elif self._requested_track is not track:
            self._requested_track = track
            self._splits.ask((track, session.recording()))  # in a thread: runs may be long
