"""Agents: one that plays at random, one that searches with save-states, one that has learned (docs/learning.md).

A learned agent is a small network from observations to the probabilities of the six actions, played by NumPy alone. Its
file is a NumPy archive (.npz) of the network's arrays and one text, JSON, that says what environment it was made for
and how it was trained; it is read without pickle.
"""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, ClassVar
from zipfile import BadZipFile

import click
import numpy as np
from numpy.typing import NDArray

from examples.search import SearchAgent
from ninja_game.backend.kernel_cache import before_compiling
from ninja_game.errors import ArgumentError, FileError
from ninja_game.files.writing import write_atomically
from ninja_game.learn.actions import ACTION_NAMES
from ninja_game.learn.observations.observation import PARTS, Observation

LEARNED = Path(__file__).parent / "agent.npz"  # the agent whose training docs/learning.md describes

KEPT = 0.8
"""Probability that the random agent keeps an action for a step: keys pressed again ten times a second lead nowhere."""

Floats = NDArray[np.float32]

FORMAT = 1  # of the file; a later one may differ
MAX_OBSERVED = 5.0  # observations beyond five standard deviations count as five


class RandomAgent:
    """Presses each of the six combinations of keys as often, for half a second on average."""

    settings: ClassVar[dict[str, Any]] = {}

    def __init__(self) -> None:
        self.reset(1, 0)

    def reset(self, count: int, seed: int) -> None:
        """Begin with ``count`` worlds."""
        self._rng = np.random.default_rng(seed)
        self._actions = self._rng.integers(len(ACTION_NAMES), size=count)

    def act(self, observations: Any) -> NDArray[np.int64]:  # noqa: ARG002 - as all agents
        """An action for each world, (n,), whatever is observed."""
        count = len(self._actions)
        drawn = self._rng.integers(len(ACTION_NAMES), size=count)
        self._actions = np.where(self._rng.random(count) < KEPT, self._actions, drawn)
        return self._actions


@dataclass(eq=False)
class PolicyAgent:
    """Plays actions by their probabilities, drawn by the seed of ``reset``.

    ``layers``: weights and biases (``forward``), on observations less ``mean`` times ``scale``. ``settings``: the
    keywords of the environment it was made for. ``training``: how it was made, by name.
    """

    layers: list[tuple[Floats, Floats]]
    mean: Floats
    scale: Floats
    settings: dict[str, Any]
    training: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.reset(1, 0)

    def reset(self, count: int, seed: int) -> None:  # noqa: ARG002 - as all agents
        """Begin: only what is drawn is remembered from step to step."""
        self._rng = np.random.default_rng(seed)

    def act(self, observations: Floats) -> NDArray[np.int64]:
        """An action of each world, (n,)."""
        scores = self.scores(observations)
        # The largest of sums with Gumbel noise is a draw by the probabilities.
        return np.asarray((scores + self._rng.gumbel(size=scores.shape)).argmax(axis=1), np.int64)

    def scores(self, observations: Floats) -> Floats:
        """A number for each action, (n, 6): the logarithm of its probability, up to a constant of the row."""
        return np.asarray(forward(self.layers, normalised(observations, self.mean, self.scale)), np.float32)

    def save(self, path: Path) -> None:
        """Write the file. Raises FileError or OSError where it cannot be written."""
        about = {"format": FORMAT, "settings": _written(self.settings), "training": self.training}
        arrays: dict[str, Any] = {"about": np.array(json.dumps(about)), "mean": self.mean, "scale": self.scale}
        for number, (weights, biases) in enumerate(self.layers):
            arrays |= {f"weights_{number}": weights, f"biases_{number}": biases}
        content = io.BytesIO()
        np.savez(content, **arrays)
        write_atomically(path, content.getvalue())


def load_agent(name: str | Path) -> RandomAgent | SearchAgent | PolicyAgent:
    """The agent "random", "search" or "learned" (the one beside this file), or that in a file.

    Raises ArgumentError for what is neither, FileError for a file without an agent, OSError as it comes.
    """
    if name == "random":
        return RandomAgent()
    if name == "search":
        return SearchAgent()
    path = LEARNED if name == "learned" else Path(name)
    if not path.suffix and not path.exists():
        raise ArgumentError(f"there is no agent {str(name)!r:.100}; expected random, search, learned or a file (.npz)")
    return load_policy(path)


def tell_compiling() -> None:
    """Say so before the first kernel that has to be compiled."""
    notice = "compiling the worlds for this machine, the first time only; it takes a minute or two"
    before_compiling.append(lambda: click.echo(notice, err=True))


def load_policy(path: Path) -> PolicyAgent:
    """The agent in a file. Raises FileError for a file without one, OSError as it comes."""
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as arrays:
            about = json.loads(str(arrays["about"]))
            if about["format"] != FORMAT:
                raise FileError("an agent of another format", file=str(path), found=str(about["format"]), expected="1")
            numbers = range(sum(name.startswith("weights_") for name in arrays))
            layers = [(arrays[f"weights_{number}"], arrays[f"biases_{number}"]) for number in numbers]
            agent = PolicyAgent(layers, arrays["mean"], arrays["scale"], _read(about["settings"]), about["training"])
        _check(agent)
    except (BadZipFile, EOFError, KeyError, TypeError, ValueError, AttributeError, ArgumentError) as error:
        raise FileError("not an agent that an example wrote", file=str(path), found=str(error)[:100]) from error
    return agent


def forward(layers: list[tuple[Any, Any]], values: Any, tanh: Callable[[Any], Any] = np.tanh) -> Any:
    """What a network says, (n, outputs): tanh after all layers but the last; by NumPy, or with JAX's ``tanh`` by JAX.

    Weights are (inputs x outputs), or of a picture (side, side, channels, features): for each of its squares the same.
    """
    for number, (weights, biases) in enumerate(layers):
        if weights.ndim == 4:
            side, _, channels, _ = weights.shape
            across = round((values.shape[1] / channels) ** 0.5) // side
            squares = values.reshape(-1, across, side, across, side, channels).transpose(0, 1, 3, 2, 4, 5)
            values = squares.reshape(-1, across * across, side * side * channels)
        values = values @ weights.reshape(-1, len(biases)) + biases
        if number < len(layers) - 1:
            values = tanh(values).reshape(len(values), -1)
    return values


def normalised(observations: Floats, mean: Floats, scale: Floats) -> Floats:
    """Observations as networks take them."""
    return np.asarray(np.clip((observations - mean) * scale, -MAX_OBSERVED, MAX_OBSERVED), np.float32)


def _check(agent: PolicyAgent) -> None:
    """Raise ValueError for arrays that do not fit the observation, one another, or the actions."""
    size = Observation(agent.settings["observation"], flat=True).space.shape
    if size != agent.mean.shape or size != agent.scale.shape:
        raise ValueError(f"it takes {agent.mean.shape} numbers; its observation has {size}")
    shape = forward(agent.layers, np.zeros((1, *size), np.float32)).shape
    if shape != (1, len(ACTION_NAMES)):
        raise ValueError(f"it ends in {shape} numbers; there are {len(ACTION_NAMES)} actions")


def _written(settings: dict[str, Any]) -> dict[str, Any]:
    """Settings as JSON has them: a part is its name with its parameters."""
    parts = [{"part": part.name, **asdict(part)} for part in settings["observation"]]
    return {**settings, "observation": parts}


def _read(settings: dict[str, Any]) -> dict[str, Any]:
    """The reverse."""
    parts = []
    for written in settings["observation"]:
        fields: dict[str, Any] = {}
        for name, value in written.items():
            fields[name] = tuple(value) if isinstance(value, list) else value
        parts.append(PARTS[fields.pop("part")](**fields))
    return {**settings, "observation": parts}
