"""Tables of splits, as text and as JSON, and pictures of runs, for more than one command."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ninja_game.cli.terminal import table_console, use_dummy_video
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.files.user_folder import REPLAY_SUFFIX
from ninja_game.formats.run_time import seconds_text

if TYPE_CHECKING:
    from ninja_game.formats.recording import Recording
    from ninja_game.runs.splits import RunSplits, SplitRow
    from ninja_game.sim.level import Level

Table = tuple["list[RunSplits]", "list[SplitRow]"]  # the runs of a level, the best first, and the rows of their splits


def table_of(group: Sequence[RunSplits], against: Sequence[RunSplits]) -> Table:
    """The table of runs of a level, against the given one of it or else the fastest."""
    from ninja_game.runs.splits import best_run, split_table

    best = next((run for run in against if run.level_digest == group[0].level_digest), None) or best_run(group)
    runs = [best, *(run for run in group if run is not best)]
    return runs, split_table(runs, best)


def titles(recordings: Sequence[Recording]) -> list[str]:
    """Distinct names of recordings: their own, or file and record if that is missing or not unique."""
    names = [shown_text(recording.name) for recording in recordings]
    unique = [title for title, number in Counter(names).items() if title and number == 1]
    for number, recording in enumerate(recordings):
        if names[number] not in unique:
            file = Path(recording.file).name.removesuffix(REPLAY_SUFFIX)
            names[number] = f"{shown_text(file)}:{recording.record}"
    return names


def show(tables: Sequence[Table]) -> None:
    from rich.table import Table as RichTable

    from ninja_game.runs.deaths import ending_text
    from ninja_game.runs.splits import sum_of_best

    console = table_console()
    for runs, rows in tables:
        best = runs[0]
        name, *others = titles([run.recording for run in runs])
        end = best.ticks - (best.outcome != "running")
        ends = ending_text(best.outcome, best.ticks - 1, best.death)
        console.print(f"{name}: {ends}, {seconds_text(end)} s, {best.gold} gold")
        table = RichTable(box=None, pad_edge=False, header_style="bold")
        table.add_column("split")
        for name in ("x", "y", "tick", "segment", *others):
            table.add_column(name, justify="right")
        for row in rows:
            first = row.ticks[0]
            cells = [_behind(tick, first) for tick in row.ticks[1:]]
            place = f"{row.split.x:.0f}", f"{row.split.y:.0f}"
            table.add_row(row.split.name, *place, _number(first), _number(row.best_segment), *cells)
        console.print(table)
        last = sum_of_best(rows)
        console.print(f"sum of best: tick {last}, {seconds_text(last)} s\n")


def _number(count: int | None) -> str:
    return "" if count is None else str(count)


def _behind(tick: int | None, best: int | None) -> str:
    if tick is None:
        return "-"
    return f"{tick - best:+d}" if best is not None else str(tick)


def as_json(runs: Sequence[RunSplits], rows: Sequence[SplitRow]) -> dict[str, Any]:
    from ninja_game.runs.splits import sum_of_best

    return {
        "level_digest": runs[0].level_digest,
        "runs": [
            {"file": run.recording.file, "record": run.recording.record, "name": run.recording.name,
             "outcome": run.outcome, "ticks": run.ticks, "gold": run.gold}
            for run in runs
        ],
        "splits": [
            {"event": row.split.event, "object": row.split.object_id, "number": row.split.number, "x": row.split.x,
             "y": row.split.y, "ticks": row.ticks, "best_segment": row.best_segment}
            for row in rows
        ],
        "sum_of_best_tick": sum_of_best(rows),
    }  # fmt: skip


def draw(picture: Path, level: Level, paths: Sequence[tuple[str, Any]], keep: Sequence[Path]) -> None:
    """Write the picture of runs of one level. Raises ArgumentError where it would replace one of ``keep``, OSError."""
    use_dummy_video()
    from ninja_game.files.writing import write_atomically
    from ninja_game.play.replay.paths import paths_picture
    from ninja_game.ui.canvas import png_of
    from ninja_game.ui.theme import PALETTES

    surface = paths_picture(level, paths, PALETTES["classic"], 1584)
    write_atomically(picture, png_of(surface), keep=keep)
    click.echo(f"{picture}: {counted(len(paths), 'run')}", err=True)
