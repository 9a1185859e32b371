"""Packs are judged: what is odd has a line with its place, and the table of pars is what the certificates say."""

import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner

from ninja_game.cli.main import cli
from ninja_game.editor.packs import accept
from ninja_game.files.bundled import data_folder
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.pack.pars import Pars
from ninja_game.formats.replay.text import write_replay
from ninja_game.runs.packs import lint, read_pack_certificate
from ninja_game.runs.run import record_replay
from ninja_game.runs.verify import STRICT
from tests.support.own_pack import PACK, rewrite

FIRST = "00-0-run-and-hop"


@pytest.fixture(name="pack")
def copy_of_the_pack(tmp_path: Path) -> Path:
    return Path(shutil.copytree(PACK, tmp_path / "pack"))


def findings(pack: Path) -> list[str]:
    found = [f"{each.place}: {each.text}" if each.file else each.text for each in lint(Pack(pack))]
    return [text.replace(f"{pack}/", "") for text in found]


def test_nothing_is_odd_about_the_pack_of_the_tests(pack: Path) -> None:
    assert findings(pack) == []
    result = CliRunner().invoke(cli, ["levels", "lint", str(pack)])
    assert (result.exit_code, result.output) == (0, "test pack: 2 episodes, 8 levels, nothing odd\n")


def test_index_is_looked_at(pack: Path) -> None:
    rewrite(pack / "pack.toml", 'author = "the ninja-game developers"\n', "")
    rewrite(pack / "pack.toml", '"01-2-no-hurry.txt"', '"gone.txt"')
    with (pack / "pack.toml").open("a") as index:
        index.write('[[episode]]\nnumber = 12\nname = "Learning to fall"\n')
    assert findings(pack) == [
        "gone.txt: not there",
        "pack.toml: the pack has no author",
        "pack.toml: column 1 has episodes and no name; expected 2 names in columns",
        "pack.toml:15: episode 12 has the name of episode 0",
        "pack.toml:15: episode 12 has no levels; expected files 12-….txt",
        "01-2-no-hurry.txt: in no episode; it can be played as a single level",
    ]
    result = CliRunner().invoke(cli, ["levels", "lint", str(pack)])
    assert result.exit_code == 1
    assert "6 findings" in result.output
    assert (
        "pack.toml: the pack has no author. Name one: it is that of every level without its own. [no-author]\n"
        in result.output
    )


def test_levels_are_looked_at(pack: Path) -> None:
    shutil.copy(pack / f"{FIRST}.txt", pack / "00-1-again.txt")
    (pack / "00-1-stone-to-stone.txt").unlink()
    rewrite(pack / "00-2-wall-to-wall.txt", "name: Wall to Wall\n", "")
    (pack / "00-3-long-slope.txt").write_text("ninja-game level 1\nnonsense")
    found = findings(pack)
    for expected in (
        "00-1-again.txt: the same name as 00-0-run-and-hop.txt",
        "00-1-again.txt: the same content as 00-0-run-and-hop.txt",
        "00-1-again.txt: no certificate, so nobody knows whether it can be passed",
        "00-2-wall-to-wall.txt: no name",
    ):
        assert expected in found
    assert any("00-1-stone-to-stone.exit.replay.txt: of no level here" in finding for finding in found)
    assert any(finding.startswith("00-3-long-slope.txt:2:") for finding in found)


def test_certificates_of_a_level_that_cannot_be_read_are_not_strays(pack: Path) -> None:
    (pack / f"{FIRST}.txt").write_text("ninja game level 1\nnonsense")
    found = findings(pack)
    assert not [each for each in found if "of no level here" in each]
    assert any("expected 'ninja-game level 1' in the first line" in each for each in found)


def test_findings_are_accepted_with_a_reason(pack: Path) -> None:
    rewrite(pack / "00-2-wall-to-wall.txt", "name: Wall to Wall\n", "")
    accept = '[[accept]]\nfile = "{}"\ncode = "no-name"\nreason = "found on the street"\n'
    with (pack / "pack.toml").open("a", encoding="utf-8") as index:
        index.write(accept.format("00-2-wall-to-wall.txt") + accept.format("00-0-run-and-hop.txt"))
    assert findings(pack) == [], "an acceptance of what is not found is none"
    result = CliRunner().invoke(cli, ["levels", "lint", str(pack)])
    assert (result.exit_code, result.output) == (0, "test pack: 2 episodes, 8 levels, nothing odd, 1 accepted\n")


def test_of_gold_out_of_reach_it_is_reported_once(pack: Path) -> None:
    def problems_now() -> list[str]:
        return [finding.code for finding in lint(Pack(pack), with_gold=True) if finding.file == f"{FIRST}.txt"]

    kept = pack / "certificates" / f"{FIRST}.exit.replay.txt"
    run = load_replays(kept)[0]
    assert problems_now() == ["no-gold-run"]
    with (pack / f"{FIRST}.txt").open("a", encoding="utf-8") as level:
        level.write("gold 2,22\n")
    changed = Pack(pack).levels[f"{FIRST}.txt"].level
    kept.write_text(write_replay(record_replay(changed, run.replay.playback(run.replay.end_tick))), "utf-8")
    assert problems_now() == ["unreachable"], "which is why no run takes all"


def test_the_order_of_levels_is_looked_at(pack: Path) -> None:
    rewrite(pack / "pars.toml", "difficulty = 0.39", "difficulty = 5.00")
    before = "00-0-run-and-hop.txt: hard, harder than 00-1-stone-to-stone.txt (easy), but comes right before it"
    assert findings(pack) == [before, "00-0-run-and-hop.txt: hard: the first level is the hardest of the pack"]
    for code in ("hard-before-easy", "hardest-first"):
        accept(pack, f"{FIRST}.txt", code, "a wall to begin with")
    assert findings(pack) == []
    rewrite(pack / "pars.toml", "difficulty = 2.48", "difficulty = 6.00")
    assert findings(pack) == [], "what is accepted may be gone"
    rewrite(pack / "01-0-up-and-away.txt", "name: Up and Away", "name: watch and go")
    assert "01-1-watch-and-go.txt: the same name as 01-0-up-and-away.txt" in findings(pack)


def test_an_episode_that_is_easier_than_the_one_before_is_named(pack: Path) -> None:
    table = pack / "pars.toml"

    def measure(episode: str, *difficulties: float) -> None:
        measured = iter(difficulties)
        text = re.sub(
            rf'(?m)^("{episode}-.*difficulty = ).*', lambda m: f"{m[1]}{next(measured)} }}", table.read_text()
        )
        table.write_text(text, "utf-8")

    measure("00", 2.0, 2.1, 3.0, 4.5, 5.0)
    measure("01", 1.0, 1.0, 2.0)
    assert findings(pack) == [], "a medium level in both"
    measure("01", 1.0, 0.5, 1.2)
    remark = "01-0-up-and-away.txt: each level of its episode is easier than those of the episode before"
    assert findings(pack) == [remark]
    accept(pack, "01-0-up-and-away.txt", "easier-episode", "a rest")
    assert findings(pack) == []


def test_two_levels_of_one_place_are_named(pack: Path) -> None:
    (pack / "00-4-other.txt").write_text((pack / "01-0-up-and-away.txt").read_text().replace("...o", "....", 1))
    assert "00-4-other.txt: the place 00-4 is that of 00-4-every-switch.txt too" in findings(pack)


def test_a_link_in_a_pack_is_no_part_of_it(pack: Path, tmp_path: Path) -> None:
    (tmp_path / "secret.txt").write_text("secret")
    (pack / "01-9-readme.txt").symlink_to(tmp_path / "secret.txt")
    assert "01-9-readme.txt" not in Pack(pack).files.names
    shutil.rmtree(pack / "certificates")
    (pack / "certificates").symlink_to(tmp_path)
    assert not [name for name in Pack(pack).files.names if "secret" in name]


def test_certificates_are_run(pack: Path) -> None:
    certificates = pack / "certificates"
    rewrite(pack / "00-1-stone-to-stone.txt", "@", ".")
    (certificates / "00-2-wall-to-wall.exit.replay.txt").write_text("nonsense")
    shutil.copy(certificates / f"{FIRST}.exit.replay.txt", certificates / f"{FIRST}.gold.replay.txt")
    short = load_replays(certificates / "01-0-up-and-away.exit.replay.txt")[0]
    (certificates / "01-0-up-and-away.exit.replay.txt").write_text(
        write_replay(record_replay(short.level, short.replay.playback(100), ticks=100))
    )
    found = findings(pack)
    for expected in (
        "certificates/00-0-run-and-hop.gold.replay.txt: it takes 1 of 5 pieces of gold",
        "certificates/00-1-stone-to-stone.exit.replay.txt: the certificate is of an older version of the level, or",
        "certificates/01-0-up-and-away.exit.replay.txt: outcome is running, --strict expects exit",
    ):
        assert any(finding.startswith(expected) for finding in found)
    assert any(finding.startswith("certificates/00-2-wall-to-wall.exit.replay.txt") for finding in found)


@pytest.mark.parametrize("field", STRICT)
def test_a_certificate_is_what_a_strict_verdict_accepts(field: str, pack: Path) -> None:
    found = read_pack_certificate(Pack(pack), f"{FIRST}.txt", "exit")
    assert found
    assert not found.problems
    vars(found)["verdict"] = replace(found.verdict, **{field: "other"})  # type: ignore[arg-type]
    assert found.problems


def test_pars_are_made_by_a_command_and_told_when_they_are_stale(pack: Path) -> None:
    before = Pack(pack).pars
    (pack / "pars.toml").unlink()
    assert findings(pack) == ["pars.toml: no medal times yet"]
    result = CliRunner().invoke(cli, ["levels", "pars", str(pack)])
    assert result.exit_code == 0
    assert "8 levels with pars, 0 without a sound certificate" in result.output
    assert Pack(pack).pars == before
    assert findings(pack) == []
    rewrite(pack / "pars.toml", "exit = 156", "exit = 150")
    assert findings(pack) == ["pars.toml: medal times of other levels or certificates"]


def test_pars_of_a_changed_level_count_no_more(pack: Path) -> None:
    assert isinstance(Pack(pack).pars[f"{FIRST}.txt"], Pars)
    rewrite(pack / f"{FIRST}.txt", "ooo", "oo.")
    assert f"{FIRST}.txt" not in Pack(pack).pars


def test_pack_that_cannot_be_read_ends_with_its_line(pack: Path) -> None:
    rewrite(pack / "pack.toml", "number = 1\n", "number = 0\n")
    result = CliRunner().invoke(cli, ["levels", "lint", str(pack)])
    assert result.exit_code == 2
    assert "pack.toml:12: episode 0 is there twice; found line 8 too" in result.output


def test_no_level_of_this_pack_is_called_as_one_of_the_games() -> None:
    """A reader who sees a level of the tests must not take it for another."""
    ours, tests = ({each.name.casefold() for each in load_levels(folder)} for folder in (data_folder("levels"), PACK))
    slugs, other = ({file.stem[5:] for file in folder.glob("[0-9]*.txt")} for folder in (data_folder("levels"), PACK))
    assert (len(tests), ours & tests, slugs & other) == (8, set(), set())
