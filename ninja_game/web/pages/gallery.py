"""The gallery of levels, a page for each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from functools import cache
from hashlib import sha256
from io import BytesIO
from math import dist
from pathlib import Path
from posixpath import normpath

import numpy as np
import pygame
from numpy.typing import NDArray

from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.ascii.writer import headers_of
from ninja_game.formats.links import level_link, write_watch
from ninja_game.formats.pack.pars import MARGINS, MEDALS, Pars
from ninja_game.formats.replay.text import shared_text
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import Entry
from ninja_game.levels.published import RUN_TITLES, PublishedLevels
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.sim.level import Level, makes_object
from ninja_game.ui.theme import CLASSIC
from ninja_game.view.sprites.thumbnail import thumbnail
from ninja_game.web.pages import frame
from ninja_game.web.pages.frame import Content, Markup, Pages, definitions, joined, section, table, tag

PICTURE_WIDTH = 792


def page_name(digest: str) -> str:
    return f"levels/{digest[:16]}.html"


def picture_name(digest: str) -> str:
    return f"pictures/{digest[:16]}.png"


def picture(level: Level) -> bytes:
    """The level as a PNG, as the game draws it, with reduced colours for a small file."""
    from PIL import Image

    _keep_freed_memory()
    surface = thumbnail(level, CLASSIC, PICTURE_WIDTH)
    image = Image.frombytes("RGB", surface.get_size(), pygame.image.tobytes(surface, "RGB"))
    out = BytesIO()
    image.quantize(128, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(out, "png")
    return out.getvalue()


@cache
def _keep_freed_memory() -> None:
    """Keep freed memory: glibc returns all beyond twice the largest freed piece so far, of 32 MiB at most.

    Allocating it again for each surface took a third of a picture's time.
    """
    bytearray(31 << 20)


def watch_address(game: str, *stems: str) -> str:
    """The address for watching runs: ``game`` is the address of the page with the game."""
    return game + write_watch(stems)


UP = "../"
PICTURE_HEIGHT = PICTURE_WIDTH * 600 // 792
PICTURE_SIZE = {"width": PICTURE_WIDTH, "height": PICTURE_HEIGHT}
GALLERY = "gallery"
BOARD = "board"

Links = Sequence[tuple[str, str]]


def level_page(
    entry: Entry,
    certificates: Mapping[str, tuple[str, int]],
    game: str,
    links: Links,
    more: Content = None,
    *,
    site: str = "",
    top: Content = None,
    drawn: Content = None,
) -> str:
    """The page of a level. ``certificates``: stems of its replays and their ticks, by kind.

    ``game``: address of the page with the game, relative to this one; ``more``: the part below; ``site``: the address
    of the folder of pages, if it is known; ``top``: the part above; ``drawn``: instead of its picture.
    """
    runs = [
        (
            tag("a", kind, href=f"../../{frame.REPLAYS}/{stem}.html"),
            seconds_text(tick),
            tag("a", "Watch", href=watch_address(game, stem)),
        )
        for kind, (stem, tick) in certificates.items()
    ]
    named = entry.named
    about = [("Author", named.author or "unknown")]
    if entry.episode:
        about.append(("Episode", entry.episode))
    if entry.pars and entry.pars.difficulty is not None:
        about.append(("Difficulty", f"{entry.pars.difficulty:.1f}, {entry.pars.grade}"))
    about.append(("Objects", objects_text(entry)))
    facts = tag("div", _play(entry, game), definitions(about), class_="about")
    contents = [
        top,
        tag("p", named.comment, class_="lead") if named.comment else None,
        tag("div", tag("div", drawn) if drawn else level_image(entry, UP), facts, class_="level"),
        section("Par times", _pars(entry.pars)) if entry.pars else None,
        section("Certificates", table("Runs that prove the level", ("Run", "Time", "Watch"), runs)) if runs else None,
        more,
    ]
    summary = ". ".join(f"{name}: {text}" for name, text in about)
    preview = (site or UP) + picture_name(entry.digest)
    return frame.page(entry.title, *contents, up=UP, links=links, picture=preview, description=named.comment or summary)


def run_page(
    entry: Entry, stem: str, title: str, facts: Links, *, folder: str, game: str, links: Links, site: str,
    drawn: Content = None, more: Content = None, below: Content = None,
) -> str:  # fmt: skip
    """The small page of a run, beside it in ``replays``, for the preview of its link in a chat, with links to it.

    ``folder``: of the pages with the level's; ``game``, ``links``: relative to their first one; ``site``: as above;
    ``drawn``: its path over the level; ``more``: the part below the facts; ``below``: all that.
    """
    place = f"../{folder}/"
    facts = [*((name, text) for name, text in facts if text), ("Author of the level", entry.named.author or "unknown")]
    leads = (
        tag("p", tag("a", "Watch this run", href=watch_address(game, stem), class_="button")),
        definitions(facts),
        more,
        tag("p", tag("a", "The level", href=place + page_name(entry.digest))),
        tag("p", tag("a", "The replay as a file", href=f"{stem}.txt", download=True)),
    )
    drawn = tag("div", drawn) if drawn else level_image(entry, place)
    level_part = tag("div", drawn, tag("div", *leads, class_="about"), class_="level")
    summary = ". ".join(f"{name}: {text}" for name, text in facts)
    preview = (site or place) + picture_name(entry.digest)
    links = [(normpath(place + address), name) for address, name in links]
    return frame.page(title, level_part, below, up=place, links=links, picture=preview, description=summary)


MAX_POINTS = 400  # points of a drawn path
_NEAREST = 4.0  # least px between two points of a path


def path_data(positions: NDArray[np.float64]) -> str:
    """A path in whole px, without points near the one before.

    >>> path_data(np.array([[24.2, 36.0], [25.0, 36.0], [40.0, 30.0]]))
    'M24 36l16-6'
    """
    whole = positions.round().astype(int)
    length = float(np.hypot(*np.diff(positions, axis=0).T).sum())
    apart = max(_NEAREST, length / MAX_POINTS)
    first, *others = whole.tolist()
    places = [first]
    for place in others:
        if dist(place, places[-1]) >= apart:
            places.append(place)
    moves = "".join(f"{x}{'' if y < 0 else ' '}{y} " for x, y in np.diff(places, axis=0).tolist())
    return f"M{places[0][0]} {places[0][1]}" + (f"l{moves.rstrip()}" if moves else "")


def level_image(entry: Entry, up: str = "", *, lazy: bool = False) -> Markup:
    alt = f"Picture of the level {entry.title}"
    return tag("img", src=up + picture_name(entry.digest), alt=alt, **PICTURE_SIZE, loading="lazy" if lazy else None)


def _play(entry: Entry, game: str) -> Content:
    """A link to play the level; none if the level does not fit into a link."""
    named = entry.named
    try:
        link = level_link(named.level, **headers_of(named) | {"name": entry.title})
    except NinjaGameError:
        return None
    return tag("p", tag("a", "Play this level", href=game + link, class_="button"))


def objects_text(entry: Entry) -> str:
    counts = Counter(KIND_NAMES[spec.kind] for spec in entry.named.level.objects if makes_object(spec))
    texts = [counted(count, kind, kind if kind == "gold" else "") for kind, count in counts.most_common()]
    return ", ".join(texts) or "none"


def _pars(pars: Pars) -> Markup:
    times = [*(f"{seconds_text(pars.par(medal))} s" for medal in MARGINS), "any"]
    rows = [
        (joined(medal_mark(medal), f" {medal.capitalize()}"), time) for medal, time in zip(MEDALS, times, strict=True)
    ]
    return table("To the exit in at most", ("Medal", "Time"), rows)


def medal_mark(medal: str) -> Content:
    """A small mark for a medal, "" for none; its letter tells it as well as its colour."""
    return tag("span", medal[0].upper(), class_=f"medal {medal}", title=medal) if medal in MEDALS else joined()


SORT_ORDERS = (("", "in playing order"), ("name", "by name"), ("difficulty", "by difficulty"), ("par", "by par time"))

_MAX_NAME = 60  # characters of a name in the list


def write_gallery(out: Path, shown: PublishedLevels, *, address: str = "") -> Path:
    """Write ``out/gallery/`` and the certificates into ``out/replays/``; the gallery's first page.

    ``address``: of ``out``, if it is known. Raises FileError if ``out/gallery`` holds other files.
    """
    pages = Pages(out, GALLERY)
    whole = (out / frame.HOME_PAGE).is_file()
    links = [
        (f"../{address}", title) for address, title in (frame.NAVIGATION if whole else [(frame.GAME_PAGE, "Play")])
    ]
    if (out / BOARD / "index.html").is_file():
        links.append((f"../{BOARD}/index.html", "Board"))
    site = address and f"{address}{GALLERY}/"
    game = f"../{frame.GAME_PAGE}"
    near = (*links, ("index.html", "Levels"))
    deeper = [(f"../{address}", title) for address, title in near]
    for digest, entry in shown.entries.items():
        pages.write(picture_name(digest), picture(entry.named.level))
        certificates = {}
        for kind, recording in shown.runs.get(digest, {}).items():
            text = shared_text(recording.replay, entry.named.level)
            tick = recording.replay.final_tick
            stem = sha256(text.encode()).hexdigest()[:16]
            title = f"{entry.title} {RUN_TITLES[kind].lower()}"
            certificates[RUN_TITLES[kind]] = stem, tick
            facts = [("Time", f"{seconds_text(tick)} s"), ("Made", str(recording.replay.made))]
            pages.write(f"{stem}.txt", text, replay=True)
            run = run_page(entry, stem, title, facts, folder=pages.folder.name, game=game, links=near, site=site)
            pages.write(f"{stem}.html", run, replay=True)
        pages.write(page_name(digest), level_page(entry, certificates, f"../{game}", deeper, site=site))
    pages.write("index.html", frame.page("Levels", *_list(shown), links=links))
    # Last: if the disk is full, the earlier pages are still complete.
    pages.clear("levels")
    pages.clear("pictures")
    return pages.folder / "index.html"


def _list(shown: PublishedLevels) -> list[Content]:
    """The list of levels with its search, which a script makes visible."""
    count = len(shown.entries)
    by = f" by {shown.author}" if shown.author else ""
    lead = f"{shown.name}{by}: {counted(count, 'level')}."
    cards = tag("ul", *(_card(entry, place) for place, entry in enumerate(shown.entries.values())), class_="cards")
    comment = tag("p", shown.comment) if shown.comment else None
    return [tag("p", lead, class_="lead"), comment, search_field(_episodes(shown)), cards]


def _episodes(shown: PublishedLevels) -> Mapping[str, str]:
    """Numbers and names of the episodes."""
    return {f"{number:02d}": f"{number}: {episode.name}" for number, episode in sorted(shown.levels.episodes.items())}


def search_field(episodes: Mapping[str, str]) -> Markup:
    """The search above a list; hidden without a script."""
    options = [tag("option", name, value=value) for value, name in SORT_ORDERS]
    chosen = [tag("option", name, value=value) for value, name in episodes.items()]
    select = tag("label", "Episode ", tag("select", tag("option", "all", value=""), *chosen, name="episode"))
    sort = tag("label", "Sort ", tag("select", *options, name="sort"))
    field = tag("label", "Search ", tag("input", type="search", name="words", autocomplete="off"))
    status = tag("p", role="status", class_="found")
    fields = (field, select if episodes else None, sort, status)
    return tag("form", *fields, class_="search", role="search", hidden=True)


def _card(entry: Entry, place: int) -> Markup:
    pars = entry.pars
    facts: list[Content] = [tag("span", f"by {entry.named.author}" if entry.named.author else "author unknown")]
    if pars:
        facts.append(tag("span", f"gold medal {seconds_text(pars.par('gold'))} s"))
    difficulty = f"{pars.difficulty:.1f}" if pars and pars.difficulty is not None else ""
    if pars and difficulty:
        facts.append(tag("span", f"difficulty {difficulty}, {pars.grade}"))
    name = tag("a", shown_text(entry.title, _MAX_NAME), href=page_name(entry.digest))
    number = tag("span", entry.episode, class_="number") if entry.episode else None
    words = f"{entry.title} {entry.named.author} {entry.named.comment} {entry.episode}".casefold()
    head = tag("h2", number, joined(" ") if number else None, name)
    below = tag("p", *facts, class_="facts")
    return tag(
        "li", level_image(entry, lazy=True), head, below, class_="card", data_words=words,
        data_episode=entry.episode[:2], data_place=place, data_name=entry.title.casefold(),
        data_difficulty=difficulty or None, data_par=pars.exit if pars else None,
    )  # fmt: skip
