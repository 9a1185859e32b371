"""When the messages of a level come in a known run, and those that come too late or too short there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import NamedTuple

from ninja_game.formats.messages import LevelMessage, Moment, parse_messages
from ninja_game.levels.findings import LEVEL_WORDINGS, Finding, level_finding
from ninja_game.runs.message_queue import MessageQueue, in_two, read_ticks
from ninja_game.sim.grid import Point, cell_of
from ninja_game.sim.level import Level
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.simulation import Simulation

_GLANCE = TICKS_PER_SECOND  # ticks in which nobody reads a message
_CUT_HINT = "Shorten this one, make it important, or move one of the two."


class Appearance(NamedTuple):
    """The tick in which a message comes in a run, and the ninja's place then, px."""

    due: int  #: the tick in which it comes as the only one, from 0
    tick: int | None  #: the tick in which it comes beside the other messages; None: they displace it
    spot: Point  #: of the ninja then
    cut: int = 0  #: the ticks after which another replaces it before it was read; 0: none does
    event: Point | None = None  #: the place of the event that it is about, px
    other: int = -1  #: the number of the message that replaces it, or is read when it should come; -1: none


def appearances(messages: Sequence[LevelMessage], level: Level, inputs: bytes) -> list[Appearance | None]:
    """The moment of each message in a run; None if it never comes."""
    # Only the lengths of the texts matter, in steps of 20 letters: what is typed seldom runs the level again.
    texts = [str(number).ljust(-(-len(message.text) // 20) * 20) for number, message in enumerate(messages)]
    numbered = tuple(message._replace(text=text) for message, text in zip(messages, texts, strict=True))
    together, alone = _first_shown(numbered, level, inputs)
    comings: list[Appearance | None] = []
    for message, text in zip(messages, texts, strict=True):
        wanted, coming = alone.get(text), together.get(text)
        if wanted is None or coming is None:
            comings.append(wanted and Appearance(wanted.tick, None, wanted.spot, other=int(wanted.other or -1)))
        else:
            # A level waits at its start: its messages there can be read before the run.
            need = _GLANCE if message.when == Moment.START else read_ticks(text)
            is_cut = coming.ticks < min(wanted.ticks, need)
            other = int((coming if coming.tick - wanted.tick < TICKS_PER_SECOND else wanted).other or -1)
            cut = coming.ticks if is_cut else 0
            comings.append(Appearance(wanted.tick, coming.tick, coming.spot, cut, coming.event, other))
    return comings


def late_text(moment: Appearance, ticks: int, names: Sequence[str]) -> str:
    """The reason why a message cannot be read in time in a level's known run of ``ticks``; '' without one."""
    other = names[moment.other] if moment.other >= 0 else "another message"
    run = f"in the known run ({ticks / TICKS_PER_SECOND:.1f} s)"
    if moment.tick is None:
        return f"not shown {run}: {other} is read then"
    late = (moment.tick - moment.due) // TICKS_PER_SECOND
    if late:
        return f"{late} s late {run}: {other} is read first"
    after = f"after {moment.cut / TICKS_PER_SECOND:.1f} s"
    return f"replaced by {other} {after} {run}, too soon" if moment.cut else ""


def late_hint(moment: Appearance) -> str:
    """How to mend what ``late_text`` says; '' where it says nothing."""
    if moment.tick is None or moment.tick - moment.due >= TICKS_PER_SECOND:
        return LEVEL_WORDINGS["late-message"].hint
    return _CUT_HINT if moment.cut else ""


def message_name(number: int, text: str) -> str:
    """A message by its number, from 0, and its first words."""
    words = " ".join(text.split())
    return f"message {number + 1} '{words if len(words) <= 24 else words[:21].rstrip() + '...'}'"


def short_text(message: LevelMessage) -> str:
    """That a message's own time is far too short for its letters; '' if it is not."""
    letters, need = len(message.text), read_ticks(message.text) // TICKS_PER_SECOND
    return f"too short to read: {letters} letters need {need} s" if 0 < 3 * message.seconds < need else ""


def late_messages(level: Level, says: str, inputs: bytes) -> Iterator[Finding]:
    """Findings about messages that others displace in the known run, except those after another of their moment."""
    messages, past = parse_messages(says), set[tuple[object, ...]]()
    comings = appearances(messages, level, inputs) if inputs else []
    names = [message_name(number, message.text) for number, message in enumerate(messages)]
    for number, (message, coming) in enumerate(zip(messages, comings, strict=False)):
        moment = message.when, message.number, message.cell
        if coming and coming.tick is None and moment not in past:
            cell, why = cell_of(*(message.place or coming.spot)), late_text(coming, len(inputs), names)
            yield level_finding("late-message", cells=(cell,), message=number, text=message.one_line, why=why)
        past.add(moment)


class _Coming(NamedTuple):
    """A text that comes: the tick, the ninja's place then, px, and the ticks for which it is shown."""

    tick: int
    spot: Point
    event: Point | None  #: the place of the event that it is about, px
    ticks: int = 0
    other: str = ""  #: the text that follows it; of a message alone, the one that is shown then


_Comings = dict[str, _Coming]


@lru_cache(maxsize=256)
def _first_shown(messages: tuple[LevelMessage, ...], level: Level, inputs: bytes) -> tuple[_Comings, _Comings]:
    """The moments of texts in a run: of all together, and of each as if it were the only one."""
    run = Simulation(level)
    together, alone = _Comings(), _Comings()
    all_of_kind = [MessageQueue(some, run.tiles) for some in in_two(messages)]
    queues = [(queue, together, queue) for queue in all_of_kind]
    queues += [(MessageQueue([m], run.tiles), alone, all_of_kind[bool(m.place)]) for m in messages]
    for tick, keys in enumerate(inputs):
        run.step_keys(keys)
        for queue, comings, shown in queues:
            before = queue.text
            queue.on_tick(run.world)
            if queue.text != before and before in comings:
                comings[before] = comings[before]._replace(other=comings[before].other or queue.text)
            ninja, other = (run.world.ninja.x, run.world.ninja.y), "" if shown is queue else shown.text
            event = queue.message and queue.event_places.get(queue.message)
            coming = comings.get(queue.text) or _Coming(tick, ninja, event, 0, other)
            comings[queue.text] = coming._replace(ticks=coming.ticks + 1)
    return together, alone
