"""The table and the curves of a folder of results, as docs/ninjabench.md wants them.

    python3 -m examples.bench_report benchmarks/results/ninjabench
    python3 -m examples.bench_report benchmarks/results/ninjabench --curves docs/pictures/learning

FOLDER has files that examples/measure.py wrote, one a run; runs of one name are runs of one agent. Scores begin at
what "random" reaches. The curves need matplotlib (the extra `plots`).

Agarwal and others, "Deep reinforcement learning at the edge of the statistical precipice",
2021: interquartile means, with intervals by a stratified bootstrap over runs.
"""

from __future__ import annotations

import json
from collections import defaultdict
from itertools import product
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from examples.measure import FORMAT, TASKS
from ninja_game.errors import FileError, NinjaGameError
from ninja_game.files.reading import read_bytes
from ninja_game.learn.levels.bench import GRADES

TEST, TRAIN, SET = TASKS
RESAMPLES = 10_000
MOST_BYTES = 2**20
RANDOM = "random"


def iqm(values: Any) -> NDArray[np.float64]:
    """The mean of the middle half along the last axis: a quarter of them, rounded down, is left out at each end."""
    ordered = np.sort(np.asarray(values, np.float64), axis=-1)
    cut = ordered.shape[-1] // 4
    middle: NDArray[np.float64] = ordered[..., cut : ordered.shape[-1] - cut].mean(axis=-1)
    return middle


def interval(scores: NDArray[np.float64], share: float = 0.95) -> tuple[float, float]:
    """Where the interquartile mean of scores (runs, tasks) lies: runs are drawn again, in each task by itself."""
    runs, tasks = scores.shape
    drawn = np.random.default_rng(0).integers(runs, size=(RESAMPLES, runs, tasks))
    means = iqm(scores[drawn, np.arange(tasks)].reshape(RESAMPLES, -1))
    low, high = np.quantile(means, [(1 - share) / 2, (1 + share) / 2])
    return float(low), float(high)


def load_results(folder: Path) -> dict[tuple[str, str], list[dict[str, Any]]]:
    """The runs of each agent, by track and name. Raises FileError for a file that is none, or where there are none."""
    found = defaultdict(list)
    for path in sorted(folder.glob("*.json")):
        try:
            run = json.loads(read_bytes(path, MOST_BYTES))
            for levels, name in product(TASKS, ("passed", "par")):
                rates([run], levels, name)
            of_format = run["format"] == FORMAT
            found[str(run["track"]), str(run["agent"])].append(run)
        except (KeyError, TypeError, ValueError) as error:
            raise FileError("not results of examples/measure.py", file=str(path), found=str(error)[:80]) from error
        if not of_format:
            raise FileError("results of another format", file=str(path), found=str(run["format"])[:9], expected="1")
    if not found:
        raise FileError("there are no results", file=str(folder), expected="files *.json of examples/measure.py")
    return dict(found)


def rates(runs: list[dict[str, Any]], levels: str, name: str) -> NDArray[np.float64]:
    """A score of each run in each grade of levels, (runs, grades)."""
    grades = ("all",) if levels == SET else GRADES
    return np.array([[run["scores"][levels][grade][name] for grade in grades] for run in runs], np.float64)


def normalised(passed: NDArray[np.float64], chance: NDArray[np.float64]) -> NDArray[np.float64]:
    """0: as often as by chance; 1: always, as the known runs do."""
    return (passed - chance) / (1.0 - chance)


def table(results: dict[tuple[str, str], list[dict[str, Any]]]) -> str:
    """Markdown, a row an agent: see docs/ninjabench.md."""
    random = [run for (_, name), runs in results.items() if name == RANDOM for run in runs]
    if not random:
        raise FileError("there are no runs of the agent 'random', which scores begin at", file="", expected=RANDOM)
    chance = rates(random, TEST, "passed").mean(axis=0)
    heads = ["track", "agent", "runs", "steps", *GRADES, "normalised", "par time", "gap", "set"]
    lines = [heads, ["---"] * len(heads)]
    for (track, name), runs in sorted(results.items()):
        passed = rates(runs, TEST, "passed")
        curve = runs[0]["training"].get("curve")
        gap = rates(runs, TRAIN, "passed") - passed
        cells = [shown(passed[:, [grade]]) for grade in range(len(GRADES))]
        cells += [shown(normalised(passed, chance)), shown(rates(runs, TEST, "par"))]
        cells += [f"{100 * gap.mean():+.1f}", shown(rates(runs, SET, "passed"))]
        lines.append([track, name, str(len(runs)), f"{curve[-1][0] / 1e6:.1f}M" if curve else "-", *cells])
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def shown(scores: NDArray[np.float64]) -> str:
    """The interquartile mean in percent, and its interval where there are several runs."""
    middle = f"{100 * float(iqm(scores.ravel())):.1f}"
    if len(scores) < 2:
        return middle
    low, high = interval(scores)
    return f"{middle} [{100 * low:.1f}, {100 * high:.1f}]"


def draw_curves(results: dict[tuple[str, str], list[dict[str, Any]]], folder: Path) -> list[Path]:
    """Two pictures of how the agents learned, over steps and over minutes by the clock. Needs matplotlib."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    paths = []
    for column, name, axis in ((0, "steps", "million steps"), (1, "minutes", "minutes by the clock")):
        figure, axes = plt.subplots(figsize=(6.4, 4.0), dpi=110)
        for k, ((_, agent), runs) in enumerate(sorted(results.items())):
            for number, run in enumerate(runs):
                curve = np.array(run["training"].get("curve") or np.zeros((0, 5)), np.float64)
                across = curve[:, column] / (1e6, 60.0)[column]
                for y, style, what in ((4, "-", "levels never seen"), (3, ":", "training episodes")):
                    label = f"{agent}: {what}" if not number and len(curve) else None
                    axes.plot(across, 100 * curve[:, y], style, color=f"C{k}", linewidth=1.2, label=label)
        axes.set(xlabel=axis, ylabel="episodes passed, %", ylim=(0, None), xlim=(0, None))
        axes.grid(visible=True, alpha=0.25)
        axes.legend(frameon=False, fontsize=8)
        figure.tight_layout()
        folder.mkdir(parents=True, exist_ok=True)
        paths.append(folder / f"bench-{name}.png")
        figure.savefig(paths[-1], metadata={"Software": None})
        plt.close(figure)
    return paths


@click.command(help=__doc__.replace("\n    python3", "\n\b\n    python3", 1))
@click.argument("folder", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option("--curves", type=click.Path(file_okay=False, path_type=Path), help="Draw the curves into this folder.")
def main(folder: Path, curves: Path | None) -> None:
    try:
        results = load_results(folder)
        click.echo(table(results), nl=False)
        for path in draw_curves(results, curves) if curves else []:
            click.echo(str(path), err=True)
    except (NinjaGameError, OSError) as error:
        raise click.ClickException(str(error)) from error
    except ModuleNotFoundError as error:
        raise click.ClickException("curves need matplotlib: python3 -m pip install matplotlib") from error


if __name__ == "__main__":
    main()
