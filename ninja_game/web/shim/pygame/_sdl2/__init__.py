"""Gamepads as pygame-ce names them."""

from .controller import Controller, init, is_controller

__all__ = ["Controller", "init", "is_controller"]
