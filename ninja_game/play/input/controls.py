"""What keys mean: the interface that bindings fill, and a plain keyboard with the default keys."""

from __future__ import annotations

from typing import Protocol

import pygame

from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT


class Controls(Protocol):
    """Turns keys, buttons and sticks into actions."""

    def held(self) -> int:
        """What is held right now: 1 left + 2 right + 4 jump. Called just before a tick."""

    def actions(self, event: pygame.Event) -> tuple[str, ...]:
        """All the actions that an event presses: a key may mean one thing in play and another in a replay."""

    def releases(self, event: pygame.Event) -> tuple[str, ...]:
        """All the actions that an event releases."""

    def name(self, action: str) -> str:
        """What to press for an action, for messages."""


DEFAULT_KEYS: dict[str, tuple[int, ...]] = {
    "left": (pygame.K_LEFT, pygame.K_a),
    "right": (pygame.K_RIGHT, pygame.K_d),
    "jump": (pygame.K_LSHIFT, pygame.K_RSHIFT, pygame.K_z, pygame.K_UP, pygame.K_w),
    "confirm": (pygame.K_SPACE, pygame.K_RETURN),
    "back": (pygame.K_ESCAPE,),
    "pause": (pygame.K_p,),
    "retry": (pygame.K_r,),
    "suicide": (pygame.K_k,),
    "quit": (pygame.K_q,),
    "replay": (pygame.K_r, pygame.K_v),
    "fullscreen": (pygame.K_F11,),
    "screenshot": (pygame.K_F12,),
    "ghost": (pygame.K_g,),
    "quick_save": (pygame.K_F5,),
    "quick_load": (pygame.K_F9,),
    "rewind": (pygame.K_BACKSPACE,),
    "slow": (pygame.K_LCTRL,),
    "step": (pygame.K_PERIOD,),
    "overlay_hitboxes": (pygame.K_1,),
    "overlay_grid": (pygame.K_2,),
    "overlay_edges": (pygame.K_3,),
    "overlay_rays": (pygame.K_4,),
    "overlay_cells": (pygame.K_5,),
    "faster": (pygame.K_PLUS, pygame.K_EQUALS, pygame.K_KP_PLUS),
    "slower": (pygame.K_MINUS, pygame.K_KP_MINUS),
    "frame_back": (pygame.K_COMMA,),
    "frame_forward": (pygame.K_PERIOD,),
    "export": (pygame.K_e,),
}


class Keyboard:
    """The default keys, unchangeable. Used where no bindings are given."""

    def __init__(self) -> None:
        self._actions: dict[int, list[str]] = {}
        for action, keys in DEFAULT_KEYS.items():
            for key in keys:
                self._actions.setdefault(key, []).append(action)

    def held(self) -> int:
        """What is held right now."""
        pygame.event.pump()
        keys = pygame.key.get_pressed()
        bits = 0
        for bit, action in ((KEY_LEFT, "left"), (KEY_RIGHT, "right"), (JUMP_HELD, "jump")):
            if any(keys[key] for key in DEFAULT_KEYS[action]):
                bits |= bit
        return bits

    def actions(self, event: pygame.Event) -> tuple[str, ...]:
        """The actions that a key press means."""
        return tuple(self._actions.get(event.key, ())) if event.type == pygame.KEYDOWN else ()

    def releases(self, event: pygame.Event) -> tuple[str, ...]:
        """The actions that a released key meant."""
        return tuple(self._actions.get(event.key, ())) if event.type == pygame.KEYUP else ()

    def name(self, action: str) -> str:
        """The first key of an action."""
        return pygame.key.name(DEFAULT_KEYS[action][0]).capitalize() if action in DEFAULT_KEYS else action
