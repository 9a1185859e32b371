"""Settings survive their file; a wrong file never keeps the game from starting."""

from __future__ import annotations

import tomllib
from dataclasses import fields
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from ninja_game.player.settings import PALETTES, RULES, Settings
from ninja_game.player.settings_file import read_settings, write_settings
from ninja_game.player.toml_text import write_toml

PRINTABLE = st.text(st.characters(exclude_categories=["Cs", "Cc", "Cf", "Zl", "Zp", "Zs", "Co", "Cn"]), max_size=30)
BINDINGS = st.dictionaries(PRINTABLE, st.lists(PRINTABLE, max_size=3).map(tuple), max_size=4)
VALUES = {
    "palette": st.sampled_from(PALETTES),
    "flavour": st.sampled_from(["", "#000000", "#aB12Ff"]),
    "frame_limit": st.integers(0, 1000),
    "volume": st.integers(0, 99),
    "loop_volume": st.integers(0, 99),
    "name": PRINTABLE,
    "dead_zone": st.floats(0.05, 0.95),
    "keys": BINDINGS,
    "pad": BINDINGS,
}
SETTINGS = st.builds(Settings, **{each.name: VALUES.get(each.name, st.booleans()) for each in fields(Settings)})


def test_every_setting_has_a_rule_that_its_default_fits() -> None:
    assert set(RULES) == {each.name for each in fields(Settings)}
    assert all(rule.fits(getattr(Settings(), name)) for name, rule in RULES.items())


@hypothesis_settings(max_examples=40)
@given(settings=SETTINGS)
def test_settings_come_back_equal(settings: Settings, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.getbasetemp() / "settings.toml"
    write_settings(settings, path)
    assert read_settings(path) == (settings, [])


@hypothesis_settings(max_examples=40)
@given(tables=st.dictionaries(st.text(), st.dictionaries(st.text(), st.text() | st.integers() | st.booleans())))
def test_any_table_is_written_as_valid_toml(tables: dict[str, dict[str, str | int | bool]]) -> None:
    whole = {
        _whole(name): {_whole(key): _whole(value) if isinstance(value, str) else value for key, value in table.items()}
        for name, table in tables.items()
    }
    nameless = whole.pop("", {})
    expected = {**{k: v for k, v in nameless.items() if k not in whole}, **whole}
    assert tomllib.loads(write_toml({"": {k: v for k, v in nameless.items() if k not in whole}, **whole})) == expected


def _whole(text: str) -> str:
    return text.encode("utf-8", "replace").decode()


def test_missing_file_gives_the_defaults(tmp_path: Path) -> None:
    assert read_settings(tmp_path / "none.toml") == (Settings(), [])


@pytest.mark.parametrize("text", ["this is [not toml", "\x00", "version = 1\n[look\n"])
def test_damaged_file_is_set_aside(tmp_path: Path, text: str) -> None:
    path = tmp_path / "settings.toml"
    path.write_text(text)
    settings, messages = read_settings(path)
    assert settings == Settings()
    assert "settings.damaged-1.toml" in messages[0]
    assert (tmp_path / "settings.damaged-1.toml").read_text() == text


@pytest.mark.parametrize("version", ["2", "99", '"x"'])
def test_newer_file_is_set_aside(tmp_path: Path, version: str) -> None:
    path = tmp_path / "settings.toml"
    path.write_text(f"version = {version}\n")
    assert "newer" in read_settings(path)[1][0]
    assert (tmp_path / "settings.newer-1.toml").is_file()


def test_wrong_value_falls_back_alone_and_is_named(tmp_path: Path) -> None:
    path = tmp_path / "settings.toml"
    path.write_text('version = 1\n[sound]\nvolume = "loud"\nloop-volume = 3\n[keys]\njump = "z"\n[look]\npalette = 7\n')
    settings, messages = read_settings(path)
    assert (settings.volume, settings.loop_volume, settings.palette) == (Settings().volume, 3, "classic")
    assert len(messages) == 3
    assert "sound.volume is 'loud'" in " ".join(messages)


def test_changing_to_a_wrong_value_is_refused() -> None:
    with pytest.raises(ValueError, match="0 to 99"):
        Settings().changed(volume=100)
