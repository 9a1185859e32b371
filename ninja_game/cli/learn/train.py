"""`ninja-game learn train`: teach an agent some levels."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ninja_game.cli import solver_options as options
from ninja_game.files.shown_text import shown_text

if TYPE_CHECKING:
    from ninja_game.learn.agents.training import Progress

LEVELS = (
    "00-0-first-steps", "00-1-mind-the-gap", "00-2-rolling-hills", "00-4-seven-league-boots", "01-1-the-chimney",
    "10-2-fountain", "10-4-the-juggler", "11-2-kennel", "12-1-four-winds", "20-0-kite", "20-1-phases-of-the-moon",
    "31-1-downhill",
)  # fmt: skip
"""Those of the agent that comes with the game: easy ones of several columns."""


@click.command(name="train")
@click.option(
    "--levels", metavar="LEVELS", multiple=True, default=LEVELS, show_default="twelve easy ones",
    help="train, set, a level of the game, a file or folder, generated:3:1-8. May be given several times.",
)  # fmt: skip
@options.seconds_option(600.0)
@click.option(
    "--steps", type=click.IntRange(0, 10**12), default=0, metavar="N",
    help="Stop after N steps of all worlds together instead: with the same seed always the same agent.",
)  # fmt: skip
@click.option(
    "--seed", type=click.IntRange(0, 999_999), default=0, show_default=True, help="Seed of all random choices."
)
@click.option(
    "--worlds",
    type=click.IntRange(1, 10**5),
    default=1024,
    show_default=True,
    help="Number of worlds that play in parallel.",
)
@click.option(
    "--out", "-o", "output", metavar="FILE", type=click.Path(dir_okay=False, path_type=Path),
    help="Where to keep the best agent so far. [default: agent.npz, or agent-1.npz ..., in the current folder]",
)  # fmt: skip
def command(levels: Sequence[str], seconds: float, steps: int, seed: int, worlds: int, output: Path | None) -> None:
    """Teach an agent some levels, by proximal policy optimisation on many worlds at a time.

    The best agent so far is always in FILE, so that training may be stopped at any time (Ctrl-C). It needs the extra
    'train'. docs/learning.md says how the agent that comes with the game was trained.

    \b
    Examples:
      ninja-game learn train --seconds 300
      ninja-game learn train --levels train --seconds 1800 -o everything.npz
    """
    from ninja_game.files.writing import check_output
    from ninja_game.learn.agents.training import Task, train
    from ninja_game.learn.levels import level_source

    output = output or free_agent()
    check_output(output)
    source = level_source(list(levels))
    task = Task(source, seconds=seconds, steps=steps, seed=seed, worlds=worlds)
    click.echo(f"ninja-game: {len(source.names)} levels; first come runs through them, then the training", err=True)
    with options.progress_line() as shown:
        agent = train(
            task,
            report=lambda progress: shown.say(progress_text(progress)),
            on_better=lambda agent: agent.save(output),
        )
    best, _, *rates = agent.training["curve"][-1]
    click.echo(f"{output}: the best agent, after {best / 1e6:.1f}M steps")
    for name, rate in zip(source.names, rates, strict=True):
        click.echo(f"  {rate:4.0%}  {shown_text(name)}")


def free_agent() -> Path:
    """A path in the current folder that nothing has yet."""
    names = (f"agent{number}.npz" for number in ("", *(f"-{count}" for count in range(1, 10_000))))
    return next(path for path in map(Path, names) if not path.exists())


def progress_text(progress: Progress) -> str:
    """Steps, speed, and how often the levels are passed in a line."""
    speed = progress.steps / max(progress.seconds, 1e-9)
    often = f"{progress.passed} of {len(progress.rates)} levels nine times in ten"
    passed = f"{progress.rates.mean():.0%} of episodes passed, {often}"
    return f"{progress.steps / 1e6:.1f}M steps, {speed / 1e3:.0f}k/s: {passed}"
