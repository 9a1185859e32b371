"""How a run was made and by whom: said by replay texts, kept by every form that can hold it."""

from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner
from hypothesis import assume, given, strategies as st

from ninja_game import ReplayError, parse_replay, write_replay
from ninja_game.cli.main import cli
from ninja_game.formats.load import load_replays
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.notations import Marker
from ninja_game.formats.replay.provenance import (
    UNKNOWN,
    Provenance,
    names_of_text,
    parse_provenance,
    with_provenance,
    without_provenance,
)
from ninja_game.runs.conversion import level_file_text, on_level, recorded_again
from ninja_game.sim.level import Level
from tests.support.forgeries import replay

SEARCHED = Provenance(played=True, edits=34, searches=("improve", "search"), begun_by="Ann")
WORDS = st.lists(st.from_regex(r"[a-z][a-z -]{0,20}", fullmatch=True), max_size=4).map(tuple)
NAMES = st.text(max_size=12).map(lambda name: " ".join(name.replace(",", " ").split()))
MADE = st.builds(
    lambda played, assists, edits, searches, by: Provenance(played, assists if played else (), edits, searches, by),
    st.booleans(), WORDS, st.integers(0, 10**9 - 1), WORDS, NAMES,
).filter(lambda made: made.assisted is not None or not made.begun_by)  # fmt: skip


@given(MADE, st.lists(NAMES.filter(bool), max_size=3, unique=True).map(tuple))
def test_a_text_reads_back_equal(made: Provenance, names: tuple[str, ...]) -> None:
    claimed = replace(parse_replay(replay()), made=made, co_authors=names)
    assert parse_replay(write_replay(claimed)) == claimed


def test_it_says_whether_anything_helped() -> None:
    ways = UNKNOWN, Provenance(played=True), Provenance(True, ("practice",)), SEARCHED
    assert [made.assisted for made in ways] == [None, False, True, True]
    assert parse_replay(replay()).made == UNKNOWN
    assert parse_replay(replay(author="Ann", made=SEARCHED, co_authors=("Bob",))).credit == (
        "Ann, Bob (edited, searched)"
    )


@pytest.mark.parametrize(
    "stated",
    ["by hand", "edited", "edited 0", "edited 03", "searched", "searched ()", "edited 3, played", "played (A)",
     "edited 9999999999", "played, ", "searched (improve) from a run by"],
)  # fmt: skip
def test_anything_else_is_refused_with_its_place(stated: str) -> None:
    text = replay(made=Provenance(played=True)).replace("made: played", f"made: {stated}")
    with pytest.raises(ReplayError, match=r"^3:7: not how a run is made; found .*leave the line out"):
        parse_replay(text)


def test_what_a_text_cannot_hold_is_not_written() -> None:
    claimed = parse_replay(replay())
    for lies in ({"made": Provenance(edits=-1)}, {"made": Provenance(begun_by="Ann")}, {"co_authors": ("Bob, Cy",)},
                 {"co_authors": ("B" * 2000,)}):  # fmt: skip
        with pytest.raises(ReplayError, match="not how a run is made"):
            write_replay(replace(claimed, **lies))


def test_too_many_co_authors_are_reported() -> None:
    text = replay(co_authors=("Bob",)).replace("Bob", ",".join(map(chr, range(0x4E00, 0x4E00 + 499))))
    with pytest.raises(ReplayError, match=r"^3:13: 1,495 characters .* in 'co-authors'; .* expected at most 1,000"):
        parse_replay(text)


@given(MADE, st.lists(NAMES.filter(bool), max_size=3, unique=True).map(tuple), st.text(max_size=20))
def test_comments_of_n_hold_it(made: Provenance, names: tuple[str, ...], comment: str) -> None:
    held = with_provenance(comment.strip(), made, names)
    # A comment of the maker's own that reads as such a mark looks like one, and so do names with its signs.
    assume("]" not in f"{made}{names}" and ";" not in f"{made}" and "[made" not in comment)
    assert without_provenance(held) == (comment.strip(), made, names)


def test_it_goes_to_a_demo_of_n_and_back(tmp_path: Path) -> None:
    text = replay(author="Ann", made=SEARCHED, co_authors=("Bob",))
    record = level_file_text([("run.txt", text)])
    assert "#[made: played, edited 34, searched (improve, search) from a run by Ann; co-authors: Bob]#" in record
    (back,) = parse_replays(record)
    assert (back.replay.made, back.replay.co_authors, back.comment) == (SEARCHED, ("Bob",), "")
    again = recorded_again(back)
    assert (again.made, again.co_authors, again.author) == (SEARCHED, ("Bob",), "Ann")
    for form in ("celeste", "libtas"):
        source = tmp_path / "run.replay.txt"
        source.write_text(text, "utf-8")
        stated = CliRunner().invoke(cli, ["convert", str(source), str(tmp_path / f"{form}.txt"), "--to", form])
        assert "how runs were made" in stated.output


def test_a_text_that_was_changed_by_hand_counts_as_edited() -> None:
    text = replay(made=Provenance(played=True), author="Ann")
    (honest,) = parse_replays(text)
    assert recorded_again(honest).made == Provenance(played=True)
    (changed,) = parse_replays(text.replace("R*", ".*3 R*").replace("final-tick: 2", "final-tick: 9"))
    assert recorded_again(changed).made == Provenance(played=True, edits=1)
    moved = on_level(honest, Level(honest.level.tiles, honest.level.objects[:-1]))
    assert moved.replay.made == Provenance(played=True, edits=1)


def command(*arguments: object) -> None:
    result = CliRunner().invoke(cli, [*map(str, arguments)])
    assert result.exit_code == 0, result.output


def test_a_searched_run_says_so_and_whose_run_it_began_from(tmp_path: Path) -> None:
    source, out, twice = (tmp_path / f"{name}.replay.txt" for name in ("run", "out", "twice"))
    source.write_text(
        replay(bytes(20) + bytes([2] * 24), author="Ann", made=Provenance(played=True), co_authors=("Cy",))
    )
    command("improve", source, "--ticks", "100000", "--jobs", "1", "-o", out)
    command("search", out, "--from", "0", "--to", "12", "--goal", "x > 103", "--seconds", "2", "-o", twice)
    for path, searches in ((out, ("improve",)), (twice, ("improve", "search"))):
        (run,) = load_replays(path)
        assert (run.author, run.replay.co_authors) == ("Ann", ("Cy",))
        assert run.replay.made == Provenance(played=True, searches=searches, begun_by="Ann")
        assert "searched" in run.title
        stated = CliRunner().invoke(cli, ["verify", str(path)]).stdout
        assert f"(played, searched ({', '.join(searches)}) from a run by Ann)" in stated


def test_names_are_names() -> None:
    assert names_of_text(" Bob,Cy ,, Bob") == ("Bob", "Cy")
    assert parse_provenance("") == UNKNOWN


def test_markers_stay_at_their_places(tmp_path: Path) -> None:
    source, out = tmp_path / "run.replay.txt", tmp_path / "out.replay.txt"
    slow = parse_replay(replay(bytes(20) + bytes([2] * 24)))
    source.write_text(write_replay(replace(slow, markers=(Marker(0, "start"), Marker(30, "half"), Marker(43, "end")))))
    command("improve", source, "--ticks", "100000", "--jobs", "1", "-o", out)
    (before,), (after,) = load_replays(source), load_replays(out)
    assert after.ticks == before.ticks - 20
    assert after.replay.markers == (Marker(0, "start"), Marker(10, "half"), Marker(23, "end"))


def test_a_hostile_comment_takes_no_time_and_is_a_comment() -> None:
    for comment in (
        "[made: " * 200_000,
        "[made: " * 200_000 + "]",
        "[made: edited 3 from a run by " + "A" * 10**6 + "]",
    ):
        assert without_provenance(comment) == (comment, UNKNOWN, ())


LETTERS = ",".join(map(chr, range(0x4E00, 0x4E00 + 900)))


@pytest.mark.parametrize(
    "claimed",
    [" from a run by Ann", "edited 3 from a run by Ann ", f"edited 3; co-authors: {'B' * 1500}",
     f"edited 3 from a run by {'B' * 1500}", f"edited 3; co-authors: {LETTERS}"],
)  # fmt: skip
def test_what_a_text_cannot_hold_is_a_comment(claimed: str) -> None:
    assert without_provenance(f"gold [made: {claimed}]") == (f"gold [made: {claimed}]", UNKNOWN, ())
