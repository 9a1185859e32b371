"""Plots of a set of levels beside the reference: `dev.py tool measure.level_statistics --plots FOLDER` draws them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ninja_game.formats.pack.index import EPISODES_PER_COLUMN
from ninja_game.formats.pack.pack import Pack
from tools.measure.level_figures import DESIGN, DIFFICULTY, KNOWN

OURS, THEIRS = "#c0392b", "#34495e"


def draw_figures(rows: Sequence[Mapping[str, float]], folder: Path) -> None:
    """Draw ``figures.svg``: for each figure the reference's quartiles as a band, and a dot for each of our levels."""
    plt = _pyplot()
    shown = KNOWN | DESIGN
    figure, axes = plt.subplots(len(shown) // 2, 2, figsize=(9, 1.1 * len(shown) / 2 + 1.2), layout="constrained")
    for axis, (key, row) in zip(axes.flat, shown.items(), strict=True):
        values = sorted(each[key] for each in rows if key in each)
        axis.axvspan(row.first, row.third, color=THEIRS, alpha=0.25, lw=0, label="reference, quartiles")
        axis.axvline(row.median, color=THEIRS, lw=2, label="reference, median")
        # Dots are spread over the height in their order, so that equal ones can be told apart.
        heights = [0.1 + 0.8 * ((place * 7) % 10) / 10 for place in range(len(values))]
        axis.plot(values, heights, "o", color=OURS, ms=3, alpha=0.7, label="our levels")
        if values:
            axis.axvline(values[len(values) // 2], color=OURS, lw=2, ls="--", label="ours, median")
        axis.set(title=row.title, yticks=[], ylim=(0, 1))
        axis.title.set_size(9)
        axis.tick_params(labelsize=8)
    handles, labels = axes.flat[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, fontsize=8)
    _save(figure, folder / "figures.svg")


def draw_difficulty(pack: Pack, folder: Path) -> None:
    """Draw ``difficulty.svg``: a dot for each level in the order of the grid, the mean of each episode as a line."""
    plt = _pyplot()
    figure, axis = plt.subplots(figsize=(11, 4), layout="constrained")
    place, names, middles = 0, [], []
    for index, levels in pack.episodes.items():
        files = [Path(level.file).name for level in levels]
        found = {place + k: pack.pars[file].difficulty for k, file in enumerate(files) if file in pack.pars}
        known = {k: value for k, value in found.items() if value is not None}
        column = index.number // EPISODES_PER_COLUMN
        axis.plot(list(known), list(known.values()), "o", color=f"C{column}", ms=5)
        if known:
            mean = sum(known.values()) / len(known)
            axis.plot([place - 0.4, place + len(levels) - 0.6], [mean, mean], color=f"C{column}", lw=2, alpha=0.6)
        names.append(f"{index.number:02d} {index.name}")
        middles.append(place + (len(levels) - 1) / 2)
        place += len(levels)
    axis.axhspan(DIFFICULTY.first, DIFFICULTY.third, color=THEIRS, alpha=0.12, lw=0)
    axis.axhline(DIFFICULTY.median, color=THEIRS, lw=1, alpha=0.5)
    axis.set_xticks(middles, names, rotation=35, ha="right", fontsize=8)
    axis.set(ylabel="difficulty", xlim=(-1, place), ylim=(0, None))
    axis.grid(axis="y", alpha=0.3)
    _save(figure, folder / "difficulty.svg")


def _pyplot() -> Any:
    """The plotting library without a window, writing the same file for the same plot."""
    import matplotlib as mpl

    mpl.use("Agg")
    mpl.rcParams.update({"svg.hashsalt": "ninja-game", "svg.fonttype": "none"})
    import matplotlib.pyplot as plt

    return plt


def _save(figure: Any, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Date": None})
    _pyplot().close(figure)
