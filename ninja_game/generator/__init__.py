"""Composes levels by rules, and keeps those that the solver can pass."""
