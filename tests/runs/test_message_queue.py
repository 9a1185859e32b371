"""The rules of the queue of messages: what replaces what is shown, what waits for it, and what comes again."""

import pytest

from ninja_game.formats.ascii.reader import room_level
from ninja_game.formats.messages import parse_messages
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.runs.message_queue import FADE_TICKS, START_TICKS, USUAL_TICKS, MessageQueue, in_two, read_ticks
from ninja_game.sim.events import EXIT_OPENED, GOLD_TAKEN, LOCK_OPENED, TRAP_CLOSED
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.simulation import Simulation
from tests.support.heard import FAR, texts_heard
from tests.support.players import short_level

COMES, READ, ENDS = 5 * TICKS_PER_SECOND, read_ticks("Shown"), 9 * TICKS_PER_SECOND
REPLACES, WAITS, QUEUES = "replaces", "waits", "queues"


def queue_of(says: str) -> MessageQueue:
    return MessageQueue(parse_messages(says))


# The table of MessageQueue: what comes, then what it does to no text, one that was read, an unread, an important one.
TABLE = {
    "lock": (REPLACES, REPLACES, REPLACES, QUEUES),
    "at 5,22": (REPLACES, REPLACES, REPLACES, WAITS),
    "after 5 s": (REPLACES, REPLACES, WAITS, WAITS),
    "lock!": (REPLACES, REPLACES, REPLACES, REPLACES),
    "at 5,22!": (REPLACES, REPLACES, REPLACES, REPLACES),
    "after 5 s!": (REPLACES, REPLACES, REPLACES, WAITS),
}


@pytest.mark.parametrize("shown", range(4), ids=["none", "read", "unread", "important"])
@pytest.mark.parametrize("moment", TABLE)
def test_what_comes_meets_what_is_shown_as_the_table_says(moment: str, shown: int) -> None:
    began = (COMES, COMES - READ, COMES - 9, COMES - 9)[shown]
    mark = "!" * (shown == 3)
    queue = queue_of(f"trap for 9 s{mark}: Shown | {moment}: New")
    events = {COMES: LOCK_OPENED} | ({began: TRAP_CLOSED} if shown else {})
    heard = texts_heard(queue, 900, events, lambda tick: 5 if tick >= COMES else FAR)
    due = {REPLACES: COMES, WAITS: began + READ, QUEUES: began + ENDS}[TABLE[moment][shown]]
    expected = [(began, "Shown")] * bool(shown) + [(due, "New")]
    assert heard[: len(expected)] == expected
    assert "Shown" not in [text for _, text in heard[1:]], "an event that was replaced is lost"


def test_important_against_important() -> None:
    """One that just happens replaces another, for good; a place that it replaces comes again, when that was read."""
    queue = queue_of("trap!: One | lock!: Two | at 5,22!: Here")
    events = {20: TRAP_CLOSED, 40: LOCK_OPENED}
    heard = texts_heard(queue, 40 + 2 * USUAL_TICKS, events, lambda tick: 5 if tick >= 30 else FAR)
    assert heard[:4] == [(20, "One"), (30, "Here"), (40, "Two"), (40 + read_ticks("Two"), "Here")]


@pytest.mark.parametrize("mark, first", [("", ["Now", "Time"]), ("!", ["Time", "Now"])])
def test_of_one_tick_what_happened_comes_before_a_time_unless_that_is_important(mark: str, first: list[str]) -> None:
    heard = texts_heard(queue_of(f"after 1 s{mark}: Time | lock: Now"), 900, {TICKS_PER_SECOND: LOCK_OPENED})
    assert [text for _, text in heard[:2]] == first
    assert heard[1][0] - heard[0][0] == (USUAL_TICKS if mark else read_ticks("Now"))


def test_each_text_has_its_moment() -> None:
    says = parse_messages("start: go | switch: open | gold: gold | death 2: wait")
    messages = MessageQueue(says)
    simulation = Simulation(short_level(gold=1))
    seen = [messages.text]
    for _ in range(60 + USUAL_TICKS):
        simulation.step_keys(2)
        if messages.on_tick(simulation.world):
            seen.append(messages.text)
    assert seen in (["go", "gold", "open"], ["go", "open", "gold"])
    for _ in range(START_TICKS + USUAL_TICKS):
        messages.on_tick(simulation.world)
    assert messages.text == ""
    messages.at_start()
    assert messages.text == "", "the switch was touched: the start needs no words any more"
    messages.on_death()
    messages.on_death()
    messages.at_start()
    assert messages.text == "wait"


def test_what_interrupts_a_text_of_the_start_ends_it_till_the_next_start() -> None:
    messages = queue_of("start: go | gold: gold")
    simulation = Simulation(parse_level_string("0" * 713 + "|5^100,566!0^120,566!11^400,564,500,564"))
    seen = []
    for tick in range(START_TICKS + USUAL_TICKS + 1):
        simulation.step_keys(2 if tick < 8 else 0)
        if messages.on_tick(simulation.world):
            seen.append((tick, messages.text))
    assert [text for _, text in seen] == ["gold", ""]
    messages.at_start()
    assert messages.text == "go"
    messages = queue_of("start: go | death 1: again")
    messages.on_death()
    messages.at_start()
    assert messages.text == "again"
    simulation.reset()
    assert [messages.text for _ in range(START_TICKS) if messages.on_tick(simulation.world)] == ["go", ""]


def test_several_texts_of_one_moment_are_said_one_after_the_other() -> None:
    says = "start: one | start: two | switch: three | switch: four"
    simulation = Simulation(parse_level_string("0" * 713 + "|5^100,566!0^120,566!11^400,564,700,564"))
    messages = queue_of(says)
    heard = [(0, messages.text)]
    simulation.step_keys(0)
    ticks = range(1, START_TICKS + 9)
    heard += [(tick, messages.text) for tick in ticks if messages.on_tick(simulation.world)]
    assert heard == [(0, "one"), (START_TICKS // 2, "two"), (START_TICKS, "")]
    messages.at_start()
    simulation.world.events[0].kind, simulation.world.event_count = EXIT_OPENED, 1
    assert messages.on_tick(simulation.world)
    simulation.world.event_count = 0
    heard = [(tick, messages.text) for tick in range(START_TICKS) if messages.on_tick(simulation.world)]
    assert messages.text == ""
    assert [text for _, text in heard] == ["four", ""], "and no more of the start, which is understood"
    quick = queue_of("switch: one | switch: two | gold: three")
    texts = []
    for kind in (EXIT_OPENED, GOLD_TAKEN, None):
        simulation.world.event_count = int(kind is not None)
        simulation.world.events[0].kind = kind or 0
        texts += [quick.text for _ in range(1 if kind else 2 * START_TICKS) if quick.on_tick(simulation.world)]
    assert texts == ["one", "three", "two", ""], "what has just happened comes at once, and takes nothing away"


def test_a_place_has_its_bubble_beside_what_just_happened_and_neither_waits() -> None:
    long = ("Gold adds two seconds to the clock; " * 3).strip()
    happens, places = in_two(parse_messages(f"start: go | gold: {long} | lock: open | at 3,22: Here | trap: shut"))
    events = {0: GOLD_TAKEN, 40: TRAP_CLOSED, 50: LOCK_OPENED}
    heard, beside = (
        texts_heard(MessageQueue(some), 2 * START_TICKS, events, lambda tick: 3 if 60 < tick < 300 else FAR)
        for some in (happens, places)
    )
    assert read_ticks(long) == 8 * TICKS_PER_SECOND
    assert heard[:3] == [(0, long), (40, "shut"), (50, "open")], "the newest, at once"
    assert beside == [(61, "Here"), (299 + FADE_TICKS, "")], "as long as the ninja is there"


def test_who_runs_past_two_places_sees_both_and_the_first_again_on_the_way_back() -> None:
    """At three cells in ten ticks; both need three seconds to be read."""
    queue = queue_of("at 5,22: One | at 11,22: Two")
    heard = texts_heard(queue, 80, column=lambda tick: min(tick, 80 - tick) * 0.3)
    assert heard == [(9, "One"), (29, "Two"), (55, "One")], "at the edges of their frames"


@pytest.mark.parametrize("marks, texts", [("", ["One", "Two", "One", ""]), ("!", ["One", "Two", ""])])
def test_of_two_places_with_the_ninja_the_one_reached_last_comes_first_unless_one_is_important(
    marks: str, texts: list[str]
) -> None:
    queue = queue_of(f"at 5,22{marks}: One | at 7,22: Two")
    heard = texts_heard(queue, 1000, column=lambda tick: 4 if tick < 20 else 6)
    read = read_ticks("One")
    assert heard[:2] == [(0, "One"), (read if marks else 20, "Two")]
    assert [text for _, text in heard][: len(texts) - 1] == texts[:-1]
    if not marks:
        assert heard[2] == (20 + read, "One"), "it was not read, and the ninja is still there"


def test_two_texts_of_one_place_come_one_after_the_other() -> None:
    heard = texts_heard(queue_of("at 3,22: One | at 3,22: Two"), 600, column=lambda _: 3)
    assert heard == [(0, "One"), (USUAL_TICKS, "Two")]


def test_what_a_death_kept_from_being_said_is_said_when_it_happens_again() -> None:
    queue = queue_of("gold: one | gold: two")
    assert texts_heard(queue, 1, {0: GOLD_TAKEN}) == [(0, "one")]
    queue.on_death()
    queue.at_start()
    assert queue.text == ""
    assert texts_heard(queue, 1, {0: GOLD_TAKEN}) == [(0, "two")]


def test_a_time_that_was_replaced_before_it_was_read_comes_again() -> None:
    queue, need = queue_of("after 1 s: Time | gold: Gold | trap: Shut"), read_ticks("Gold")
    heard = texts_heard(queue, 5 * USUAL_TICKS, {1: GOLD_TAKEN, 150: TRAP_CLOSED})
    assert heard[:4] == [(1, "Gold"), (1 + need, "Time"), (150, "Shut"), (150 + need, "Time")]


def test_what_just_happened_waits_until_an_important_message_was_read() -> None:
    queue = queue_of("start: Go on | lock!: One | gold: Gold | trap!: Shut")
    heard = texts_heard(queue, 9 * USUAL_TICKS, {0: LOCK_OPENED, 20: GOLD_TAKEN, 40: TRAP_CLOSED})
    assert heard[:2] == [(0, "One"), (40, "Shut")], "another important one replaces it, no gold"
    assert [text for _, text in heard[2:]] == ["Gold", ""]


def test_all_gold_and_a_number_of_gold_have_their_moments() -> None:
    level = parse_level_string("0" * 713 + "|5^100,566!0^200,566!0^300,566!0^400,566!11^700,64,700,264")
    run, came = Simulation(level), dict[str, int]()
    queues = [MessageQueue([message]) for message in parse_messages("all gold: All | gold 2: Two | gold: One")]
    for _ in range(200):
        run.step_keys(2)
        came |= {queue.text: run.world.gold for queue in queues if queue.on_tick(run.world)}
    assert came == {"One": 1, "Two": 2, "All": 3}


def test_text_comes_after_its_seconds_once_and_stays_as_long_as_it_says() -> None:
    queue = queue_of("after 2 s for 3 s: slide")
    for times in (1, 0):
        heard = texts_heard(queue, 10 * TICKS_PER_SECOND)
        assert heard == [(2 * TICKS_PER_SECOND, "slide"), (5 * TICKS_PER_SECOND, "")] * times
        queue.at_start()


def test_text_at_a_place_is_said_there_only() -> None:
    assert texts_heard(queue_of("at 3,22: here"), 1, column=lambda _: 3) == [(0, "here")]
    assert texts_heard(queue_of("at 8,22: there"), 99, column=lambda _: 3) == []


@pytest.mark.parametrize(
    "source, stays, ticks",
    [
        ("", 0, read_ticks("Here") + FADE_TICKS), ("", 500, 500 + FADE_TICKS),
        (" for 1.5 s", 0, 60), (" for 1.5 s", 500, 60),
    ],
)  # fmt: skip
def test_text_at_a_place_fades_when_the_ninja_has_left_and_it_was_read(source: str, stays: int, ticks: int) -> None:
    queued = queue_of(f"at 3,22{source}: Here")
    ninja = (world := Simulation(room_level(["#@..#"], ())).world).ninja
    ninja.x, ninja.y = 84.0, 540.0
    assert queued.on_tick(world)
    solid: list[float] = []
    while queued.text:
        ninja.x = 84.0 + 61 * (len(solid) >= stays)
        solid.append(min(1.0, queued.ticks_left / FADE_TICKS))
        queued.on_tick(world)
    assert len(solid) == pytest.approx(ticks, abs=2)
    assert solid[:-FADE_TICKS] == [1.0] * (len(solid) - FADE_TICKS)
    assert solid[-FADE_TICKS:] == sorted(solid[-FADE_TICKS:], reverse=True)
    assert solid[-1] < 0.1


def test_a_place_has_a_frame_of_its_size_and_a_wall_hides_it() -> None:
    room = Simulation(room_level(["#........#", "##########", "#@.......#"], ()))
    ninja = room.world.ninja
    middle, floor, above = 24 * 6 + 12.0, ninja.y, ninja.y - 48
    for source, x, y, seen in (
        ("at 6,3", middle, above, False), ("at 6,3", middle, floor, True), ("at 6,3", middle - 50, floor, True),
        ("at 6,3 3x1", middle - 50, floor, False), ("at 6,3 3x1", middle + 30, floor, True),
        ("at 6,2", middle + 30, above, True), ("at 6,3", middle - 70, floor, False),
        ("at 6,3 7x1", middle - 70, floor, True),
    ):  # fmt: skip
        queued = MessageQueue(parse_messages(f"{source}: Here"), room.tiles)
        ninja.x, ninja.y = x, y
        assert queued.on_tick(room.world) is seen, (source, x, y)


def test_a_place_is_said_once_and_again_only_if_the_try_ended_before_it_was_read() -> None:
    queue = queue_of("at 3,22: Here")
    assert queue.place is None
    for ticks, heard in ((20, ["Here"]), (70, ["Here"]), (50, ["Here"]), (20, [])):  # the third try is long enough
        assert [text for _, text in texts_heard(queue, ticks, column=lambda _: 3)] == heard
        assert queue.place == ((84.0, 540.0) if heard else None)
        queue.on_death()
        queue.at_start()
        assert (queue.text, queue.place) == ("", None)
    queue.say_again()
    assert texts_heard(queue, 1, column=lambda _: 3) == [(0, "Here")]


def test_the_text_of_the_start_stays_in_its_place_while_it_is_shown() -> None:
    queue = queue_of("start: Go")
    assert queue.is_start
    assert not texts_heard(queue, 1, {0: EXIT_OPENED})
    assert (queue.text, queue.is_start) == ("Go", True), "it may lie where it did"
    queue.at_start()
    assert queue.text == ""


def test_a_locked_door_and_a_trap_have_their_words() -> None:
    heard = texts_heard(queue_of("lock: The door is open | trap: Shut"), 99, {0: LOCK_OPENED, 9: TRAP_CLOSED})
    assert heard == [(0, "The door is open"), (9, "Shut")]


def test_a_text_is_read_in_two_seconds_and_one_more_for_every_20_letters() -> None:
    assert [read_ticks("x" * long) for long in (20, 21)] == [3 * TICKS_PER_SECOND, 4 * TICKS_PER_SECOND]
