"""What a queue of messages says while a test makes things happen in a world."""

from collections.abc import Callable, Mapping

from ninja_game.formats.ascii.reader import room_level
from ninja_game.runs.message_queue import MessageQueue
from ninja_game.sim.rules import CELL
from ninja_game.simulation import Simulation

FAR = 30  # a column far from the places of the messages


def texts_heard(
    queue: MessageQueue,
    ticks: int,
    events: Mapping[int, int] | None = None,
    column: Callable[[int], float] = lambda _: FAR,
) -> list[tuple[int, str]]:
    """The texts, and the ticks in which they come. ``events``: kinds by tick; ``column``: the ninja's, in row 22."""
    world, heard, events = Simulation(room_level(["#@..#"], ())).world, [], events or {}
    for tick in range(ticks):
        world.tick, world.ninja.x, world.ninja.y = tick, CELL * (column(tick) + 0.5), CELL * 22.5
        world.event_count, world.events[0].kind = int(tick in events), events.get(tick, 0)
        heard += [(tick, queue.text)] if queue.on_tick(world) else []
    return heard
