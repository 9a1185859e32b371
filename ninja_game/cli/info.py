"""`ninja-game info`: what is in level and replay files."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ninja_game.cli.options import LevelPath, level_option, load_level_option, record_option
from ninja_game.cli.terminal import table_console
from ninja_game.files.shown_text import shown_text
from ninja_game.formats.run_time import seconds_text
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.sim.level import makes_object

if TYPE_CHECKING:
    from rich.console import Console

    from ninja_game.formats.load import NamedLevel, Recording


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=LevelPath())
@record_option
@level_option
@click.option("--picture/--no-picture", default=None, help="Draw the level. [default: if it is the only one]")
@click.option("--json", "as_json", is_flag=True, help="One JSON object per level, for programs.")
def info(
    files: Sequence[Path], record: int | None, level_path: Path | None, picture: bool | None, as_json: bool
) -> None:
    """Show what is in level and replay files.

    Names and authors, counts of objects, recordings, warnings of what is odd, and a picture of the level. FILE may be
    a folder. Several levels make a table; choose one of them with --record.

    \b
    Examples:
      ninja-game info 00-0-first-steps
      ninja-game info my-levels/
      ninja-game info userlevels.txt --record 17
      ninja-game info userlevels.txt --json
      ninja-game info demo.txt --level level.txt
    """
    from ninja_game.formats.load import load_levels
    from ninja_game.runs.recording_reader import Unreadable, recordings_in

    console = table_console()
    play_level = load_level_option(level_path)
    runs = [run for run in recordings_in(files, play_level) if not isinstance(run, Unreadable)]
    levels = list(map(_level_of, runs)) if play_level else [level for file in files for level in load_levels(file)]
    if record is not None:
        levels = [level for level in levels if level.record == record]
        if not levels:
            raise click.UsageError(f"there is no record {record}")
    recordings = {(run.file, run.record): run for run in runs}
    if as_json:
        for level in levels:
            click.echo(json.dumps(_facts(level, recordings.get((level.file, level.record)))))
    elif len(levels) == 1 or record is not None or picture:
        for level in levels:
            _show(console, level, recordings.get((level.file, level.record)), picture is not False)
    else:
        _show_table(console, levels, recordings)


def _level_of(run: Recording) -> NamedLevel:
    """A recording's level under the recording's name."""
    from ninja_game.formats.named_level import NamedLevel

    return NamedLevel(run.name, run.author, run.comment, run.level, run.file, run.record, run.line)


def _kind_counts(level: NamedLevel) -> Counter[str]:
    return Counter(KIND_NAMES[spec.kind] for spec in filter(makes_object, level.level.objects))


def _object_counts(level: NamedLevel) -> Counter[str]:
    """The number of objects of each sort with a word in level files: zap drones apart from laser drones.

    If there are more objects than can be played, which take long, the number of each kind.
    """
    from ninja_game.formats.ascii.writer import best_form
    from ninja_game.sim.schema.world_fields import CAPACITY

    specs = list(filter(makes_object, level.level.objects))
    if len(specs) >= CAPACITY:
        return _kind_counts(level)
    return Counter(best_form(spec)[0] or KIND_NAMES[spec.kind] for spec in specs)


def _message_lines(level: NamedLevel) -> list[str]:
    """The messages, each with its moment, as players with the default keys see them in their first try."""
    from ninja_game.files.bundled import asset_rows
    from ninja_game.formats.messages import SEPARATOR, level_text

    key_names = {
        action: keys.split()[0].capitalize() for action, _, _, keys, *_ in asset_rows("commands/game.txt") if keys
    }
    text = level_text(level.says, key_names.__getitem__, 0, _kind_counts(level)["gold"], 0)
    return [part.strip().replace(r"\n", " ") for part in text.split(SEPARATOR)]


def _facts(level: NamedLevel, run: Recording | None) -> dict[str, Any]:
    from ninja_game.formats.n14.level_string import level_digest
    from ninja_game.levels.lint import level_warnings

    facts: dict[str, Any] = {
        "file": level.file, "record": level.record, "line": level.line, "form": level.form, "name": level.name,
        "author": level.author, "comment": level.comment, "teaches": level.teaches, "says": level.says,
        "objects": dict(_kind_counts(level)),
        "level_digest": level_digest(level.level), "warnings": level_warnings(level.level, level.says),
    }  # fmt: skip
    if not run:
        return facts
    return facts | {
        "recording_ticks": run.ticks,
        "made": str(run.replay.made),
        "co_authors": list(run.replay.co_authors),
    }


def _show(console: Console, level: NamedLevel, run: Recording | None, picture: bool) -> None:
    from rich.text import Text

    from ninja_game.levels.lint import level_warnings
    from ninja_game.levels.picture import level_picture

    name, author, comment, file = map(shown_text, (level.name, level.author, level.comment, level.file))
    by = f" by {author}" if author else ""
    console.print(Text.assemble((name or "(no name)", "bold"), by, f"  {comment}" if comment else ""))
    if level.teaches:
        console.print(Text(f"teaches: {shown_text(level.teaches)}"))
    for line in _message_lines(level) if level.says else ():
        console.print(Text(f"says, {shown_text(line, len(line))}"))
    console.print(Text(f"{file}, record {level.record}", "dim"))
    if picture:
        console.print(level_picture(level.level), soft_wrap=True)
    objects = ", ".join(f"{count} {kind}" for kind, count in _object_counts(level).items())
    console.print(Text(objects or "no objects"))
    if run:
        length = run.replay.length if run.replay.outcome else run.ticks - 1
        cut = f", truncated: {run.missing} ticks of inputs are missing" if run.missing else ""
        console.print(Text(f"recording: to tick {length} at most, {seconds_text(length)} s{cut}"))
        if made := shown_text(str(run.replay.made)):
            console.print(
                Text(f"made: {made}" + "".join(f", with {shown_text(name)}" for name in run.replay.co_authors))
            )
    if run and not run.replay.unclaimed:
        replay = run.replay
        console.print(Text(f"claims: {replay.outcome}, gold {replay.gold}, body {replay.body}, rules {replay.rules}"))
    for warning in level_warnings(level.level, level.says):
        console.print(Text.assemble(("warning: ", "yellow"), warning))


def _show_table(console: Console, levels: Sequence[NamedLevel], recordings: dict[tuple[str, int], Recording]) -> None:
    from rich.markup import escape
    from rich.table import Table

    from ninja_game.levels.lint import level_warnings

    table = Table(box=None, pad_edge=False, header_style="bold")
    sizes = Counter(level.file for level in levels)
    table.add_column("file" if len(sizes) > 1 else "record", no_wrap=True)
    for title in ("name", "author"):
        table.add_column(title, overflow="fold")
    for title in ("objects", "gold", "last tick", "warnings"):
        table.add_column(title, justify="right")
    for level in levels:
        counts = _kind_counts(level)
        run = recordings.get((level.file, level.record))
        warnings = len(level_warnings(level.level, level.says))
        place = f":{level.record}" if sizes[level.file] > 1 else ""
        table.add_row(
            escape(shown_text(Path(level.file).name)) + place if len(sizes) > 1 else str(level.record),
            escape(shown_text(level.name)),
            escape(shown_text(level.author)),
            str(sum(counts.values())),
            str(counts["gold"]),
            str(run.ticks - 1) if run else "",
            str(warnings) if warnings else "",
        )
    console.print(table)
    console.print(f"{len(levels)} levels; --record N shows one of them")
