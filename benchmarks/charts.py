"""Measurements as charts: a CSV each, and a picture where matplotlib is installed (extra `plots`)."""

from __future__ import annotations

import csv
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from typing import Any

ROUNDS = 15
ROUND_SECONDS = 0.02


@dataclass
class Chart:
    """One chart: points (series, x, y) and what the axes mean. ``log``: which axes are logarithmic."""

    name: str
    title: str
    x: str
    y: str
    log: str = "xy"
    points: list[tuple[str, float, float]] = field(default_factory=list)

    def add(self, series: str, x: float, y: float) -> None:
        """Note a point and print it, as a sign of progress."""
        self.points.append((series, x, float(f"{y:.5g}")))
        value = f"{y:,.0f}" if y >= 1000 else f"{y:.4g}"
        print(f"{self.name}: {series}: {x:,g} {self.x} -> {value} {self.y}", flush=True)

    def save(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        with (folder / f"{self.name}.csv").open("w", encoding="utf-8", newline="") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(("series", self.x, self.y))
            table.writerows(self.points)
        if find_spec("matplotlib"):
            self.draw(folder / f"{self.name}.png")

    def draw(self, path: Path) -> None:
        import matplotlib as mpl

        mpl.use("Agg")
        from matplotlib import pyplot as plt

        figure, axes = plt.subplots(figsize=(6.4, 4.0), dpi=110)
        for series in dict.fromkeys(point[0] for point in self.points):
            line: Any = [(x, y) for name, x, y in self.points if name == series]
            axes.plot(*zip(*line, strict=True), marker="o", markersize=4, label=series)
        axes.set(title=self.title, xlabel=self.x, ylabel=self.y)
        axes.set_xscale("log" if "x" in self.log else "linear")
        axes.set_yscale("log" if "y" in self.log else "linear")
        if "y" not in self.log:
            axes.set_ylim(bottom=0)
        axes.grid(visible=True, which="both", alpha=0.25)
        axes.legend(frameon=False, fontsize=8)
        figure.tight_layout()
        figure.savefig(path, metadata={"Software": None})
        plt.close(figure)


def seconds_per(function: Callable[[], object], rounds: int = ROUNDS) -> float:
    """Seconds that one call takes: the best of several rounds, since what disturbs a round only ever slows it down."""
    function()
    calls, took = 1, 0.0
    while (took := _seconds(function, calls)) < ROUND_SECONDS:
        calls = max(calls * 2, int(calls * ROUND_SECONDS / max(took, 1e-9)))
    return min(took, *(_seconds(function, calls) for _ in range(rounds))) / calls


def _seconds(function: Callable[[], object], calls: int) -> float:
    start = time.perf_counter()
    for _ in range(calls):
        function()
    return time.perf_counter() - start
