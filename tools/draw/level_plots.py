"""Plots of a set of levels beside the reference: `dev.py tool measure.level_statistics --plots FOLDER` draws them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from tools.measure.level_statistics import ROWS

OURS, THEIRS = "#c0392b", "#34495e"


def draw_plots(rows: Sequence[Mapping[str, float]], folder: Path) -> None:
    """Draw ``figures.svg``: for each figure the reference's quartiles as a band, and a dot for each of our levels."""
    import matplotlib as mpl

    mpl.use("Agg")
    mpl.rcParams["svg.hashsalt"] = "ninja-game"
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(len(ROWS) // 2, 2, figsize=(9, 1.1 * len(ROWS) / 2 + 1.2), layout="constrained")
    for axis, (key, row) in zip(axes.flat, ROWS.items(), strict=True):
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
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / "figures.svg", metadata={"Date": None})
    plt.close(figure)
