"""A run that certifies the level: shown, stale after a change, kept with the level."""

from pathlib import Path
from unittest.mock import patch

import pygame
import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.editor import packs
from ninja_game.editor.files import open_source
from ninja_game.editor.solver import Certification
from ninja_game.formats.load import load_levels
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.replay.text import parse_replay
from ninja_game.runs.packs import lint
from ninja_game.search.certificate import verified_run
from ninja_game.search.task import Progress
from ninja_game.sim.inputs import with_press_bits
from tests.support.level_maker import ROOM, Maker
from tests.support.waiting import LONGEST


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_a_certificate_is_shown_and_gets_stale(room: Maker) -> None:
    certifier = room.editor.session.certifier
    certifier.seconds = LONGEST
    room.press("f7")
    # A machine that has never compiled the solver needs minutes.
    room.wait(lambda: certifier.text.startswith("Certified: 0.") or not certifier.is_busy, "run of the solver")
    certifier.stop()
    assert certifier.text.startswith("Certified: 0."), certifier.text
    assert certifier.certification.route[0] == (60.0, 542.0)
    assert not certifier.is_stale(room.draft.level)
    room.drag((300, 300))
    assert certifier.is_stale(room.draft.level)
    room.chord("z", pygame.KMOD_LCTRL)
    assert not certifier.is_stale(room.draft.level)
    room.choose_in_menu("Save the run that was found")
    assert room.player.records.replays()


def certified(room: Maker, late: int) -> None:
    """Have the solver found a run that begins this many ticks late."""
    session = room.editor.session
    inputs = with_press_bits(bytes(late) + bytes([2]) * 100)
    session.certifier.certification = Certification(
        session.draft.level, run=verified_run(session.draft.level, inputs), end="Done"
    )
    room.frames()


def test_a_certified_level_needs_no_other_certificate_in_a_pack(room: Maker, tmp_path: Path) -> None:
    session = room.editor.session
    certified(room, 3)
    levels = tmp_path / "levels"
    kept = levels / "certificates" / "room.exit.replay.txt"
    assert not kept.exists(), "the level has no file yet"
    room.chord("s", pygame.KMOD_LCTRL)
    room.frames()
    first = parse_replay(kept.read_text()).final_tick
    certified(room, 9)
    assert parse_replay(kept.read_text()).final_tick == first, "a longer one replaces nothing"
    certified(room, 0)
    assert parse_replay(kept.read_text()).final_tick == first - 3
    room.player.catalogue.own()
    assert room.player.catalogue.problems == []
    pack = packs.new_pack(levels, "Pack", "me")
    file = packs.transfer(load_levels(levels / "room.txt")[0], pack, keep=False)
    packs.place(pack, [file], 0)
    assert not [finding for finding in lint(Pack(pack)) if "certificate" in finding.code]
    session.begin(open_source(pack / file))
    room.drag((300, 300))
    before = (pack / "certificates" / "room.exit.replay.txt").read_text()
    certified(room, 0)
    assert (pack / "certificates" / "room.exit.replay.txt").read_text() == before, "what is not saved certifies nothing"


def test_a_run_found_while_another_version_was_saved_is_kept_once_its_level_is_saved(
    room: Maker, tmp_path: Path
) -> None:
    session, kept = room.editor.session, tmp_path / "levels" / "certificates" / "room.exit.replay.txt"
    searched = session.draft.level
    room.drag((300, 300))
    room.chord("s", pygame.KMOD_LCTRL)
    session.certifier.certification = Certification(
        searched, run=verified_run(searched, with_press_bits(bytes([2]) * 100)), end="Done"
    )
    before = room.app.notice
    room.frames()
    assert not kept.exists(), "the file has another level"
    assert room.app.notice == before, "the panel says that the run is of another version"
    room.chord("z", pygame.KMOD_LCTRL)
    assert session.keeping == "Kept when the level is saved"
    room.chord("s", pygame.KMOD_LCTRL)
    room.frames()
    assert session.keeping == "Kept with the level"
    assert kept.exists()


def test_what_a_search_has_found_is_kept_when_its_level_is_left(room: Maker, tmp_path: Path) -> None:
    session = room.editor.session
    certifier = session.certifier
    room.chord("s", pygame.KMOD_LCTRL)
    kept = tmp_path / "levels" / "certificates" / "room.exit.replay.txt"
    with patch.object(type(certifier.solver.job), "is_idle", False):
        certifier.certification = Certification(session.draft.level)
        certifier.certification.run = verified_run(session.draft.level, with_press_bits(bytes([2]) * 100))
        room.frames()
        assert certifier.text.endswith(", shortening")
        assert not kept.exists(), "a better one may come"
        room.choose_in_menu("New")
        room.choose("Empty")
    assert kept.exists()


def test_f7_after_a_change_looks_at_the_level_as_it_is(room: Maker) -> None:
    certifier = room.editor.session.certifier
    asked: list[Certification] = []
    with (
        patch.object(type(certifier.solver.job), "is_idle", False),
        patch.object(certifier.solver.job, "ask", asked.append),
        patch("ninja_game.editor.solver.compiled_available", lambda: True),
    ):
        room.press("f7")
        asked[0].progress = Progress()
        room.drag((300, 300))
        room.press("f7")
        assert [search.level for search in asked] == [ROOM.level, room.draft.level]
        assert (asked[0].end, asked[1].end) == ("Stopped", "")
        asked[1].progress = Progress()
        room.press("f7")
        assert asked[1].end == "Stopped"


def test_the_panel_says_what_becomes_of_the_run(room: Maker, tmp_path: Path) -> None:
    session = room.editor.session
    assert session.keeping == "Kept when the level is saved"
    room.chord("s", pygame.KMOD_LCTRL)
    assert session.keeping == "Kept with the level"
    session.save(tmp_path / "elsewhere.txt")
    assert session.keeping == "To keep it: File, Save the run that was found"
