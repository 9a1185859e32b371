"""What is legal but odd: every warning once, and none for proper levels."""

import math
import re
import time
from collections.abc import Sequence
from pathlib import Path

import pytest

from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.levels import lint
from ninja_game.levels.findings import DESIGN_WORDINGS, LEVEL_WORDINGS, PACK_WORDINGS, RUN_WORDINGS, Wording
from ninja_game.levels.ground import Ground
from ninja_game.levels.lint import level_findings, level_warnings, object_name
from ninja_game.sim import kinds
from ninja_game.sim.level import ROWS, TILES, Level, ObjectSpec
from ninja_game.simulation import Simulation
from tests.support.recorded import hold_against
from tests.support.reference import levels

GOLDEN = Path(__file__).parent / "golden" / "warnings.txt"

PROPER = (ObjectSpec(kinds.NINJA, (36.0, 564.0)), ObjectSpec(kinds.EXIT, (700.0, 564.0, 300.0, 564.0)))


def warnings_of(*lines: str, rows: dict[int, str] | None = None, keep: bool = True) -> list[str]:
    """Warnings of a level with a ninja and an exit (unless ``keep`` is false), these rows and these lines."""
    drawn = {23: "@...x...X"} if keep else {}
    drawn.update(rows or {})
    picture = ["|" + drawn.get(row, "").ljust(31, ".") + "|" for row in range(1, 24)]
    return level_warnings(parse_ascii_level("\n".join(["ninja-game level 1", *picture, *lines])).level)


CASES: dict[str, tuple[list[str], dict[int, str]]] = {
    "outside the grid": (["gold 900,100px"], {}),
    "not a number": (["mine 100,nanpx"], {}),
    "wrong count": (["raw 12 100"], {}),
    "unknown type": (['raw "77^1,2"'], {}),
    "ninja with a wrong count": (["raw 5 100"], {}),
    "several ninjas": (["ninja 5.5,5"], {}),
    "turret in a tile": (["gauss turret 1,1"], {1: "#"}),
    "launcher in a tile": (["homing launcher 1,1"], {1: "#"}),
    "drone in a tile": (["zap drone 1,1 wander-cw right"], {1: "#"}),
    "thwump in a tile": (["thwump 1,1 down"], {1: "#"}),
    "mine in a tile": (["mine 1,1"], {1: "#"}),
    "pad in a tile": (["launch pad 1.5,1 up-right"], {1: "##"}),
    "mine in the border": (["mine 32,5"], {}),
    "mine on the ninja": (["mine 1.5,23"], {}),
    "two pieces of gold in one place": (["gold 5,5 6,5 5,5"], {5: "....oo"}),
    "a line twice": (["launch pad 5,5.25 up"] * 4, {}),
    "gold behind walls": ([], {1: "o#", 2: "##"}),
    "what does nothing untouched, behind walls": (["mine 134,36px"], {1: "^#B#8#", 2: "######"}),
    "what does nothing untouched, but is touched": ([], {1: ".#.#", 2: "#^#B#.8", 3: ".#.#"}),
    "pad with a long normal": (["launch pad 5.5,5 normal 0,-2"], {}),
    "one-way with an odd direction": (["raw 7 132,132,4"], {}),
    "thwump with an odd direction": (["raw 8 132,132,nan"], {}),
    "guard in the border": (["floor guard 0,5"], {}),
    "guard in a tile": (["floor guard 1,1"], {1: "#"}),
    "guard in the air": ([], {5: "n"}),
    "drone with an odd weapon": (["raw 6 132,132,1,0,3,0"], {}),
    "drone with an odd movement": (["raw 6 133,132,6,0,0,0"], {}),
    "drone with an odd direction": (["raw 6 133,132,1,0,0,-1"], {}),
    "drone with an odd flag": (["raw 6 133,132,1,2,0,1"], {}),
    "laser that seeks": (["laser drone 5.5,5 wander-cw right seeker"], {}),
    "drone closed in": (["zap drone 2,2 wander-cw right"], {1: ".#", 2: "#Z#", 3: ".#"}),
    "drone closed in by a door": (
        ["zap drone 2,2 wander-cw right", "automatic door 2,2 right"],
        {1: ".#", 2: "#Z.", 3: ".#"},
    ),
    "door over a wall": (["locked door 5,5 right switch 3,23"], {5: "....##", 23: "@.&.x...X"}),
    "door before a wall": (["automatic door 5,5 left"], {5: "....#"}),
    "door with an odd side": (["raw 9 100,100,2,0,5,5,1,0,0"], {}),
    "door with odd flags": (["raw 9 100,100,0,2,5,5,0,0,0"], {}),
    "locked trap door": (["raw 9 100,100,0,1,5,5,1,0,0"], {}),
    "door outside": (["raw 9 100,100,0,0,50,5,1,0,0"], {}),
    "door at the far border": (["automatic door 32,5 right"], {}),
    "two doors on a side": (["automatic door 5,5 right", "automatic door 6,5 left"], {}),
    "gold in the rock": (["gold 124,490px"], {20: "....#"}),
    "mine over gold": (["gold 301,300px", "mine 305,306px"], {}),
    "pad at the exit": (["launch pad 9,23 up"], {}),
    "block over the exit's switch": (["bounce block 5,23.25"], {}),
    "drone at the start": (["zap drone 1,23 wander-cw right"], {}),
    "door switch behind walls": (["locked door 9,9 left switch 1,1"], {1: "&#", 2: "##"}),
}


def test_every_oddity_is_reported_as_recorded() -> None:
    warned = ((name, warnings_of(*lines, rows=rows)) for name, (lines, rows) in CASES.items())
    hold_against(GOLDEN, [f"{name}: {warning}" for name, warnings in warned for warning in warnings])


def test_a_proper_level_has_no_warning() -> None:
    assert warnings_of(rows={20: "....^^^...oo...###", 22: "###"}) == []


def test_gold_may_be_half_in_the_rock_and_beside_a_mine() -> None:
    assert warnings_of("gold 121,490px 301,300px", "mine 306,307px", rows={20: "....#"}) == []


def test_an_empty_level_lacks_ninja_and_exit() -> None:
    assert warnings_of(keep=False) == [
        "there is no ninja: the level cannot be played",
        "there is no exit: the level cannot be passed",
    ]


def test_a_ninja_in_a_wall() -> None:
    found = warnings_of("ninja 1,1", "exit 9,23 switch 5,23", rows={1: "#", 23: "....x...X"}, keep=False)
    assert found == ["ninja at 1,1 (object 0): it starts inside a tile"]


def test_a_line_of_slopes_shuts_the_ninja_in_unless_it_has_a_hole() -> None:
    rows = {19: "Dd", 20: "##Dd", 21: "..rRDd", 22: "....rRDd", 23: "@.....##Dd....x...X"}
    assert len([each for each in warnings_of(rows=rows) if "cannot reach" in each]) == 2
    assert warnings_of(rows=rows | {23: "@.............x...X"}) == []


UNSEEN = [
    ("gold: G", {}, "there is no gold"),
    ("gold: G", {5: "o"}, ""),
    ("gold 1,6: G", {5: "o"}, ""),
    ("gold 2,6: G", {5: "o"}, "there is no gold at 2,6"),
    ("switch 5,23: G", {}, ""),
    ("switch 9,23: G", {}, "there is no exit with its switch at 9,23"),
    ("lock: G", {}, "there is no locked door"),
    ("trap: G", {}, "there is no trap door"),
    ("switch: G", {}, ""),
    ("at 9,9: G", {}, ""),
    ("at 3,3: G", {}, "the ninja never comes near its place"),
    ("at 3,4: G", {}, ""),
    ("start: G | death 3: H", {}, ""),
]


@pytest.mark.parametrize("says, rows, why", UNSEEN)
def test_a_message_whose_moment_never_comes_is_named(says: str, rows: dict[int, str], why: str) -> None:
    # A roof in row 5 leaves all above it out of reach, but for messages less than three cells above it.
    picture = ["|" + ({5: "#" * 31, 23: "@...x...X"} | {6: rows.get(5, "")}).get(row, "").ljust(31, ".") + "|"
               for row in range(1, 24)]  # fmt: skip
    level = parse_ascii_level("\n".join(["ninja-game level 1", *picture])).level
    assert level_warnings(level, says) == ([f"the message 'G' is never shown: {why}"] if why else [])
    places = [finding.cells for finding in level_findings(level, says)]
    cells = tuple((int(a), int(b)) for a, b in re.findall(r"(\d+),(\d+)", says))
    assert places == ([cells] if why else [])


def test_a_message_about_an_exit_is_never_shown_without_one() -> None:
    assert level_warnings(Level(objects=PROPER[:1]), "switch: Out")[1:] == [
        "the message 'Out' is never shown: there is no exit"
    ]


def test_objects_that_share_an_oddity_share_a_line() -> None:
    assert warnings_of("gold 900,1px 901,1px 902,1px 903,1px 904,1px")[0] == (
        "gold at 900,1px (object 2), gold at 901,1px (object 3), gold at 902,1px (object 4) and 2 more: "
        "it is outside the grid"
    )


def test_odd_tiles() -> None:
    assert warnings_of("tile 2,1 id 70", "tile 1,1 3,1 id -1", rows={1: "???"}) == [
        "tile -1 at 1,1, tile -1 at 3,1: a tile id below 0 is never solid, yet not empty",
        "tile 70 at 2,1: a tile id above 33 is a half tile without direction",
    ]


def test_many_objects() -> None:
    level = Level(objects=(*PROPER, *(ObjectSpec(kinds.MINE, (300.0, 300.0 + number / 100)) for number in range(2000))))
    assert level_warnings(level) == ["there are 2002 objects, more than 2000: the game may be slow"]


def test_more_enemies_than_can_react() -> None:
    turrets = tuple(ObjectSpec(kinds.TURRET, (300.0 + number, 300.0)) for number in range(31))
    guards = tuple(ObjectSpec(kinds.FLOOR_GUARD, (300.0 + number, 570.0, 1.0)) for number in range(31))
    assert level_warnings(Level(objects=(*PROPER, *turrets, *guards))) == [
        "31 enemies look at the ninja in turn: each one only every 3.1 s"
    ]
    assert level_warnings(Level(objects=(*PROPER, *turrets[1:]))) == []


def test_findings_name_records_and_cells_and_say_how_to_fix_them() -> None:
    rows = {2: "#Z#", 1: "?#", 3: ".#", 23: "@...x...X"}
    text = ["ninja-game level 1", *("|" + rows.get(row, "").ljust(31, ".") + "|" for row in range(1, 24))]
    text += ["tile 1,1 id 70", 'raw "77^1,2"', "zap drone 2,2 wander-cw right", "gold 900,100px 901,100px"]
    level = parse_ascii_level("\n".join(text)).level
    found = {finding.text: finding for finding in level_findings(level)}
    assert found["it is outside the grid"].records == (4, 5)
    assert found["it is closed in on all sides: it never moves"].records == (3,)
    assert found["a tile id above 33 is a half tile without direction"].cells == ((1, 1),)
    assert all(finding.hint for finding in found.values())


def test_advice_belongs_to_the_code_not_to_words_that_two_texts_share() -> None:
    (flag,) = level_findings(Level(objects=(*PROPER, ObjectSpec(kinds.DRONE, (100.0, 100.0, 0.0, 7.0, 0.0, 0.0)))))
    assert (flag.code, flag.text, flag.hint) == (
        "seeker-flag", "its seeker flag is not 0 or 1", "Choose whether it seeks."
    )  # fmt: skip


def test_every_code_is_explained_in_the_documents() -> None:
    page = (Path(__file__).parents[2] / "docs" / "findings.md").read_text("utf-8")
    wordings = {**LEVEL_WORDINGS, **PACK_WORDINGS, **DESIGN_WORDINGS, **RUN_WORDINGS}
    assert [row for row in map(row_of, wordings.items()) if row not in page] == []
    assert page.count("\n| `") == len(wordings)


def row_of(entry: tuple[str, Wording]) -> str:
    """A code's line of docs/findings.md."""
    code, wording = entry
    whole = f"{wording.text}; expected {wording.expected}" if wording.expected else wording.text
    text = re.sub(r"\{(\w+)[^}]*\}", lambda value: value[1].upper(), whole)
    return f"| `{code}` | {text} | {wording.hint} |"


WALL = dict.fromkeys(range(1, 23), "....#")


def test_an_exit_and_its_switch_behind_a_wall() -> None:
    rows = {**WALL, 23: "@...#.x.X"}
    assert warnings_of(rows=rows) == [
        "exit at 9,23 (object 1): the ninja cannot reach it",
        "exit at 9,23 (object 1): the ninja cannot reach its switch at 7,23",
    ]


@pytest.mark.parametrize(
    "row,lines",
    [
        ("....#", ["automatic door 5,23 left"]),
        (".&..#", ["locked door 5,23 left switch 2,22"]),
        (".!..#", ["trap door 5,23 left switch 2,22"]),
        (".&&.#", ["locked door 5,23 left switch 2,22", "locked door 5,23 right switch 3,22"]),
    ],
)
def test_a_door_that_can_be_passed_is_no_wall(row: str, lines: list[str]) -> None:
    assert warnings_of(*lines, rows={**WALL, 22: row, 23: "@.....x.X"}) == []


def test_a_locked_door_with_its_switch_on_the_far_side_is_a_wall() -> None:
    found = warnings_of("locked door 5,23 left switch 8,22", rows={**WALL, 22: "....#..&", 23: "@.....x.X"})
    assert "exit at 9,23 (object 1): the ninja cannot reach it" in found
    assert "locked door at 5,23 (object 2): the ninja cannot reach its switch at 8,22" in found


def test_a_trap_door_on_the_side_of_a_locked_one_keeps_it_open() -> None:
    corridor = ("0" * 10 + "1" * 12 + "0") * 10 + "0" * 483
    behind = corridor + "|5^60,566!11^290,566,270,566!9^290,540,0,0,10,23,1,0,0"
    assert any("cannot reach" in str(finding) for finding in level_findings(parse_level_string(behind)))
    shared = parse_level_string(behind + "!9^150,566,0,1,10,23,0,0,0")
    assert not any("cannot reach" in str(finding) for finding in level_findings(shared))


def test_two_locked_doors_with_their_switches_behind_each_other_never_open() -> None:
    lines = ["locked door 5,23 left switch 10,22", "locked door 9,23 left switch 6,22"]
    rows = dict.fromkeys(range(1, 22), "....#...#") | {22: "....#&..#&", 23: "@.....x....X"}
    found = warnings_of(*lines, rows=rows)
    assert sum("cannot reach" in warning for warning in found) == 4


def test_nothing_is_certain_for_a_ninja_that_starts_in_a_tile() -> None:
    rows = {**WALL, 23: "#...#.x.X"}
    assert warnings_of("ninja 1,23", rows=rows) == ["ninja at 1,23 (object 1): it starts inside a tile"]


def test_a_pad_on_the_floor_of_the_last_row_is_not_in_the_border() -> None:
    assert warnings_of(rows={23: "@.8.x...X"}) == []


def test_many_locked_doors_behind_each_other_take_no_time() -> None:
    # Each of the doors opens the next one: the fill looks at none of them again for each one that opens.
    doors = tuple(
        ObjectSpec(kinds.DOOR, (36.0 + number % 24, 564.0 - number / 1e6, 0, 0, 2.0 + number % 28, 23, 1, 0, 0))
        for number in range(20_000)
    )
    started = time.process_time()
    Ground(Level(objects=PROPER + doors))
    assert time.process_time() - started < 10


def test_a_flood_of_objects_is_reported_in_one_warning_and_takes_no_time() -> None:
    doors = tuple(ObjectSpec(kinds.DOOR, (number / 1e3, 300.0, 0, 0, 9, 9, 1, 0, 0)) for number in range(100_000))
    started = time.process_time()
    (warning,) = level_warnings(Level(objects=PROPER + doors))
    assert warning.endswith("more than 12287: the level cannot be played")
    assert time.process_time() - started < 5


def test_names_say_where_an_object_is_in_its_file() -> None:
    assert object_name(ObjectSpec(kinds.GOLD, (36.0, 42.0)), 3) == "gold at 1,1.25 (object 3)"
    assert object_name(ObjectSpec(kinds.GOLD, (math.nan, 42.0)), 3) == "gold at nan,42px (object 3)"


def test_in_a_level_of_many_exits_and_mines_few_distances_are_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    exits = [ObjectSpec(kinds.EXIT, (30.0 + k, 40.0, 30.0 + k, 140.0)) for k in range(400)]
    mines = [ObjectSpec(kinds.MINE, (430.0 + k, 340.0)) for k in range(340)]
    over = ObjectSpec(kinds.MINE, (230.0, 52.0))
    looked = list[Sequence[float]]()

    def measured(a: Sequence[float], b: Sequence[float]) -> float:
        looked.append(a)
        return math.dist(a, b)

    monkeypatch.setattr(lint, "dist", measured)
    found = level_findings(Level((0,) * TILES, (*PROPER, *exits, *mines, over)))
    assert [(each.code, len(each.records)) for each in found if each.code == "covers"] == [("covers", 1)]
    assert len(looked) < 2000


def test_ids_skip_records_that_create_nothing() -> None:
    level = Level((0,) * TILES, (*PROPER, ObjectSpec(-1, (), "77"), ObjectSpec(kinds.GOLD, (900.0, 36.0))))
    assert level_warnings(level)[-1] == "gold at 900,36px (object 2): it is outside the grid"


def test_published_levels_are_mostly_proper() -> None:
    found = [warning for row in levels() for warning in level_warnings(parse_level_string(row.data))]
    covered = [warning for warning in found if warning.endswith("it lies over the exit's switch")]
    others = [warning for warning in found if warning not in covered]
    assert len(covered) <= 2
    assert len(others) <= 31
    assert not [warning for warning in others if "exit" in warning or "ninja at" in warning]


def test_the_ninja_reaches_a_disc_in_a_wall_as_far_as_its_own_radius_goes() -> None:
    # One open row at the bottom; what lies in the rock above it is touched from up to 10 + 6 px away.
    tiles = tuple(0 if cell % ROWS == ROWS - 1 else 1 for cell in range(TILES))
    ground = Ground(Level(tiles, PROPER))
    top = 23 * 24.0
    assert ground.can_touch(300.0, top - 15.5, 6.0)
    assert not ground.can_touch(300.0, top - 16.5, 6.0)


def test_what_only_a_fast_ninja_touches_is_named() -> None:
    box = tuple(int(10 <= cell // ROWS + 1 <= 16 and cell % ROWS + 1 >= 20) for cell in range(TILES))
    ninja = ObjectSpec(kinds.NINJA, (492.0, 540.0))
    exits = [
        ObjectSpec(kinds.EXIT, (*exit_, *switch))
        for exit_, switch in [((612, 540), (396, 540)), ((396, 492), (492, 492))]
    ]
    door = ObjectSpec(kinds.DOOR, (252.0, 540.0, 0.0, 0.0, 3.0, 3.0, 1.0, 0.0, 0.0))
    gold = [ObjectSpec(kinds.GOLD, (x, 564.0)) for x in (396.0, 403.0)]
    level = Level(box, (ninja, *exits, door, *gold))
    reason = "only a fast ninja touches it"
    assert level_warnings(level) == [
        f"exit at 25,22 (object 1): its switch at 16,22 lies in a wall: {reason}",
        f"locked door at 3,3 (object 3): its switch at 10,22 lies in a wall: {reason}",
        f"gold at 16,23 (object 4): it lies in a wall: {reason}",
        "gold at 16,23 (403,564px, object 5): the tiles hide it",
    ]
    assert [_opens(level, speed) for speed in (2.0, 5.0, 7.0)] == [False, False, True]


def _opens(level: Level, speed: float) -> bool:
    """Whether a ninja that comes from the right with this speed, px/tick, and stays at the wall opens the exit."""
    run = Simulation(level)
    ninja = run.world.ninja
    ninja.x = 418.1
    ninja.prev_x = ninja.x + speed
    opened = False
    for _ in range(100):
        run.step(left=True)
        opened |= "exit-opened" in [event.name for event in run.events]
    return opened
