"""Sticky actions: how often an action is played again, how long episodes wait, and that seeds decide."""

from __future__ import annotations

import numpy as np

from ninja_game.learn.sticky import NONE, StickyActions


def test_a_quarter_of_the_actions_is_the_one_before() -> None:
    sticky = StickyActions(1000, 1, longest_wait=0)
    sticky.played(np.full(1000, 5))
    kept = [(sticky.played(np.full(1000, action)) != action).mean() for action in (0, 1, 2, 3, 4)]
    assert 0.2 < np.mean(kept) < 0.3


def test_episodes_wait_from_0_to_7_steps_and_not_where_they_should_not() -> None:
    sticky = StickyActions(4000, 2, repeat=0.0)
    waits = sum((sticky.played(np.full(4000, 5)) == NONE).astype(int) for _ in range(10))
    assert set(waits) == set(range(8))
    sticky.begin(np.arange(10), wait=False)
    sticky.begin(np.arange(10, 4000))
    played = sticky.played(np.full(4000, 5))
    assert (played[:10] == 5).all()
    assert 0.8 < (played[10:] == NONE).mean() < 0.95


def test_the_seed_decides_and_a_new_episode_forgets_the_action_before() -> None:
    choices = np.random.default_rng(0).integers(6, size=(50, 20))
    first, second, other = (StickyActions(20, seed) for seed in (3, 3, 4))
    played = [first.played(row).tolist() for row in choices]
    assert played == [second.played(row).tolist() for row in choices]
    assert played != [other.played(row).tolist() for row in choices]
    first.begin(np.arange(20), wait=False)
    assert set(first.played(np.full(20, 5))) == {NONE, 5}
