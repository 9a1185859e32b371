"""Actions: the keys of the game that are down during a step."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium.error import InvalidAction
from gymnasium.spaces import Discrete, MultiBinary, Space

from ninja_game.batch.batch import Keys
from ninja_game.errors import ArgumentError
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT

ACTION_NAMES = ("left", "none", "right", "left+jump", "jump", "right+jump")
"""The discrete actions, by number: 3 * jump + (0 left, 1 none, 2 right)."""

DISCRETE_KEYS = np.array([jump + side for jump in (0, JUMP_HELD) for side in (KEY_LEFT, 0, KEY_RIGHT)], np.uint8)
"""The keys of each discrete action, by number."""
BUTTON_KEYS = np.array([KEY_LEFT, KEY_RIGHT, JUMP_HELD], np.uint8)  # the key of each button: left, right, jump


class Actions:
    """One of the two action spaces. ``kind``: "discrete" (six numbers) or "buttons" (three keys, each up or down).

    >>> actions = Actions("discrete")
    >>> actions.space, actions.keys([0, 5], 2).tolist()
    (Discrete(6), [1, 6])
    >>> Actions("buttons").keys([[0, 1, 1]], 1).tolist()
    [6]

    Raises ArgumentError for another kind.
    """

    def __init__(self, kind: str) -> None:
        if kind not in {"discrete", "buttons"}:
            raise ArgumentError(f"actions are {kind!r}; expected 'discrete' or 'buttons'")
        self.kind = kind
        self.space: Space[Any] = Discrete(len(DISCRETE_KEYS)) if kind == "discrete" else MultiBinary(len(BUTTON_KEYS))
        self._choices = len(DISCRETE_KEYS) if kind == "discrete" else 2
        self._kinds = "iu" if kind == "discrete" else "iub"
        self._shape: tuple[int, ...] = self.space.shape or ()

    def key(self, action: Any) -> Keys:
        """The keys of one world, uint8 (1,): like ``keys``, but ten times as fast for a number."""
        number = int(action) if isinstance(action, np.integer) else action
        if self.kind == "discrete" and type(number) is int and 0 <= number < self._choices:
            return DISCRETE_KEYS[number : number + 1]
        return self.keys([action], 1)

    def keys(self, actions: Any, count: int) -> Keys:
        """The keys of ``count`` worlds, uint8 (count,). Raises InvalidAction for invalid actions."""
        try:
            actions_array = np.asarray(actions)
        except ValueError:
            actions_array = np.asarray(actions, object)
        if actions_array.shape != (count, *self._shape) or actions_array.dtype.kind not in self._kinds:
            found = f"{actions_array.dtype} of shape {actions_array.shape}"
            raise InvalidAction(f"actions are {found}; expected whole numbers of shape {(count, *self._shape)}")
        if not 0 <= actions_array.min() <= actions_array.max() < self._choices:
            raise InvalidAction(f"found the actions {actions_array.tolist()!s:.60}; expected 0 to {self._choices - 1}")
        if self.kind == "discrete":
            keys: Keys = DISCRETE_KEYS[actions_array]
        else:
            keys = actions_array.astype(np.uint8) @ BUTTON_KEYS
        return keys
