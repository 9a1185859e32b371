"""The table and the curves of a folder of results, as docs/ninjabench.md wants them.

    python3 -m examples.bench_report benchmarks/results/ninjabench
    python3 -m examples.bench_report benchmarks/results/ninjabench --curves docs/pictures/learning

FOLDER has files that examples/measure.py wrote, one a run; runs of one name are runs of one agent. Scores begin at
what "random" reaches. The curves need matplotlib (the extra `plots`). Runs in other levels than those of the protocol
are refused, by their digests; of other levels of `transfer`, that column alone is left out.

Agarwal and others, "Deep reinforcement learning at the edge of the statistical precipice",
2021: interquartile means, with intervals by a stratified bootstrap over runs; here over levels too.
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

from examples.measure import DIGESTS, FORMAT, TASKS
from ninja_game.errors import FileError, NinjaGameError
from ninja_game.files.reading import read_bytes
from ninja_game.learn.levels.bench import BENCH_GRADES

TEST, TRAIN, TRANSFER = TASKS
RESAMPLES = 2_000
SHARE = 0.95  # of the resamples that an interval holds
MAX_BYTES = 2**20
RANDOM = "random"


def iqm(values: Any) -> NDArray[np.float64]:
    """The mean of the middle half along the last axis: a quarter of them, rounded down, is left out at each end."""
    ordered = np.sort(np.asarray(values, np.float64), axis=-1)
    cut = ordered.shape[-1] // 4
    middle: NDArray[np.float64] = ordered[..., cut : ordered.shape[-1] - cut].mean(axis=-1)
    return middle


def interval(scores: NDArray[np.float64]) -> tuple[float, float]:
    """Where the interquartile mean of scores (RESAMPLES, runs) lies, levels drawn again: here runs are, too."""
    runs = np.random.default_rng(0).integers(scores.shape[1], size=scores.shape)
    low, high = np.quantile(iqm(np.take_along_axis(scores, runs, 1)), [(1 - SHARE) / 2, (1 + SHARE) / 2])
    return float(low), float(high)


def load_results(folder: Path) -> dict[tuple[str, str], list[dict[str, Any]]]:
    """The runs of each agent, by track and name. Raises FileError for a file that is none, or where there are none."""
    found = defaultdict(list)
    for path in sorted(folder.glob("*.json")):
        try:
            run = json.loads(read_bytes(path, MAX_BYTES))
            of_format, other = run["format"] == FORMAT, None
            if of_format:
                for levels, name in product(TASKS, ("passed", "par")):
                    rates([run], levels, name)
                digests = {levels: str(run["digests"][levels]) for levels in TASKS}
                other = next((levels for levels in (TEST, TRAIN) if digests[levels] != DIGESTS[levels]), None)
                found[str(run["track"]), str(run["agent"])].append(run)
        except (KeyError, TypeError, ValueError) as error:
            raise FileError("not results of examples/measure.py", file=str(path), found=str(error)[:80]) from error
        if not of_format:
            format_ = str(run["format"])[:9]
            raise FileError("results of another format", file=str(path), found=format_, expected=str(FORMAT))
        if other:
            there, expected = digests[other][:12], DIGESTS[other]
            raise FileError(f"measured in other levels: {other}", str(path), found=there, expected=expected)
    if not found:
        raise FileError("there are no results", file=str(folder), expected="files *.json of examples/measure.py")
    return dict(found)


def rates(runs: list[dict[str, Any]], levels: str, name: str) -> NDArray[np.float64]:
    """A score of each run in each grade of levels, (runs, grades)."""
    grades = ("all",) if levels == TRANSFER else BENCH_GRADES
    return np.array([[run["scores"][levels][grade][name] for grade in grades] for run in runs], np.float64)


def redrawn(runs: list[dict[str, Any]], levels: str, name: str) -> NDArray[np.float64]:
    """As ``rates``, with the levels of each grade drawn again, the same for all runs: (RESAMPLES, runs, grades).

    Runs whose file lacks the results of single levels have the same score each time.
    """
    once = rates(runs, levels, name)
    if not all("levels" in run for run in runs):
        return np.broadcast_to(once, (RESAMPLES, *once.shape))
    rows = np.array([np.fromstring(run["levels"][levels][name], sep=" ") for run in runs])
    rows /= TASKS[levels] if name == "passed" else 100.0
    rng, grades = np.random.default_rng(1 + list(TASKS).index(levels)), once.shape[1]
    found = []
    for grade in range(grades):
        part = rows[:, grade::grades]
        weights = rng.multinomial(part.shape[1], np.full(part.shape[1], 1 / part.shape[1]), RESAMPLES)
        found.append(weights @ part.T / part.shape[1])
    return np.stack(found, -1)


def normalised(passed: NDArray[np.float64], chance: NDArray[np.float64]) -> NDArray[np.float64]:
    """Scores (…, grades) as means over grades: 0 is as often as by chance, 1 is always."""
    mean: NDArray[np.float64] = ((passed - chance) / (1.0 - chance)).mean(axis=-1)
    return mean


def learned_in(run: dict[str, Any]) -> list[int]:
    """The grades of `bench:train` that a run learned in; none where it learned nothing, or elsewhere."""
    words = str(run["training"].get("level", "")).split(":")
    if words[:2] != ["bench", "train"]:
        return []
    return [k for k, grade in enumerate(BENCH_GRADES) if grade in words] or [*range(len(BENCH_GRADES))]


def table(results: dict[tuple[str, str], list[dict[str, Any]]]) -> str:
    """Markdown, a row an agent: see docs/ninjabench.md."""
    random = [run for (_, name), runs in results.items() if name == RANDOM for run in runs]
    if not random:
        raise FileError("there are no runs of the agent 'random', which scores begin at", file="", expected=RANDOM)
    chance = rates(random, TEST, "passed").mean(axis=0)
    heads = ["track", "agent", "runs", "steps", *BENCH_GRADES, "normalised", "par time", "gap", "transfer"]
    lines = [heads, ["---"] * len(heads)]
    for (track, name), runs in sorted(results.items()):
        curve = runs[0]["training"].get("curve")
        count = f"{len(runs)}{'' if all('levels' in run for run in runs) else '*'}"
        passed, par = (rates(runs, TEST, name) for name in ("passed", "par"))
        passed_again, par_again = (redrawn(runs, TEST, name) for name in ("passed", "par"))
        cells = [shown(passed[:, grade], passed_again[..., grade]) for grade in range(len(BENCH_GRADES))]
        cells += [shown(normalised(passed, chance), normalised(passed_again, chance))]
        cells += [shown(par.mean(-1), par_again.mean(-1))]
        grades = learned_in(runs[0])
        gap, gap_again = (rates(runs, TRAIN, "passed") - passed, redrawn(runs, TRAIN, "passed") - passed_again)
        cells += [shown(gap[:, grades].mean(-1), gap_again[..., grades].mean(-1), "+.1f") if grades else "-"]
        same = [run for run in runs if run["digests"][TRANSFER] == DIGESTS[TRANSFER]]
        few = f" ({len(same)} of {len(runs)} runs)" * (len(same) < len(runs))
        cells += [
            shown(rates(same, TRANSFER, "passed")[:, 0], redrawn(same, TRANSFER, "passed")[..., 0]) + few
            if same
            else "-"
        ]
        lines.append([track, name, count, f"{curve[-1][0] / 1e6:.1f}M" if curve else "-", *cells])
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def shown(scores: NDArray[np.float64], again: NDArray[np.float64], form: str = ".1f") -> str:
    """The interquartile mean of scores (runs) in percent, and its interval by ``again`` (RESAMPLES, runs), if any."""
    middle = f"{100 * float(iqm(scores)):{form}}"
    low, high = interval(again)
    return middle if low == high and len(scores) < 2 else f"{middle} [{100 * low:{form}}, {100 * high:{form}}]"


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
