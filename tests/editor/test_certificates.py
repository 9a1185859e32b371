"""What the editor keeps of the solver's runs, without a window."""

from pathlib import Path

from ninja_game.editor.certificates import CertificateKeeper
from ninja_game.editor.files import Source, save
from ninja_game.editor.solver import search_of
from ninja_game.search.certificate import verified_run
from ninja_game.sim.inputs import with_press_bits
from tests.support.level_maker import ROOM


def test_runs_are_written_once_beside_the_file_with_their_level(tmp_path: Path) -> None:
    path, kept = (tmp_path / "levels" / name for name in ("room.txt", "certificates/room.exit.replay.txt"))
    path.parent.mkdir()
    save(Source(ROOM), ROOM, path)
    search = search_of(ROOM.level, verified_run(ROOM.level, with_press_bits(bytes([2]) * 100)))
    notices: list[str] = []
    keeper = CertificateKeeper(tmp_path, notices.append)
    keeper.keep(path, search)
    assert kept.exists()
    kept.unlink()
    keeper.keep(path, search)
    assert not kept.exists(), "these runs were written already"
    again = CertificateKeeper(tmp_path, notices.append)
    again.keep(path, search)
    assert (kept.exists(), notices) == (True, [])
    path.unlink()
    again.keeping(path, "Room")(search)
    assert notices == ["Room: no certificate, as no file has the level any more. Open it, and press F7"]
    assert again.text(path, is_saved=False) == "Kept when the level is saved"
    assert again.text(tmp_path / "room.txt", is_saved=True) == "To keep it: File, Save the run that was found"
