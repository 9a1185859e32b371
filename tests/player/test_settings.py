"""Settings survive their file; a wrong file never keeps the game from starting."""

import os
from pathlib import Path
from unittest.mock import Mock

import pytest
from hypothesis import given, settings as hypothesis_settings, strategies as st

from ninja_game.player.player_data import PlayerData
from ninja_game.player.settings import GHOSTS, MAX_INPUTS, SPECS, Settings, read_settings, write_changes
from tools.draw import how_it_works

PRINTABLE = st.text(st.characters(exclude_categories=["Cs", "Cc", "Cf", "Zl", "Zp", "Zs", "Co", "Cn"]), max_size=30)
BINDINGS = st.dictionaries(PRINTABLE, st.lists(PRINTABLE, max_size=3).map(tuple), max_size=4)
VALUES: dict[str, st.SearchStrategy[object]] = {
    "palette": st.sampled_from(["classic", "dark", "safe-dark"]),
    "ninja_colour": st.sampled_from(["", "#000000", "#aB12Ff"]),
    "ghost": st.sampled_from(GHOSTS),
    "name": PRINTABLE,
    "site": st.sampled_from(["", "https://example.org/game/?a=b&c=%20"]),
    "keys": BINDINGS,
    "pad": BINDINGS,
}


def values_of(name: str) -> st.SearchStrategy[object]:
    """What a setting may be: what its spec says of a number or a flag, else an entry of the table."""
    low, high, _ = SPECS[name].span
    default = getattr(Settings(), name)
    if isinstance(default, bool):
        return st.booleans()
    if high:
        return st.floats(low, high) if isinstance(default, float) else st.integers(int(low), int(high))
    return VALUES[name]


SETTINGS = st.builds(Settings, **{name: values_of(name) for name in SPECS})


def test_every_default_fits_its_spec() -> None:
    assert all(spec.fits(getattr(Settings(), name)) for name, spec in SPECS.items())


@hypothesis_settings(max_examples=40)
@given(settings=SETTINGS, more=SETTINGS)
def test_settings_come_back_equal(settings: Settings, more: Settings, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.getbasetemp() / "settings.toml"
    path.unlink(missing_ok=True)
    write_changes(Settings(), settings, path)
    assert read_settings(path) == (settings, [])
    write_changes(settings, more, path)
    assert read_settings(path) == (more, [])


MINE = """# my settings
version = 1

[look]
ninja-colour = "#112233"  # like the sea
palette = "dark"     # easier at night

[keys]
# I have small hands
jump = ["z"]
duck = ["odd", 7]
"""


def test_comments_and_everything_not_changed_stay(tmp_path: Path) -> None:
    path = tmp_path / "settings.toml"
    path.write_text(MINE.replace('duck = ["odd", 7]\n', ""))
    settings, messages = read_settings(path)
    assert not messages
    assert (settings.ninja_colour, settings.palette, settings.keys) == ("#112233", "dark", {"jump": ("z",)})
    write_changes(settings, settings.changed(palette="safe", keys={"jump": ("x", "y")}), path)
    text = path.read_text()
    for line in ("# my settings", "# like the sea", 'palette = "safe"     # easier at night', "# I have small hands",
                 'jump = ["x", "y"]'):  # fmt: skip
        assert line in text


def test_a_wrong_binding_is_reported_and_another_setting_still_saved(tmp_path: Path) -> None:
    path = tmp_path / "settings.toml"
    path.write_text(MINE)
    settings, messages = read_settings(path)
    assert "settings.toml: keys is" in messages[0]
    write_changes(settings, settings.changed(ninja_colour="#445566"), path)
    assert read_settings(path)[0].ninja_colour == "#445566"


def test_page_of_the_settings_has_each_with_its_default() -> None:
    assert how_it_works.SETTINGS.read_text("utf-8") == how_it_works.settings_page()


def test_two_games_change_only_what_their_players_changed(tmp_path: Path) -> None:
    first, second = PlayerData(tmp_path), PlayerData(tmp_path)
    first.change_settings(first.settings.changed(volume=11, keys={"jump": ("x",), "left": ("a",)}))
    second.change_settings(second.settings.changed(palette="dark", keys={"right": ("d",)}))
    first.change_settings(first.settings.changed(show_keys=True, keys={"jump": ("x",)}))
    settings = PlayerData(tmp_path).settings
    assert (settings.volume, settings.palette, settings.show_keys) == (11, "dark", True)
    assert settings.keys == {"jump": ("x",), "right": ("d",)}


def test_settings_that_could_not_be_saved_are_saved_with_the_next_change(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    data = PlayerData(tmp_path)
    data.change_settings(data.settings.changed(name="me"))
    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", Mock(side_effect=OSError(28, "No space left on device")))
        expected = "The settings could not be saved (No space left on device)."
        assert data.change_settings(data.settings.changed(volume=11)) == expected
    assert not data.change_settings(data.settings.changed(loop_volume=12))
    assert PlayerData(tmp_path).settings == data.settings


@pytest.mark.parametrize(
    "line",
    [
        f"volume = {'9' * 5000}",
        f"volume = -{'9' * 5000}",
        "volume = 1e999",
        "volume = nan",
        "volume = [[[]]]",
        "volume = 1979-05-27",
        "volume = { a = 1 }",
        'volume = "\\u0000"',
    ],
)
def test_odd_value_falls_back_alone_with_a_word(tmp_path: Path, line: str) -> None:
    path = tmp_path / "settings.toml"
    path.write_text(f"[sound]\n{line}\nloop-volume = 3\n")
    settings, messages = read_settings(path)
    assert (settings.volume, settings.loop_volume) == (Settings().volume, 3)
    assert len(messages) == 1
    assert "sound.volume is" in messages[0]
    assert len(messages[0]) < 200
    write_changes(settings, settings.changed(loop_volume=4), path)
    assert line in path.read_text()
    write_changes(settings, settings.changed(volume=5), path)
    assert read_settings(path)[0].volume == 5


UNREADABLE = [b"a = " + b"[" * 5000, b"\xff\xfe", b"\xed\xa0\x80 = 1", b"a = 1\na = 2", b"[a]\n[a]", b"x" * 2**17,
              b"a.b = 1\na = 2"]  # fmt: skip
READABLE = [b"look = 3\nkeys = 4\nsound = [1]", b"[[look]]\n[[keys]]",
            b"[keys]\njump = [" + b"'a', " * (MAX_INPUTS + 1) + b"]", b"keys.jump = []",
            b"[look.palette]"]  # fmt: skip


def kept_aside(folder: Path) -> list[bytes]:
    return [each.read_bytes() for each in folder.glob("settings.damaged*")]


@pytest.mark.parametrize("text", UNREADABLE + READABLE)
def test_game_starts_with_any_text_and_settings_can_be_changed_then(tmp_path: Path, text: bytes) -> None:
    (tmp_path / "settings.toml").write_bytes(text)
    data = PlayerData(tmp_path)
    changed = data.settings.changed(volume=11, palette="dark", keys={"jump": ("x",)})
    assert not data.change_settings(changed)
    assert PlayerData(tmp_path).settings == changed
    assert kept_aside(tmp_path) == [text] * (text in UNREADABLE)


@pytest.mark.parametrize("text", UNREADABLE + READABLE)
def test_any_text_that_appears_while_the_game_runs_is_kept(tmp_path: Path, text: bytes) -> None:
    data, path = PlayerData(tmp_path), tmp_path / "settings.toml"
    path.write_bytes(text)
    assert not data.change_settings(data.settings.changed(volume=11))
    assert PlayerData(tmp_path).settings.volume == 11
    assert kept_aside(tmp_path) == [text] * (text in UNREADABLE)
    assert text in UNREADABLE or path.read_bytes().startswith(text.partition(b"sound")[0])


@pytest.mark.parametrize("start", [b"", MINE.encode()])
@hypothesis_settings(max_examples=60)
@given(text=st.binary(max_size=80) | st.text("[]{}=.,'\"#\n ax1-\ud800").map(lambda t: t.encode("utf-8", "replace")))
def test_any_text_can_be_read_and_changed(start: bytes, text: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("any") / "settings.toml"
    path.write_bytes(start + text)
    settings, _ = read_settings(path)
    write_changes(settings, settings.changed(volume=settings.volume ^ 1), path)
    assert read_settings(path)[0].volume == settings.volume ^ 1


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


@pytest.mark.parametrize("version", ["0", "2", "99", '"x"'])
def test_file_of_another_version_is_set_aside(tmp_path: Path, version: str) -> None:
    path = tmp_path / "settings.toml"
    path.write_text(f"version = {version}\n")
    assert "settings.other-1.toml" in read_settings(path)[1][0]
    assert (tmp_path / "settings.other-1.toml").is_file()


def test_wrong_value_falls_back_alone_and_is_named(tmp_path: Path) -> None:
    path = tmp_path / "settings.toml"
    path.write_text('version = 1\n[sound]\nvolume = "loud"\nloop-volume = 3\n[keys]\njump = "z"\n[look]\npalette = 7\n')
    settings, messages = read_settings(path)
    assert (settings.volume, settings.loop_volume, settings.palette) == (Settings().volume, 3, Settings().palette)
    assert len(messages) == 3
    assert "sound.volume is 'loud'" in " ".join(messages)


def test_changing_to_a_wrong_value_is_refused() -> None:
    with pytest.raises(ValueError, match="0 to 99"):
        Settings().changed(volume=100)
