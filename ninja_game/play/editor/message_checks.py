"""What is wrong with messages on their page: in themselves, in their level, and in the level's known run."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

from ninja_game.editor.draft import Draft
from ninja_game.editor.message_rows import EditedMessages, MessageField, MessageRow
from ninja_game.formats.messages import LevelMessage, arrow_targets, parse_messages
from ninja_game.levels.findings import Finding
from ninja_game.levels.ground import Ground
from ninja_game.levels.lint import unseen_messages
from ninja_game.play.level.level_play import things_at_start
from ninja_game.runs.message_appearances import Appearance, appearances, late_hint, late_text, message_name, short_text
from ninja_game.runtime import NewestJob
from ninja_game.sim.level import Level
from ninja_game.simulation import Simulation
from ninja_game.view.places import Things

RunQuestion = tuple[tuple[LevelMessage, ...], Level, bytes, bool]
"""Messages, their level, the inputs of its known run, and whether texts name the switch or exit."""


class RunAnswer(NamedTuple):
    """When each message comes in that run, and what texts should not cover."""

    question: RunQuestion
    appearances: list[Appearance | None]
    things: Things


@lru_cache(maxsize=4)
def _things_of_run(level: Level, inputs: bytes, *, tagged: bool) -> Things:
    return things_at_start(level, Simulation(level).world, ["{exit}"] * tagged, inputs)


def _answer(question: RunQuestion) -> RunAnswer:
    messages, level, inputs, tagged = question
    return RunAnswer(question, appearances(messages, level, inputs), _things_of_run(level, inputs, tagged=tagged))


class MessageChecks:
    """Problems and remarks about messages under edit. The level's known run is played in the background.

    ``certifying_inputs``: gives those of the known run, if any. ``refused``: OK was, so an empty field is a problem.
    """

    def __init__(self, draft: Draft, edited: EditedMessages, certifying_inputs: Callable[[], bytes]) -> None:
        self.refused = False
        self._level = draft.level
        self._edited = edited
        self._certifying_inputs = certifying_inputs
        self._ground = Ground(draft.level)
        self.known_run: NewestJob[RunQuestion, RunAnswer] = NewestJob(_answer)
        self._asked: RunQuestion | None = None
        self._answer_is_news = False

    def ask_about_run(self) -> None:
        """Have the level's known run played with the messages as they are, unless that is done or under way."""
        inputs = self._certifying_inputs()
        messages = tuple(message for row in self._edited.valid for message in parse_messages(row.source))
        question = messages, self._level, inputs, self._has_targets
        if inputs and question != self._asked:
            self._asked = question
            self._answer_is_news = True
            self.known_run.ask(question)

    def has_new_answer(self) -> bool:
        """Whether the answer about the known run has come since this was called last."""
        came = self._answer_is_news and self.known_run.is_idle
        self._answer_is_news &= not came
        return came

    @property
    def _has_targets(self) -> bool:
        return bool(arrow_targets(row.text for row in self._edited.rows))

    @property
    def things(self) -> Things:
        """Things that a text should not cover; the route of the known run too, as soon as it is there.

        Raises LevelError for a level that cannot be played.
        """
        answer = self.known_run.result
        return answer.things if answer else _things_of_run(self._level, b"", tagged=self._has_targets)

    def appearance(self, row: MessageRow) -> Appearance | None:
        """When a message comes in the known run; None: never, without such a run, or not known yet."""
        answer = self.known_run.result
        if not answer or answer.question != self._asked:
            return None
        valid = self._edited.valid
        return answer.appearances[valid.index(row)] if row in valid else None

    def problem(self, row: MessageRow) -> str:
        """The problem of a message, "" if it has none. An empty field is one only after OK was refused."""
        field, problem = row.problem
        if row.unknown:
            return f"There is no {row.unknown[:20]}: the words are below"
        if problem:
            is_typed = field == MessageField.TIME or (field == MessageField.DETAIL and row.detail)
            return problem if self.refused or is_typed else ""
        for finding in self._unseen(row):
            return f"Never shown: {finding.text.rpartition(': ')[2]}"
        return _sentence(self._late_text(row, lost=True))

    def remark(self, row: MessageRow) -> str:
        """How late a message comes in the known run, or that it is too short to be read; '' if neither."""
        short = () if row.problem[1] else map(short_text, parse_messages(row.source))
        return _sentence(self._late_text(row, lost=False) or "".join(short))

    def advice(self, row: MessageRow) -> str:
        """How to mend what is wrong with a message; '' where its problem says so."""
        for finding in self._unseen(row):
            return finding.hint
        moment = self.appearance(row)
        return late_hint(moment) if moment else ""

    def _late_text(self, row: MessageRow, *, lost: bool) -> str:
        """That a message is lost to others in the known run, or else how late it is; '' if it is not."""
        moment = self.appearance(row) if self._edited.together(row)[0] is row else None
        if not moment or (moment.tick is None) is not lost:
            return ""
        names = [message_name(self._edited.rows.index(valid), valid.text) for valid in self._edited.valid]
        return late_text(moment, len(self._certifying_inputs()), names)

    def _unseen(self, row: MessageRow) -> list[Finding]:
        return [] if row.problem[1] else [*unseen_messages(row.source, self._ground)]


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]
