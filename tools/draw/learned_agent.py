"""Draw the learned agent: how it learned, and a film of it playing: `python3 tools/dev.py tool draw.learned_agent`."""

from __future__ import annotations

import os

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")

from collections.abc import Iterator, Sequence
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pygame

from examples.agents import LEARNED, PolicyAgent, load_policy
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.evaluation import EVALUATION_SEED
from ninja_game.learn.levels import level_source
from ninja_game.learn.sticky import StickyActions
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.play.replay.film import Film, film_pictures, write_gif
from ninja_game.play.ui.theme import palette_named
from ninja_game.player.settings import Settings
from ninja_game.sim.inputs import with_press_bits
from tools import ROOT

FOLDER = ROOT / "docs" / "pictures" / "learn"
FILMED = 3
"""Levels in the film: the longest of those that it nearly always passes."""
SIZE = (396, 300)


def draw_curve(training: dict[str, Any], path: Path) -> None:
    """The share of episodes that passed, level by level, over the steps of the training."""
    import matplotlib as mpl

    mpl.use("Agg")
    mpl.rcParams.update({"svg.hashsalt": "ninja-game", "svg.fonttype": "none"})
    import matplotlib.pyplot as plt

    curve = np.array(training["curve"])
    figure, axis = plt.subplots(figsize=(9, 4.5), layout="constrained")
    for number, name in enumerate(training["levels"]):
        axis.plot(curve[:, 0] / 1e6, curve[:, 2 + number], lw=1, label=name)
    axis.plot(curve[:, 0] / 1e6, curve[:, 2:].mean(axis=1), "k", lw=2, label="mean")
    axis.set(xlabel="million steps of 4 ticks, all worlds together", ylabel="episodes passed", ylim=(0, 1.02))
    axis.set_title(f"Seed {training['seed']}, {curve[-1, 1]:,.0f} s of processor time", fontsize=10)
    axis.grid(alpha=0.3)
    figure.legend(loc="outside right upper", fontsize=7)
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def played(agent: PolicyAgent, name: str, seed: int) -> Recording:
    """An episode of the agent, with sticky actions, as it is evaluated."""
    worlds = EnvWorlds(name, 1, **agent.settings)
    sticky = StickyActions(1, seed)
    keys: list[int] = []
    while not worlds.terminated[0] and not worlds.truncated[0]:
        down = DISCRETE_KEYS[sticky.played(agent.act(np.asarray(worlds.observations)))]
        before = worlds.ticks[0]
        worlds.step(down)
        keys += down.tolist() * int(worlds.ticks[0] - before)
    level = worlds.levels[0]
    return Recording(level, Replay.of_inputs(with_press_bits(keys), level, name=f"{name} - learned agent"))


def draw_film(agent: PolicyAgent, names: Sequence[str], path: Path) -> None:
    """Episodes of several levels, one after the other."""
    films = [Film(played(agent, name, EVALUATION_SEED), SIZE) for name in names]
    pictures: Iterator[pygame.Surface] = chain.from_iterable(map(film_pictures, films))
    write_gif(pictures, sum(len(film.moments) for film in films), path, SIZE, 1.0, palette_named(Settings().palette))


if __name__ == "__main__":
    agent = load_policy(LEARNED)
    FOLDER.mkdir(parents=True, exist_ok=True)
    draw_curve(agent.training, FOLDER / "curve.svg")
    rates = dict(zip(agent.training["levels"], agent.training["curve"][-1][2:], strict=True))
    often = [name for name, rate in rates.items() if rate >= 0.95]
    size = {name: len(level_source(name).levels[0].objects) for name in often}
    draw_film(agent, sorted(often, key=lambda name: size[name])[-FILMED:], FOLDER / "agent.gif")
    for file in sorted(FOLDER.iterdir()):
        print(f"{file.relative_to(ROOT)}: {file.stat().st_size / 1000:.0f} kB")
