"""The figures of levels: what they count, and that those of the reference are its own."""

import pytest

from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.sim.kinds import GOLD
from ninja_game.sim.level import Level
from ninja_game.sim.rules import TICKS_PER_SECOND
from tests.support.reference import levels as reference_levels, recordings, require_reference
from tools.measure import level_statistics
from tools.measure.level_statistics import (
    ALL_VARIANTS,
    KINDS_OF_REFERENCE,
    KNOWN,
    NAMES,
    alike,
    common_motifs,
    figures,
    missing,
    motifs,
    quartiles,
    shared_share,
    variants,
)

OBJECTS = "5^100,566!11^160,564,130,564!0^300,100!0^300,124!12^60,60!6^60,84,5,1,0,2!9^60,60,1,0,2,2,1,0,0!2^60,60,0,-1"


def level(tiles: dict[tuple[int, int], int], objects: str = OBJECTS) -> Level:
    """Tiles by column and row from 0; the rest is empty."""
    text = "".join(chr(48 + tiles.get((i, j), 0)) for i in range(31) for j in range(23))
    return parse_level_string(f"{text}|{objects}")


def test_figures_count_what_their_names_say() -> None:
    found = figures(level({(0, 0): 1, (1, 0): 1, (30, 0): 2}))
    assert found == {
        "objects": 8, "gold": 2, "enemies": 1, "mines": 1, "kinds": 5, "solid": 3 / 713, "shapes": 1,
        "mirror": 711 / 713,
    }  # fmt: skip


def test_variants_are_named_by_the_words_of_the_level_format() -> None:
    seen = set().union(*map(variants, level({}).objects))
    assert seen == {
        "ninja", "exit", "gold", "mine", "zap drone", "zap drone seeker", "drone random", "locked door flat",
        "launch pad up",
    }  # fmt: skip
    assert seen <= ALL_VARIANTS
    absent, tiles = missing({"a": level({(0, 0): 1, (1, 1): 2})})
    assert set(absent) == ALL_VARIANTS - seen
    assert tiles == list(range(3, 34))


def test_shared_cells_and_motifs_are_found() -> None:
    wall = {(0, j): 1 for j in range(20)}
    stairs = {(10, 10): 2, (11, 11): 3, (12, 10): 4}
    levels = {"a": level(wall | stairs), "b": level(wall | stairs), "c": level(stairs), "d": level({(5, 5): 1})}
    assert [pair[1:] for pair in alike(levels, 0.5)] == [("a", "b")]
    assert shared_share(frozenset(), frozenset()) == 0
    assert motifs(levels["d"]) == set()
    assert motifs(level({(10 + k, 10 + k): 3 for k in range(5)})) == set(), "a straight slope is not a motif"
    ((motif, names), *_) = common_motifs(levels, 2)
    assert names == ["a", "b", "c"]
    assert sum(tile > 1 for tile in motif) == 3


@pytest.fixture(name="reference", scope="module")
def levels_of_the_reference() -> dict[str, Level]:
    require_reference()
    return {row.label: parse_level_string(row.data) for row in reference_levels()}


def test_figures_of_the_reference_are_its_quartiles(reference: dict[str, Level]) -> None:
    gold = {name: sum(record.kind == GOLD for record in each.objects) for name, each in reference.items()}
    published = {row.label: row.data for row in reference_levels()}
    exits: dict[str, int] = {}
    rich: dict[str, int] = {}
    for run in recordings():
        if run.data != published[run.label]:
            continue
        for times, counts in ((exits, True), (rich, run.gold >= 0.95 * gold[run.label])):
            if counts:
                times[run.label] = min(times.get(run.label, run.end_tick), run.end_tick)
    rows = [figures(each) for each in reference.values()]
    values = {key: [row[key] for row in rows] for key in rows[0]}
    values["exit_s"] = [tick / TICKS_PER_SECOND for tick in exits.values()]
    values["gold_s"] = [tick / TICKS_PER_SECOND for tick in rich.values()]
    for key, row in KNOWN.items():
        assert quartiles(values[key]) == pytest.approx(row[1:], abs=0.0006), key
    for kind, share in KINDS_OF_REFERENCE.items():
        with_kind = sum(any(NAMES.get(record.kind) == kind for record in each.objects) for each in reference.values())
        assert with_kind * 100 / len(reference) == pytest.approx(share, abs=0.6), kind


def test_tables_of_the_set_can_be_made(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.argv", ["level_statistics"])
    level_statistics.main()
    output = capsys.readouterr().out
    assert "| gold | 24 - 36 - 49 |" in output
    assert "variants that none has" in output
