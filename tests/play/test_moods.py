"""In every mood, for every kind of sight, what matters stands out from the scenery, lit or not."""

from dataclasses import replace
from functools import cache

import numpy as np
import pygame
import pytest
from numpy.typing import NDArray

from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.levels.episodes import Entry
from ninja_game.play.app import App
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menu_screen import Panel
from ninja_game.play.panels.help import HelpScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.play.thumbnails import Thumbnails
from ninja_game.player.playthrough import LevelPlaythrough
from ninja_game.player.settings import BY_COLUMN
from ninja_game.sim import kinds
from ninja_game.ui.scenery import grain, ground, scenery_sheet
from ninja_game.ui.theme import MOODS, PALETTES, Palette, palette_named
from ninja_game.view.sprites import moving_sprites as moving, static_sprites as static
from ninja_game.view.sprites.drawing import SpriteBook, SpriteKey
from ninja_game.view.sprites.light import EXIT_OPEN, STYLES, LightStyle, light_picture

Colours = NDArray[np.float64]

SIGHTS = {
    "normal": (1, 0, 0, 0, 1, 0, 0, 0, 1),
    "protan": (0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998),
    "deutan": (0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881),
    "tritan": (1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900),
}
"""Machado, Oliveira, Fernandes 2009: the matrix to what is seen of linear RGB, at severity 1.0."""

MIN_DIFFERENCE = 18.0  # difference in CIE Lab from which on two colours are told apart at a glance
MIN_SHARE = 0.3  # how much of a drawing has to stand out; the rest is shading and highlights

THINGS: dict[str, tuple[SpriteKey, LightStyle | None]] = {
    "mine": (static.mine(), STYLES[kinds.MINE]), "turret": (static.turret_base(0), STYLES[kinds.TURRET]),
    "launcher": (static.launcher_base(0), STYLES[kinds.LAUNCHER]), "drone": (moving.drone(0, 0, 0, 0), None),
    "thwump": (moving.thwump(0, 0), None), "floor guard": (moving.floor_guard(0, 0), None),
    "rocket": (moving.rocket(1), None), "block": (moving.bounce_block(1), None), "pad": (static.launch_pad(0), None),
    "one-way": (static.one_way(), None), "exit": (static.exit_door(0), STYLES[kinds.EXIT]),
    "open exit": (static.exit_door(8), EXIT_OPEN), "switch": (static.exit_switch(0), STYLES[kinds.SWITCH]),
    "door": (static.door(1, 0), None), "trap": (static.door_switch(2, 0), None),
    "lock": (static.door_switch(1, 0), None), "gold": (static.gold(), None),
}  # fmt: skip
"""What kills, carries or opens, with the light around it."""

LINES = ("ninja", "ghost", "laser", "electric")  # roles of what is drawn as thin lines, or all in one colour

GROUNDS = [each for each in PALETTES.values() if each.scenery]
GROUNDS += [palette_named(BY_COLUMN, column, level) for column in range(5) for level in range(1, 5)]
moods = pytest.mark.parametrize("palette", GROUNDS, ids=lambda palette: palette.name)


def seen(colours: Colours, sight: str) -> Colours:
    """Colours of 0…255 as CIE Lab, as somebody with that sight has them."""
    c = colours / 255
    linear = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    linear = np.clip(linear @ np.reshape(SIGHTS[sight], (3, 3)).T, 0, 1)
    xyz = linear @ np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]).T
    t = xyz / np.array([0.9505, 1.0, 1.089])
    f = np.where(t > 0.008856, np.cbrt(t), 7.787 * t + 16 / 116)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], axis=1)


def differences(a: Colours, b: Colours, sight: str) -> Colours:
    """Of each colour to each other one."""
    return np.asarray(np.linalg.norm(seen(a, sight)[:, None] - seen(b, sight)[None], axis=2))


def rgba(surface: pygame.Surface) -> Colours:
    data = np.frombuffer(pygame.image.tobytes(surface, "RGBA"), np.uint8)
    return data.reshape(-1, 4).astype(np.float64)


@cache
def plain_ground(palette: Palette) -> Colours:
    """The colours of a mood's ground without light."""
    return np.unique(rgba(ground((66, 50), palette))[:, :3] // 6 * 6 + 3, axis=0)


def lit(colours: Colours, palette: Palette, look: LightStyle, share: float = 1.0) -> Colours:
    """Those colours in the middle of a light, or with some share of it."""
    glow = light_picture(look, 1.0, palette)
    *colour, alpha = glow.get_at(glow.get_rect().center)
    return np.asarray(colours + (np.array(colour) - colours) * share * alpha / 255)


@cache
def grounds(palette: Palette, own: LightStyle | None = None) -> Colours:
    """What may lie around a thing with that light: the ground, in its light, and half way out in that of others."""
    plain = plain_ground(palette)
    lights = [lit(plain, palette, look, 0.5) for look in (*STYLES.values(), EXIT_OPEN)]
    own_light = [lit(plain, palette, own)] if own else []
    return np.unique(np.concatenate([plain, *lights, *own_light]), axis=0)


@moods
def test_things_stand_out_from_the_scenery(palette: Palette) -> None:
    unseen = []
    for thing, (key, look) in THINGS.items():
        drawn = rgba(SpriteBook(2.0, palette).sprite(key).surface)
        solid, times = np.unique(drawn[drawn[:, 3] > 250][:, :3], axis=0, return_counts=True)
        for sight in SIGHTS:
            share_seen = times @ (differences(solid, grounds(palette, look), sight) >= MIN_DIFFERENCE) / times.sum()
            unseen += [(thing, sight, share_seen.min())] * bool(share_seen.min() < MIN_SHARE)
    assert unseen == []


@moods
def test_lines_stand_out_from_the_scenery(palette: Palette) -> None:
    colours = {role: np.array([getattr(palette, role)[:3]], np.float64) for role in LINES}
    least = {
        (role, sight): differences(colour, grounds(palette), sight).min()
        for role, colour in colours.items()
        for sight in SIGHTS
    }
    assert {case: value for case, value in least.items() if value < MIN_DIFFERENCE} == {}


@moods
@pytest.mark.parametrize("sight", SIGHTS)
def test_the_arrow_of_an_open_exit_stands_out_from_its_doorway(palette: Palette, sight: str) -> None:
    arrow, doorway = (np.array([getattr(palette, role)[:3]], np.float64) for role in ("exit", "exit_light"))
    assert differences(arrow, doorway, sight).min() >= MIN_DIFFERENCE


@moods
@pytest.mark.parametrize("sight", SIGHTS)
def test_tiles_are_never_taken_for_scenery(palette: Palette, sight: str) -> None:
    """The tiles' lightness is far from the scenery's, wherever that is; the scenery's own is nearly one."""
    tile = seen(np.array([palette.tile[:3]], np.float64), sight)[0, 0]
    lightness = seen(plain_ground(palette), sight)[:, 0]
    assert abs(lightness - tile).min() >= 16
    assert np.ptp(lightness) <= 1.25 * abs(lightness - tile).min()


@moods
def test_text_can_be_read_on_the_scenery(palette: Palette) -> None:
    """WCAG's contrast ratio: 4.5 for text, 3 for secondary text."""
    for role, least in (("text", 6.0), ("faint", 3.0)):
        colours = np.concatenate([np.array([getattr(palette, role)[:3]], np.float64), plain_ground(palette)])
        light = (seen(colours, "normal")[:, 0] + 16) / 116
        luminance = light**3 + 0.05
        assert (np.maximum(luminance[1:], luminance[0]) / np.minimum(luminance[1:], luminance[0])).min() >= least


def in_column(app: App, column: int) -> LevelScreen:
    """A level of a column, as it is played."""
    named = app.player.catalogue.ours.levels[0].named
    return LevelScreen(app, LevelPlaythrough(app.player, Entry(named, "game", f"{10 * column:02d}-0")))


def test_the_picture_follows_the_column_of_what_is_shown(app: App) -> None:
    menu = MainMenu(app)
    app.push(menu)
    app.frame(0)
    assert app.theme.palette is app.palette_in(menu.attract.mood), "that of the level behind it"
    assert menu.theme.palette is MOODS[0]
    app.push(in_column(app, 3))
    app.frame(0)
    assert app.theme.palette is MOODS[3]
    panel = Panel(app, "Paused")
    assert (panel.mood, panel.theme.palette) == (app.mood, MOODS[0]), "a menu over a level"
    app.push(HelpScreen(app))
    app.frame(0)
    assert app.theme.palette is MOODS[0], "all menus look alike"
    app.pop()
    app.pop()
    app.frame(0)
    assert app.theme.palette is app.palette_in(menu.attract.mood)


def test_a_run_of_an_episode_is_watched_in_its_mood(app: App, recording: Recording) -> None:
    app.push(in_column(app, 3))
    app.frame(0)
    app.push(ReplayScreen(app, [recording]))
    app.frame(0)
    assert app.theme.palette is MOODS[0]
    level = replace(recording.level, objects=recording.level.objects[:-1])
    app.pop()
    app.frame(0)
    app.push(ReplayScreen(app, [Recording(level, Replay.of_inputs(recording.inputs, level, name="other"))]))
    app.frame(0)
    assert app.theme.palette is MOODS[3]


def test_each_level_of_an_episode_has_its_tone_and_what_stands_on_it_looks_the_same(app: App) -> None:
    tones = [palette_named(BY_COLUMN, 0, level) for level in range(5)]
    assert len({tuple(tone.tile) for tone in tones}) == len({tuple(tone.background) for tone in tones}) == 5
    assert {tone.base for tone in tones} == {MOODS[0]}
    following = palette_named(BY_COLUMN, 0, 5)
    assert {tuple(following.tile), tuple(tones[2].tile)} == {tuple(following.tile)}, "the next episode begins elsewhere"
    assert len({pygame.image.tobytes(scenery_sheet(tone), "RGB") for tone in (*tones, following)}) == 6
    assert len({pygame.image.tobytes(grain(tone, "outline"), "RGBA") for tone in (*tones, following)}) == 6
    named = app.player.catalogue.ours.levels[0].named
    app.push(LevelScreen(app, LevelPlaythrough(app.player, Entry(named, "game", "00-2"))))
    app.frame(0)
    assert app.theme.palette is tones[2]


def test_a_level_is_laid_out_once_in_its_mood(app: App) -> None:
    app.push(MainMenu(app))
    app.frame(0)
    screen = in_column(app, 4)
    backdrop = screen.play.view.backdrop
    app.push(screen)
    app.frame(0)
    assert screen.play.view.backdrop is backdrop
    assert backdrop.palette is MOODS[4]


def test_a_chosen_palette_is_the_same_in_every_column(app: App) -> None:
    app.change_settings(palette="dark")
    for column in (0, 2):
        app.push(in_column(app, column))
        app.frame(0)
        assert app.theme.palette is PALETTES["dark"]


def test_thumbnails_have_the_mood_of_their_level(app: App, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.play.thumbnails.perf_counter", lambda: 9.0)
    thumbnails = Thumbnails(app)
    named = app.player.catalogue.ours.levels[0].named
    entries = [Entry(named, "game", f"{10 * column:02d}-0") for column in range(5)]
    for entry in entries:
        thumbnails.get(entry, 60)
    assert thumbnails.work()
    pictures = [thumbnails.get(entry, 60) for entry in entries]
    assert len({pygame.image.tobytes(picture, "RGB") for picture in pictures if picture}) == 5


def test_each_mood_has_a_ground_of_its_own_painted_once() -> None:
    for palette in MOODS:
        assert ground((132, 100), palette) is ground((132, 100), palette)
    assert len({pygame.image.tobytes(ground((66, 50), palette), "RGB") for palette in MOODS}) == len(MOODS)
