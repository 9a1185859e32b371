"""The counts of a level's design: each tells a good level from one that lacks just that."""

import pytest

from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.pack.pack import Pack
from ninja_game.runs.level_design import BOUNDS, Design, design_findings, measure_design
from ninja_game.runs.packs import lint
from ninja_game.sim.inputs import Input
from ninja_game.sim.level import Level
from tests.support.own_pack import PACK

RIGHT = bytes([Input.RIGHT] * 200)
FLOOR = dict.fromkeys(range(13, 24), "#" * 31)


def level(*lines: str, row: str = "@x.............................", rows: dict[int, str] | None = None) -> Level:
    """A hall of 31 x 12 cells with a ninja, and these lines."""
    drawn = FLOOR | {12: row} | (rows or {})
    picture = ["|" + drawn.get(number, "").ljust(31, ".") + "|" for number in range(1, 24)]
    return parse_ascii_level("\n".join(["ninja-game level 1", *picture, *lines])).level


EXIT = "exit 720,276px switch 60,276px"
GROUP = " ".join(f"{10 + k / 2},11.25" for k in range(8))
STREWN = " ".join(f"{3 + 4 * (k % 7)},{2 + 4 * (k // 7)}.25" for k in range(14))
MINES = " ".join(f"{10 + k / 2},10.25" for k in range(8))


def counts(*lines: str, rows: dict[int, str] | None = None) -> Design:
    return measure_design(level(*lines, row="@.............................X", rows=rows), RIGHT)


def hall(*lines: str, rows: dict[int, str] | None = None) -> Design:
    return counts("exit 31,12 switch 2.5,12", *lines, rows=rows)


def test_gold_in_danger_is_bait() -> None:
    assert hall(f"gold {GROUP}", f"mine {MINES}").bait == 1.0
    assert hall("gold 28.25,3.25 28.75,3.25", f"mine {MINES}").bait == 0.0
    assert hall(f"gold {GROUP}").bait is None


@pytest.mark.parametrize(
    "danger",
    ["thwump 11.5,2 down", "gauss turret 12.5,2", "floor guard 12.5,12", "zap drone 10.5,11.5 surface-cw right"],
)
def test_every_kind_of_hazard_makes_bait(danger: str) -> None:
    assert hall(f"gold {GROUP}", danger).bait
    behind = dict.fromkeys(range(1, 12), "..................#") | {12: "@.................#...........X"}
    assert not measure_design(
        level("exit 31,12 switch 2.5,12", "gold 28.25,2.25", danger, row=behind[12], rows=behind), RIGHT
    ).bait


def test_pieces_in_groups_are_less_even_than_strewn_ones() -> None:
    group, strewn = hall(f"gold {GROUP}").gold_evenness, hall(f"gold {STREWN}").gold_evenness
    assert group is not None
    assert strewn is not None
    assert group < 0.5
    assert strewn > 1.5
    assert hall("gold 3,3.25").gold_evenness is None
    assert hall(f"mine {STREWN}").mine_evenness == pytest.approx(strewn)


def test_hazards_near_the_run_and_far_from_it() -> None:
    near, far = hall("mine 10,10.5 12,10.5").hazard_distance, hall("mine 10,1.5 12,1.5").hazard_distance
    assert near is not None
    assert far is not None
    assert near < 60
    assert far > 200
    assert hall("mine 10,11.25").near_ticks > 0 == hall("mine 10,1.5").near_ticks


def test_bays_that_repeat_are_counted_without_overlaps() -> None:
    bay = {9: "..s##a..s##a..s##a..s##a", 10: "..####..####..####..####"}
    assert hall(rows=bay).bays >= 4
    assert hall(rows={9: "..s##a", 10: "..####"}).bays == 1
    assert hall(rows={3: "..s##a.........s##a", 4: "...##...........##"}).bays == 2, "six tiles are a bay"


def test_space_that_nobody_uses() -> None:
    assert hall().unused > hall(f"gold {STREWN}").unused


def test_a_trip_there_and_back_is_a_detour() -> None:
    there = measure_design(level("exit 31,12 switch 2.5,12", row="@.............................X"), RIGHT)
    keys = bytes([Input.RIGHT] * 100 + [Input.LEFT] * 100)
    back = measure_design(level("exit 3,12 switch 30.5,12", row="@.X............................"), keys)
    assert there.detour < 1.5 < back.detour


def replaced(counts: Design, name: str, value: float | None) -> Design:
    return Design(**(counts._asdict() | {name: value}))


@pytest.mark.parametrize("code", BOUNDS)
def test_a_count_beyond_its_bound_is_a_finding(code: str) -> None:
    name, sign, bound = BOUNDS[code]
    good = Design(0.0, 1.0, 0.0, 0.0, 0, 0.0, 99.0, 0.0)
    assert list(design_findings(good)) == []
    bad = replaced(good, name, bound - 0.01 if sign == ">=" else bound + 1)
    (finding,) = design_findings(bad, "level.txt")
    assert finding.code == code
    assert str(bound if bound >= 1 or "%" not in finding.text else f"{bound:.0%}") in finding.text
    assert finding.hint
    assert list(design_findings(replaced(bad, name, None))) == []


def test_lint_tells_it_only_where_it_is_asked_for() -> None:
    pack = Pack(PACK)
    codes = {finding.code for finding in lint(pack)}
    assert not codes & BOUNDS.keys()
    assert {finding.code for finding in lint(pack, with_design=True)} >= codes
