"""Forged recordings by what is wrong with them, each with the field or the words that tell."""

from dataclasses import replace
from itertools import repeat

from ninja_game import parse_level, record_replay, write_replay
from ninja_game.formats.n14.demo import write_demo
from ninja_game.formats.replay.headers import Waypoint
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.formats.replay.text import Replay
from ninja_game.sim.inputs import Demo
from ninja_game.sim.level import Body
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from tests.support.legacy_demos import write_legacy_demo
from tests.support.samples import SPIKED, WALK, WALK_END, replay_of_walk

RIGHT, JUMP, TRIGGER = 2, 4, 8
WALKING = bytes([RIGHT] * WALK_END)
LATE = bytes(LIFETIME + 100) + WALKING
EASY = WALK.replace("11^160,564,130,564", "11^104,566,102,566")
GOLD_LATER = WALK.replace("0^115,566", "0^140,566")
LAST_START = LIFETIME + GOLD_BONUS - WALK_END - 1
"""Ticks that the ninja may stand still: gold lies within its reach, and it exits in the last tick of its life."""
EVERY_TICK = bytes([JUMP + TRIGGER] * 5)
BELL = "\x1b[2J\x1b[31mok   exit\nok   exit       tick 1"


def record(frames: bytes = WALKING, level: str = WALK, name: str = "Walk", demo: str = "") -> str:
    """A record as N's programs write it."""
    return f"${name}#me#test#{level}#{demo or write_demo(Demo(frames, float(len(frames))))}#\n"


PRACTISED = Provenance(played=True, assists=("practice",))


def replay(frames: bytes = WALKING + b"\2", level: str = WALK, *, body: Body = "circle", **lies: object) -> str:
    """A replay of ours that tells the truth about these inputs, but for the lies."""
    honest: Replay = record_replay(parse_level(level), frames, body=body, name="walk")
    return write_replay(replace(honest, **lies))  # type: ignore[arg-type]


def waypoint(tick: int = 10, x: float = 0.0, y: float = 566.0, state: str = "running") -> tuple[Waypoint, ...]:
    """One waypoint, which the run misses."""
    return (Waypoint(tick, x, y, state),)


def without_level(text: str, path: str) -> str:
    """A replay's text whose level is to be read from a file."""
    head = text.partition("level-data:")[0]
    lines = [line for line in head.splitlines() if not line.startswith("level-digest")]
    return "\n".join([lines[0], f"level: {path}", *lines[1:], "end"]) + "\n"


FORGERIES = {
    # Another level than the one that counts.
    "an easier level under the same name": (record(b"\2\2", EASY), "level_digest"),
    "one piece of gold more": (record(level=WALK + "!0^120,566"), "level_digest"),
    "one piece of gold less": (record(level=WALK.replace("!0^115,566", "")), "level_digest"),
    "a mine taken out": (record(level=SPIKED.replace("12^130,566!", "") + "!11^160,564,130,564"), "level_digest"),
    "a tile changed": (record(level="1" + WALK[1:]), "level_digest"),
    "a start that is a trillionth nearer": (
        record(level=WALK.replace("5^100,", "5^100.000000000001,")),
        "level_digest",
    ),
    "a second ninja": (record(level=WALK + "!5^150,566"), "level_digest"),
    "another order of the objects": (
        record(level="|".join([WALK[:713], "!".join(WALK[714:].split("!")[::-1])])),
        "level_digest",
    ),
    "the name of a level of ours": (record(b"\2\2", EASY, name="First steps"), "level_digest"),
    "an easier level in a replay of ours": (replay(b"\2\2\2", EASY), "level_digest"),
    "the digest of the right level with another one": (
        replay(b"\2\2\2", EASY)
        .replace("rules:", f"level-digest: {'5' * 64}\nrules:")
        .replace("level-digest", "level-digest", 1),
        "given twice",
    ),
    "an easier level by path": (without_level(replay(b"\2\2\2", EASY), "easy.txt"), "level_digest"),
    "a path out of the archive": (without_level(replay(), "../../../../etc/passwd"), "level"),
    "a device as level": (without_level(replay(), "../../../../../../dev/zero"), "level"),
    "no level at all": (record(level=""), "leaves its level out"),
    # Not at the exit.
    "stops a tick before the exit": (record(WALKING[:-1]), "outcome"),
    "nothing but standing": (record(bytes(60)), "outcome"),
    "runs the other way": (record(bytes([1] * 60)), "outcome"),
    "dies on a mine": (record(bytes([RIGHT] * 60), SPIKED), "outcome"),
    "dies and says so": (replay(bytes([RIGHT] * 60), SPIKED), "outcome"),
    "is still running and says so": (replay(WALKING[:-3]), "outcome"),
    "a legacy demo that goes nowhere": (record(demo=write_legacy_demo(Demo(bytes([1] * 20), 20))), "outcome"),
    "an escape sequence in the name of a failing run": (record(bytes(9), name=BELL.replace("\n", "")), "outcome"),
    "rows of its own in the name of a failing run": (replay(WALKING[:-3], name=BELL), "outcome"),
    "text that turns around in the name": (record(bytes(9), name="\u202etixe"), "outcome"),
    # Keys that no keyboard has.
    "a jump triggered in every tick": (record(EVERY_TICK + WALKING), "possible_by_keyboard"),
    "held without a trigger": (record(bytes([JUMP]) + WALKING), "possible_by_keyboard"),
    "triggered without being held": (record(bytes([TRIGGER]) + WALKING), "possible_by_keyboard"),
    "triggered in the second tick of being held": (
        record(bytes([JUMP, JUMP + TRIGGER]) + WALKING),
        "possible_by_keyboard",
    ),
    "triggered twice while it is held": (record(bytes([12, 4, 4, 12, 4]) + WALKING), "possible_by_keyboard"),
    "the last sampled tick triggers": (record(WALKING[:-1] + bytes([RIGHT + TRIGGER])), "possible_by_keyboard"),
    "a replay of ours that triggers in every tick": (replay(EVERY_TICK + WALKING + b"\2"), "possible_by_keyboard"),
    "a replay of ours that holds without a trigger": (replay(bytes([JUMP]) + WALKING + b"\2"), "possible_by_keyboard"),
    # Out of time.
    "the exit long after the lifetime": (record(LATE), "in_time"),
    "the exit a tick after the lifetime": (record(bytes(LAST_START + 1) + WALKING), "in_time"),
    "gold that comes too late": (record(bytes(LIFETIME - 10) + WALKING, GOLD_LATER), "in_time"),
    "a replay of ours after the lifetime": (replay(LATE + b"\2"), "in_time"),
    # Cut demos.
    "half of its words": (record(demo="23:35791394"), "complete"),
    "no words": (record(demo="23:"), "complete"),
    "one word too few, where the exit is reached all the same": (
        record(demo="29:" + "|".join(repeat("35791394", 4))),
        "complete",
    ),
    "inputs alone of a cut demo": (
        replay_of_walk(outcome="", gold=0, digest="", inputs=WALKING, demo_length=WALK_END + 9.0),
        "complete",
    ),
    "an absurd length": (record(demo="9e99:" + "|".join(repeat("35791394", 5))), "complete"),
    "an endless length": (record(demo="1e999:" + "|".join(repeat("35791394", 5))), "complete"),
    "a negative length": (record(demo="-23:" + "|".join(repeat("35791394", 4))), "outcome"),
    "a length that is none": (record(demo="2-3:" + "|".join(repeat("35791394", 4))), "outcome"),
    "a word that is none": (record(demo="23:35791394|x|35791394"), "no demo"),
    "a broken legacy demo": (record(demo="A\x01\x02"), "no demo"),
    # Claims of a replay of ours.
    "gold that was not collected": (replay_of_walk(gold=2), "gold"),
    "gold that is hidden": (replay_of_walk(gold=0), "gold"),
    "more gold than there is": (replay_of_walk(gold=999_999_999), "gold"),
    "a death that was none": (replay_of_walk(outcome="dead"), "outcome"),
    "an exit that was none": (replay(WALKING[:-3], outcome="exit"), "outcome"),
    "an end too early": (replay_of_walk(final_tick=WALK_END - 2, inputs=WALKING[:-1]), "outcome"),
    "an end too late": (replay_of_walk(final_tick=WALK_END + 5), f"tick {WALK_END}: the run ends here"),
    "a digest of nothing": (replay_of_walk(digest="0" * 64), "digest"),
    "the digest of another run": (replay_of_walk(inputs=b"\1" + WALKING, final_tick=WALK_END + 1), "digest"),
    "a waypoint elsewhere": (replay(waypoints=waypoint()), "ninja: x"),
    "a waypoint that is not a number": (replay(waypoints=waypoint(x=float("nan"))), "ninja: x"),
    "a waypoint in another state": (replay(waypoints=waypoint(x=112.0, state="dead")), "ninja"),
    "rules of tomorrow": (replay_of_walk(rules=99), "rules"),
    "rules of yesterday": (replay_of_walk(rules=0), "rules"),
    "the box instead of the circle": (replay(body="box"), "body"),
    "a circle that is said to be a box": (replay_of_walk(body="box"), "body"),
    "practice": (replay(made=PRACTISED), "practice"),
    "a practice mark of older texts": (replay().replace("outcome:", "practice: yes\noutcome:"), "practice"),
    "a practice mark that is none": (replay().replace("outcome:", "practice: maybe\noutcome:"), "practice"),
    "two ends": (replay().replace("outcome:", "outcome: exit\noutcome:", 1), "given twice"),
    "a format of yesterday": (replay().replace("replay 3", "replay 1", 1), "unknown version"),
    "a format of tomorrow": (replay().replace("replay 3", "replay 9", 1), "version"),
}
