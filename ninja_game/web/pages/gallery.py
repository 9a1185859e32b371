"""The gallery: a page of all levels, and one for each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.links.making import level_link
from ninja_game.formats.pack.pars import MARGINS, MEDALS, Pars
from ninja_game.formats.recording import Recording
from ninja_game.formats.run_time import seconds_text
from ninja_game.player.catalogue import Entry
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.sim.level import makes_object
from ninja_game.web.pages.frame import (
    GAME,
    HOME,
    NAVIGATION,
    Content,
    Markup,
    Pages,
    definitions,
    joined,
    page,
    section,
    table,
    tag,
)
from ninja_game.web.pages.published import (
    PICTURE_WIDTH,
    PublishedLevels,
    page_name,
    picture,
    picture_name,
    shared_name,
    shared_text,
    watch_address,
)

UP = "../"
PICTURE_HEIGHT = PICTURE_WIDTH * 600 // 792
KINDS = {"exit": "To the exit", "gold": "With all gold"}


def level_page(
    entry: Entry,
    certificates: Mapping[str, Recording],
    game: str,
    links: Sequence[tuple[str, str]],
    more: Content = None,
) -> tuple[str, dict[str, str]]:
    """The page of a level, and the texts of the replays that it leads to, by their stems.

    ``game``: address of the page with the game, as seen from this one; ``more``: what stands below.
    """
    texts: dict[str, str] = {}
    runs = []
    for kind, recording in certificates.items():
        text = shared_text(recording.replay, entry.named.level)
        stem = shared_name(text)
        texts[stem] = text
        tick = recording.replay.final_tick
        runs.append((KINDS[kind], seconds_text(tick), tag("a", "Watch", href=watch_address(game, stem))))
    named = entry.named
    about = [("Author", named.author or "unknown")]
    if entry.episode:
        about.append(("Episode", entry.episode))
    if entry.pars and entry.pars.difficulty is not None:
        about.append(("Difficulty", f"{entry.pars.difficulty:.1f}, {entry.pars.grade}"))
    about.append(("Objects", objects_text(entry)))
    facts = tag("div", _play(entry, game), definitions(about), class_="about")
    contents = [
        tag("p", named.comment, class_="lead") if named.comment else None,
        tag("div", level_image(entry, UP), facts, class_="level"),
        section("Par times", _pars(entry.pars)) if entry.pars else None,
        section("Certificates", table("Runs that prove the level", ("Run", "Time", "Watch"), runs)) if runs else None,
        more,
    ]
    return page(entry.title, *contents, up=UP, links=links, picture=UP + picture_name(entry.digest)), texts


def level_image(entry: Entry, up: str = "", *, lazy: bool = False) -> Markup:
    return tag(
        "img", src=up + picture_name(entry.digest), alt=f"Picture of the level {entry.title}",
        width=PICTURE_WIDTH, height=PICTURE_HEIGHT, loading="lazy" if lazy else None,
    )  # fmt: skip


def _play(entry: Entry, game: str) -> Content:
    """A link that plays the level; none for a level that fits into no link."""
    named = entry.named
    try:
        link = level_link(named.level, name=entry.title, author=named.author, comment=named.comment)
    except NinjaGameError:
        return None
    return tag("p", tag("a", "Play this level", href=game + link, class_="button"))


def objects_text(entry: Entry) -> str:
    """How many objects of each kind, the commonest first."""
    counts = Counter(KIND_NAMES[spec.kind] for spec in entry.named.level.objects if makes_object(spec))
    return ", ".join(f"{count} {kind}" for kind, count in counts.most_common()) or "none"


def _pars(pars: Pars) -> Markup:
    times = [*(f"{seconds_text(pars.par(medal))} s" for medal in MARGINS), "any"]
    rows = [(joined(medal_mark(medal), f" {medal.capitalize()}"), time) for medal, time in zip(MEDALS, times, strict=True)]
    return table("To the exit in at most", ("Medal", "Time"), rows)


def medal_mark(medal: str) -> Content:
    """A small mark for a medal, "" for none; its letter tells it rejected, not only its colour."""
    return tag("span", medal[0].upper(), class_=f"medal {medal}", title=medal) if medal in MEDALS else joined()


FOLDER, BOARD = "gallery", "board"
"""Folders of a site: the gallery's pages, and those of a board."""

SORT_ORDERS = (("", "in playing order"), ("name", "by name"), ("difficulty", "by difficulty"), ("par", "by par time"))

LONGEST_NAME = 60
"""Characters of a name in the list."""

Links = Sequence[tuple[str, str]]


def write_gallery(out: Path, shown: PublishedLevels, *, game: str = GAME) -> Path:
    """Write ``out/gallery/`` and the certificates into ``out/replays/``; the gallery's first page.

    ``game``: name of the page with the game in ``out``. Raises FileError where ``out/gallery`` holds something else.
    """
    pages = Pages(out, FOLDER)
    whole = (out / HOME).is_file()
    links = [(f"../{address}", title) for address, title in NAVIGATION] if whole else [(f"../{game}", "Play")]
    if (out / BOARD / "index.html").is_file():
        links.append((f"../{BOARD}/index.html", "Board"))
    write_levels(pages, shown, f"../{game}", "index.html", links)
    return pages.folder / "index.html"


def write_levels(pages: Pages, shown: PublishedLevels, game: str, name: str, links: Links) -> None:
    """Write pictures, level pages and their list into a folder of pages.

    ``game``: address of the page with the game, as seen from the list; ``name``: file of the list; ``links``: what
    stands above every page, addresses as seen from the list.
    """
    deeper = [(f"../{address}", title) for address, title in (*links, (name, "Levels"))]
    for digest, entry in shown.entries.items():
        pages.write(picture_name(digest), picture(entry.named.level))
        text, replays = level_page(entry, shown.runs.get(digest, {}), f"../{game}", deeper)
        pages.write(page_name(digest), text)
        for stem, replay in replays.items():
            pages.write_replay(stem, replay)
    pages.write(name, page("Levels", *_list(shown), links=links))
    # Last of all: where the disk is full, the pages of an earlier time are all there.
    pages.clear("levels")
    pages.clear("pictures")


def _list(shown: PublishedLevels) -> list[Content]:
    """The list of levels with its search, which only a script makes visible."""
    count = len(shown.entries)
    lead = f"{shown.name}{f' by {shown.author}' if shown.author else ''}: {counted(count, 'level')}."
    cards = tag("ul", *(_card(entry, place) for place, entry in enumerate(shown.entries.values())), class_="cards")
    comment = tag("p", shown.comment) if shown.comment else None
    return [tag("p", lead, class_="lead"), comment, search(_episodes(shown)), cards]


def _episodes(shown: PublishedLevels) -> Mapping[str, str]:
    """Numbers and names of the episodes."""
    return {f"{number:02d}": f"{number}: {each.name}" for number, each in sorted(shown.levels.episodes.items())}


def search(episodes: Mapping[str, str]) -> Markup:
    """The search above a list; without a script it does not show."""
    options = [tag("option", name, value=value) for value, name in SORT_ORDERS]
    chosen = [tag("option", name, value=value) for value, name in episodes.items()]
    select = tag("label", "Episode ", tag("select", tag("option", "all", value=""), *chosen, name="episode"))
    sort = tag("label", "Sort ", tag("select", *options, name="sort"))
    field = tag("label", "Search ", tag("input", type="search", name="words", autocomplete="off"))
    found = tag("p", role="status", class_="found")
    fields = (field, select if episodes else None, sort, found)
    return tag("form", *fields, class_="search", role="search", hidden=True)


def _card(entry: Entry, place: int) -> Markup:
    """A level in the list."""
    pars = entry.pars
    facts: list[Content] = [tag("span", f"by {entry.named.author}" if entry.named.author else "author unknown")]
    if pars:
        facts.append(tag("span", f"gold medal {seconds_text(pars.par('gold'))} s"))
    difficulty = f"{pars.difficulty:.1f}" if pars and pars.difficulty is not None else ""
    if pars and difficulty:
        facts.append(tag("span", f"difficulty {difficulty}, {pars.grade}"))
    name = tag("a", shown_text(entry.title, LONGEST_NAME), href=page_name(entry.digest))
    number = tag("span", entry.episode, class_="number") if entry.episode else None
    words = f"{entry.title} {entry.named.author} {entry.named.comment} {entry.episode}".casefold()
    return tag(
        "li", level_image(entry, lazy=True), tag("h2", number, joined(" ") if number else None, name),
        tag("p", *facts, class_="facts"), class_="card",
        data_words=words, data_episode=entry.episode[:2], data_place=place, data_name=entry.title.casefold(),
        data_difficulty=difficulty or None, data_par=pars.exit if pars else None,
    )  # fmt: skip
