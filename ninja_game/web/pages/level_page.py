"""The page of a level: picture, objects, par times, certificates, and whatever else is known of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from ninja_game.errors import NinjaGameError
from ninja_game.formats.links.making import level_link
from ninja_game.formats.pack.pars import MARGINS, Pars
from ninja_game.formats.recording import Recording
from ninja_game.player.catalogue import Entry
from ninja_game.player.scoring import seconds_text
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.sim.level import makes_object
from ninja_game.web.pages.exhibition import PICTURE_WIDTH, picture_name, shared_name, shared_text, watch_address
from ninja_game.web.pages.frame import definitions, page, section, table
from ninja_game.web.pages.html import Content, Markup, joined, tag

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
        about.append(("Difficulty", f"{entry.pars.difficulty:.1f}"))
    about.append(("Objects", objects_text(entry)))
    facts = tag("div", _play(entry, game), definitions(about), class_="about")
    contents = [
        tag("p", named.comment, class_="lead") if named.comment else None,
        tag("div", level_image(entry, UP), facts, class_="level"),
        section("Par times", _pars(entry.pars)) if entry.pars else None,
        section("Certificates", table("Runs that prove the level", ("Run", "Time", ""), runs)) if runs else None,
        more,
    ]  # fmt: skip
    return page(entry.title, *contents, up=UP, links=links), texts


def level_image(entry: Entry, up: str = "", *, lazy: bool = False) -> Markup:
    """The level's picture."""
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
    rows = [(medal_mark(medal), medal.capitalize(), f"{seconds_text(pars.par(medal))} s") for medal in MARGINS]
    return table("To the exit in at most", ("", "Medal", "Time"), rows)


def medal_mark(medal: str) -> Content:
    """A small mark for a medal, "" for none; its letter tells it apart, not only its colour."""
    return tag("span", medal[0].upper(), class_=f"medal {medal}", title=medal) if medal in MARGINS else joined()
