"""Agents: one that plays at random, one that searches with save-states, one that has learned (docs/learning.md)."""

from __future__ import annotations

from ninja_game.learn.agents.load import load_agent

__all__ = ["load_agent"]
