"""What is odd about a pack, in lines for its maker: index, names, levels, certificates, pars."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath

from ninja_game.errors import NinjaGameError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.files import CERTIFICATES, INDEX, PARS
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.pack.pars import parse_pars
from ninja_game.levels.warnings import level_warnings
from ninja_game.verification.pack_checks import certificate, make_pars

KINDS = ("exit", "gold")


def lint(pack: Pack) -> Iterator[str]:
    """Every finding as "place: what"; none for a proper pack."""
    in_episodes = {level.file for levels in pack.episodes.values() for level in levels}
    yield from pack.problems
    yield from _about_index(pack)
    for file, named in pack.levels.items():
        if named.file not in in_episodes:
            yield f"{pack.files.place(file)}: in no episode; it can be played as a single level"
    yield from _about_levels(pack)
    sound = True
    for finding in _about_certificates(pack):
        sound = False
        yield finding
    if sound:
        yield from _about_pars(pack)


def _about_index(pack: Pack) -> Iterator[str]:
    place, index = pack.files.place(INDEX), pack.index
    if not index.author:
        yield f"{place}: no author"
    used = {episode.number // EPISODES_PER_COLUMN for episode in index.episodes}
    if used and index.columns and max(used) >= len(index.columns):
        yield f"{place}: column {max(used)} has episodes and no name; expected {max(used) + 1} names in columns"
    names: dict[str, int] = {}
    for episode in index.episodes:
        where = f"{place}:{episode.line}: episode {episode.number}"
        if not episode.name:
            yield f"{where} has no name"
        elif episode.name in names:
            yield f"{where} has the name of episode {names[episode.name]}"
        names[episode.name] = episode.number
        if episode not in pack.episodes:
            yield f"{where} has no levels; expected files {episode.number:02d}-….txt"
    if not index.episodes:
        yield f"{place}: no episodes; expected a table [[episode]] for each"


def _about_levels(pack: Pack) -> Iterator[str]:
    names: dict[str, str] = {}
    levels: dict[str, str] = {}
    places: dict[str, str] = {}
    for file, named in pack.levels.items():
        place = pack.files.place(file)
        if named.form == "ascii" and named.name == PurePath(file).stem:
            yield f"{place}: no name"
        if not named.author:
            yield f"{place}: no author"
        digest = level_digest(named.level)
        for what, key, seen in (("name", named.name, names), ("content", digest, levels)):
            if key in seen:
                yield f"{place}: the same {what} as {seen[key]}"
            seen.setdefault(key, file)
        if file[:2].isdecimal() and file[2:3] == "-" and file[4:5] == "-":
            if file[:4] in places:
                yield f"{place}: the place {file[:4]} is that of {places[file[:4]]} too"
            places.setdefault(file[:4], file)
        for warning in level_warnings(named.level):
            yield f"{place}: {warning}"


def _about_certificates(pack: Pack) -> Iterator[str]:
    named = {pack.certificate(file, kind) for file in pack.levels for kind in KINDS}
    for name in pack.files.names:
        if name.startswith(CERTIFICATES) and name not in named:
            yield f"{pack.files.place(name)}: of no level here; expected LEVEL.exit.replay.txt or LEVEL.gold.replay.txt"
    for file in pack.levels:
        for kind in KINDS:
            try:
                found = certificate(pack, file, kind)
                if found:
                    yield from (f"{found.place}: {problem}" for problem in found.problems)
                elif kind == "exit":
                    yield f"{pack.files.place(file)}: no certificate, so nobody knows whether it can be passed"
            except NinjaGameError as error:
                yield str(error)


def _about_pars(pack: Pack) -> Iterator[str]:
    place = pack.files.place(PARS)
    how = "`ninja-game levels pars` makes it"
    if PARS not in pack.files.names:
        yield f"{place}: not there; {how}"
        return
    try:
        known = parse_pars(pack.files.text(PARS), file=place)
    except NinjaGameError as error:
        yield str(error)
        return
    if known != dict(make_pars(pack, tries=0)):
        yield f"{place}: made from other levels or certificates; {how} anew"
