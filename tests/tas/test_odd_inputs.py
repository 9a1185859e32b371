"""Mutated inputs on the bench: only errors of ours (`tools/soak/input_texts.py` reads 100,000 of them)."""

from __future__ import annotations

from tools.soak.input_texts import soak


def test_odd_inputs_are_read_or_refused() -> None:
    trial = soak(600, 1, lambda _: None)
    assert not trial.wrong
    for name in ("written.replay.txt", "a.tas", "a.libtas.txt", "branches", "journal", "pasted"):
        assert trial.outcomes[f"{name}: read"], name
