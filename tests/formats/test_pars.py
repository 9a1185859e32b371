"""Par times follow from a certificate by one formula; the table that holds them is read and written."""

import pytest
from hypothesis import given, strategies as st

from ninja_game.errors import PackError
from ninja_game.formats.pack.pars import MARGINS, Pars, parse_pars, write_pars
from tests.support.reference import recordings, require_reference

PARS = Pars("ab", "cd", 400)


def test_medals_follow_from_the_tick_of_the_exit_contact() -> None:
    assert [PARS.medal(tick) for tick in (400, 420, 421, 492, 640, 641, 9999)] == [
        "author", "author", "gold", "gold", "silver", "bronze", "bronze",
    ]  # fmt: skip
    assert [PARS.next_medal(tick) for tick in (420, 421, 493, 641)] == ["", "author", "gold", "silver"]


def test_margins_are_wider_where_play_with_noise_fails_more_often() -> None:
    assert [Pars("", "", 400, difficulty=points).par("silver") for points in (0.0, 4.0, 8.0)] == [640, 880, 1120]


@given(st.integers(0, 10**5))
def test_better_medals_are_never_easier_and_the_certificate_has_the_best(tick: int) -> None:
    pars = Pars("", "", tick)
    times = [pars.par(medal) for medal in MARGINS]
    assert times == sorted(times)
    assert pars.medal(tick) == "author"
    assert all(time % 4 == 0 for time in times)


def test_margins_are_those_of_people_against_tools_in_the_reference() -> None:
    require_reference()
    best: dict[str, dict[str, int]] = {"rta": {}, "mbd": {}, "tas": {}}
    for run in recordings():
        if run.kind == "speedrun" or run.source != "tas":
            times = best[run.source]
            times[run.label] = min(times.get(run.label, run.end_tick), run.end_tick)
    people = {label: min(times.get(label, 10**6) for times in (best["rta"], best["mbd"])) for label in best["tas"]}
    ratios = sorted(people[label] / tick for label, tick in best["tas"].items() if people[label] < 10**6)
    assert len(ratios) == 218
    assert ratios[len(ratios) // 2] - 1 == pytest.approx(MARGINS["author"], abs=0.005)
    assert ratios[len(ratios) * 19 // 20] - 1 == pytest.approx(MARGINS["gold"], abs=0.005)


def test_table_is_read_as_it_is_written() -> None:
    table = {'a "b".txt': PARS, "b.txt": Pars("0123", "4567", 8, 9, 1.25)}
    assert parse_pars(write_pars(table)) == table


@pytest.mark.parametrize(
    "text",
    [
        "not [ toml", "a = 5", '"a.txt" = { exit = 5 }', '"a.txt" = { level = "a", run = "b", exit = "c" }',
        '"a.txt" = { level = "a", run = "b", exit = -1 }', '"a.txt" = { level = "a", run = "b", exit = 1, more = 2 }',
        '"a.txt" = { level = "a", run = "b", exit = 1, difficulty = nan }', "a = " + "[" * 5000,
    ],
)  # fmt: skip
def test_wrong_table_is_an_error_that_names_the_file(text: str) -> None:
    with pytest.raises(PackError, match=r"pars\.toml"):
        parse_pars(text, file="pars.toml")
