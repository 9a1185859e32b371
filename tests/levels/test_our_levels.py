"""The levels in levels/: each is proper, named, in its place, certified, and comes back from its own text."""

import re
from collections import Counter
from pathlib import Path

import pytest

from ninja_game.files.bundled import data_folder
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.pack.pars import DIFFICULTY_GRADES
from ninja_game.levels.lint import level_warnings
from ninja_game.runs.advice import FALL_HELP, WHY
from ninja_game.runs.packs import make_pars
from ninja_game.sim.kinds import GOLD

OURS = Pack(data_folder("levels"))
LEVELS = OURS.files.levels
CERTIFICATES = [(file, kind) for file in LEVELS for kind in ("exit", "gold") if OURS.certificate(file, kind)]


def test_levels_are_called_by_their_place() -> None:
    assert len(LEVELS) >= 6
    assert not [file for file in LEVELS if not re.fullmatch(r"\d\d-[0-4]-[a-z0-9]+(-[a-z0-9]+)*\.txt", file)]
    assert not [place for place, count in Counter(file[:4] for file in LEVELS).items() if count > 1]


def test_every_level_is_in_an_episode_and_nothing_is_wrong_with_the_pack() -> None:
    placed = {Path(level.file).name for levels in OURS.episodes.values() for level in levels}
    assert placed == set(LEVELS)
    assert OURS.problems == []


@pytest.mark.parametrize("file", LEVELS)
def test_a_level_of_ours_is_proper(file: str) -> None:
    read = parse_ascii_level(OURS.files.text(file), file=file)
    assert read.name
    assert read.author
    assert read.comment
    assert level_warnings(read.level, read.says) == []
    assert any(record.kind == GOLD for record in read.level.objects)
    assert parse_ascii_level(write_ascii_level(read.level)).level == read.level


def test_no_text_names_a_colour_which_a_palette_may_change() -> None:
    colours = re.compile(
        r"\b(red|orange|green|blue|yellow|violet|purple|pink|brown|black|white|gr[ae]y)\b", re.IGNORECASE
    )
    helped = (data_folder("assets") / "help/pages.toml").read_text("utf-8")
    texts = [FALL_HELP, *WHY.values(), *re.findall('"(.*)"', helped)]
    texts += [text for named in OURS.levels.values() for text in (named.comment, named.teaches, named.says)]
    assert not [text for text in texts if colours.search(text)]


def test_levels_of_the_first_episode_read_alike() -> None:
    pars = [OURS.pars[file] for file in sorted(LEVELS)]
    assert {each.grade for each in pars[:5]} == {"easy"}
    assert {each.grade for each in pars} == set(DIFFICULTY_GRADES.values())


def test_every_certificate_is_one_of_a_level() -> None:
    named = {OURS.certificate(file, kind) for file, kind in CERTIFICATES}
    assert named == {name for name in OURS.files.names if name.endswith(".replay.txt")}


@pytest.mark.parametrize("file, kind", CERTIFICATES)
def test_a_certificate_is_a_run_of_its_level(file: str, kind: str) -> None:
    (recording,) = load_replays(Path(OURS.files.place(str(OURS.certificate(file, kind)))))
    level, replay = OURS.levels[file].level, recording.replay
    assert replay is not None
    assert level_digest(recording.level) == level_digest(level), "the level was changed after its certificate"
    assert (replay.outcome, replay.body, replay.practice) == ("exit", "circle", False)
    if kind == "gold":
        assert replay.gold == sum(record.kind == GOLD for record in level.objects)


def test_table_of_pars_is_what_the_certificates_say() -> None:
    made = dict(make_pars(OURS, tries=0))
    stale = sorted(file for file in made.keys() | OURS.pars.keys() if made.get(file) != OURS.pars.get(file))
    assert stale == [], "write it again: python3 tools/dev.py run levels pars levels"
