"""What the program needs before its first screen: the player's data, and options, controls and sound made of it."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ninja_game.files.resources import data_folder
from ninja_game.play.audio.player import Sound
from ninja_game.play.input.bindings import Bindings
from ninja_game.play.options import Options
from ninja_game.player.player_data import PlayerData
from ninja_game.player.settings import Settings

if TYPE_CHECKING:
    from ninja_game.play.screen import Host

SOUNDS = "sounds"


class Prepared(NamedTuple):
    """What ``App`` is made of."""

    options: Options
    controls: Bindings
    audio_output: Sound
    player: PlayerData


def prepare(folder: Path | None = None) -> Prepared:
    """Everything as the player's settings have it. ``folder``: instead of the usual one."""
    player = PlayerData(folder)
    settings = player.settings
    options = Options()
    fill_options(options, settings)
    controls = Bindings(settings.keys, settings.pad, dead_zone=settings.dead_zone)
    sound = Sound(data_folder("assets") / SOUNDS, volume=settings.volume, loop_volume=settings.loop_volume)
    return Prepared(options, controls, sound, player)


def fill_options(options: Options, settings: Settings) -> None:
    """Bring the options about the picture to what the settings say; both name the same thing alike."""
    for field in fields(options):
        if hasattr(settings, field.name):
            setattr(options, field.name, getattr(settings, field.name))


def apply_settings(app: Host, settings: Settings) -> str:
    """Take, save and show changed settings; a message if they could not be saved, else ''."""
    player = app.player
    assert player is not None  # noqa: S101 - screens that change settings have it
    message = player.change_settings(settings)
    before = vars(app.options).copy()
    fill_options(app.options, settings)
    if isinstance(app.controls, Bindings):
        app.controls.bind(settings.keys, settings.pad)
        app.controls.pads.dead_zone = settings.dead_zone
    if isinstance(app.audio_output, Sound):
        app.audio_output.set_volumes(settings.volume, settings.loop_volume)
    if vars(app.options) != before:
        app.apply_options()
    return message
