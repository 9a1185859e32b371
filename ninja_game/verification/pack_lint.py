"""What is odd about a pack, for its maker: index, names, levels, certificates, pars."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath

from ninja_game.errors import NinjaGameError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.files import CERTIFICATES, INDEX, PARS
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.pack.pars import parse_pars
from ninja_game.levels.findings import PackFinding, in_pack
from ninja_game.levels.warnings import level_findings
from ninja_game.verification.pack_checks import certificate, make_pars

KINDS = ("exit", "gold")


def lint(pack: Pack) -> Iterator[PackFinding]:
    """Every finding; none for a proper pack."""
    in_episodes = {level.file for levels in pack.episodes.values() for level in levels}
    yield from (in_pack("unreadable", why=problem) for problem in pack.problems)
    yield from _about_index(pack)
    for file, named in pack.levels.items():
        if named.file not in in_episodes:
            yield in_pack("single-level", pack.files.place(file))
    yield from _about_levels(pack)
    sound = True
    for finding in _about_certificates(pack):
        sound = False
        yield finding
    if sound:
        yield from _about_pars(pack)


def _about_index(pack: Pack) -> Iterator[PackFinding]:
    place, index = pack.files.place(INDEX), pack.index
    if not index.author:
        yield in_pack("no-author", place)
    used = {episode.number // EPISODES_PER_COLUMN for episode in index.episodes}
    if used and index.columns and max(used) >= len(index.columns):
        yield in_pack("column-without-name", place, column=max(used), needed=max(used) + 1)
    names: dict[str, int] = {}
    for episode in index.episodes:
        where, number = f"{place}:{episode.line}", episode.number
        if not episode.name:
            yield in_pack("episode-name", where, number=number)
        elif episode.name in names:
            yield in_pack("same-episode-name", where, number=number, other=names[episode.name])
        names[episode.name] = number
        if episode not in pack.episodes:
            yield in_pack("empty-episode", where, number=number)
    if not index.episodes:
        yield in_pack("no-episodes", place)


def _about_levels(pack: Pack) -> Iterator[PackFinding]:
    names: dict[str, str] = {}
    levels: dict[str, str] = {}
    places: dict[str, str] = {}
    for file, named in pack.levels.items():
        place = pack.files.place(file)
        if named.form == "ascii" and named.name == PurePath(file).stem:
            yield in_pack("no-name", place)
        if not named.author:
            yield in_pack("no-author", place)
        digest = level_digest(named.level)
        for code, key, seen in (("same-name", named.name, names), ("same-content", digest, levels)):
            if key in seen:
                yield in_pack(code, place, other=seen[key])
            seen.setdefault(key, file)
        if file[:2].isdecimal() and file[2:3] == "-" and file[4:5] == "-":
            if file[:4] in places:
                yield in_pack("same-place", place, number=file[:4], other=places[file[:4]])
            places.setdefault(file[:4], file)
        for finding in level_findings(named.level):
            yield PackFinding(place, finding.code, finding.sentence)


def _about_certificates(pack: Pack) -> Iterator[PackFinding]:
    named = {pack.certificate(file, kind) for file in pack.levels for kind in KINDS}
    for name in pack.files.names:
        if name.startswith(CERTIFICATES) and name not in named:
            yield in_pack("stray-certificate", pack.files.place(name))
    for file in pack.levels:
        for kind in KINDS:
            try:
                found = certificate(pack, file, kind)
                if found:
                    yield from (in_pack("certificate", found.place, why=problem) for problem in found.problems)
                elif kind == "exit":
                    yield in_pack("no-certificate", pack.files.place(file))
            except NinjaGameError as error:
                yield in_pack("unreadable", why=error)


def _about_pars(pack: Pack) -> Iterator[PackFinding]:
    place = pack.files.place(PARS)
    if PARS not in pack.files.names:
        yield in_pack("no-pars", place)
        return
    try:
        known = parse_pars(pack.files.text(PARS), file=place)
    except NinjaGameError as error:
        yield in_pack("unreadable", why=error)
        return
    if known != dict(make_pars(pack, tries=0)):
        yield in_pack("old-pars", place)
