"""Agents by name: "random", "search", "learned" (the one that comes with the game), or a file of a learned one."""

from __future__ import annotations

from pathlib import Path

from ninja_game.errors import ArgumentError
from ninja_game.files.resources import data_folder
from ninja_game.learn.agents.policy import PolicyAgent, load_policy
from ninja_game.learn.agents.random_agent import RandomAgent
from ninja_game.learn.agents.search import SearchAgent

LEARNED = "learned"


def learned_file() -> Path:
    """The file of the agent that comes with the game."""
    return data_folder("assets") / "learn" / "agent.npz"


def load_agent(name: str | Path) -> RandomAgent | SearchAgent | PolicyAgent:
    """The agent of that name or in that file.

    Raises ArgumentError for what is neither, FileError for a file that holds none, OSError as it comes.
    """
    if name == "random":
        return RandomAgent()
    if name == "search":
        return SearchAgent()
    if name == LEARNED:
        return load_policy(learned_file())
    path = Path(name)
    if not path.suffix and not path.exists():
        raise ArgumentError(
            f"there is no agent {str(name)!r:.100}; expected random, search, {LEARNED} or a file (.npz)"
        )
    return load_policy(path)
