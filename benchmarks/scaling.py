"""How cost grows: every chart of docs/performance.md. `ninja-game bench --scaling FOLDER` calls this."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from benchmarks import measure_grids, measure_worlds
from benchmarks.charts import Chart
from ninja_game.formats.recording import Recording


def measure(recordings: Sequence[Recording], folder: Path, only: str = "") -> list[Chart]:
    """Measure and save all charts, or those whose name holds ``only``. Takes some minutes."""
    sources: dict[str, Callable[[], Chart]] = {
        "speed-against-threads": lambda: measure_worlds.threads(recordings),
        "speed-against-worlds": lambda: measure_worlds.worlds(recordings),
        "ninja-query-against-objects": measure_worlds.objects,
        "tick-against-objects": measure_worlds.whole_ticks,
        "memory-against-objects": measure_worlds.memory,
        "ray-against-length": measure_worlds.rays,
        "query-against-objects": measure_grids.queries,
        "pairs-against-objects": measure_grids.pairs,
        "moves-against-objects": measure_grids.moves,
    }
    charts = [source() for name, source in sources.items() if only in name]
    for chart in charts:
        chart.save(folder)
    return charts
