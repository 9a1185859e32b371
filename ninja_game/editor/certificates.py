"""The runs that certify a level under edit, kept beside its file."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path

from ninja_game.editor.solver import Certification
from ninja_game.errors import NinjaGameError, reason
from ninja_game.files.user_folder import LEVELS
from ninja_game.formats.load import load_levels
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.pack import is_pack
from ninja_game.formats.replay.text import Replay
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import GAME, Entry
from ninja_game.player.catalogue import Catalogue
from ninja_game.sim.level import Level


class CertificateKeeper:
    """Keeps the certificates of one level under edit. ``folder``: the player's; ``notify`` is called by any thread."""

    def __init__(self, folder: Path, notify: Callable[[str], object]) -> None:
        self._levels = folder / LEVELS
        self._notify = notify
        self._kept: tuple[object, ...] = ()  # the runs written last, and the path of the level

    def known_run(self, catalogue: Catalogue, level: Level, own: Entry | None) -> Replay | None:
        """The run of a certificate of this level: beside its ``own`` file, or of the same level elsewhere."""
        same = [own] if own else []
        same += [item for item in catalogue.single_levels() if item.named.level == level]
        for item in same:
            run = catalogue.author_run(item)
            if run:
                if item is own:
                    self._kept = run, run if run.gold >= level.gold else None, Path(own.named.file)
                return run
        return None

    def keeps_beside(self, path: Path) -> bool:
        """Whether certificates are kept beside a file: in the player's folder of levels, and in packs."""
        return path.parent == self._levels or is_pack(path.parent)

    def text(self, path: Path | None, *, is_saved: bool) -> str:
        """What happens to the run that the solver has found, a sentence."""
        if path and not self.keeps_beside(path):
            return "To keep it: File, Save the run that was found"
        return "Kept with the level" if path and is_saved else "Kept when the level is saved"

    def keep(self, path: Path, search: Certification) -> None:
        """Write the runs of a search beside the file with its level, unless they are those written last."""
        known = search.run, search.gold_run, path
        if known != self._kept:
            self._kept = known
            self._write(path, search)

    def keeping(self, path: Path, name: str) -> Callable[[Certification], None]:
        """What keeps the runs of a search that goes on after its level is closed; a notice calls that by ``name``."""
        return partial(self._write, path, name=name)

    def _write(self, path: Path, search: Certification, *, name: str = "") -> None:
        from ninja_game.search.certificate import update_certificates

        which = f"{name}: " if name else ""
        try:
            named = self._file_now(path, search)
            if named is None and search.run:
                self._notify(f"{which}no certificate, as no file has the level any more. Open it, and press F7")
                return
            for run in filter(None, (search.run, search.gold_run)):
                if named and self.keeps_beside(Path(named.file)):
                    update_certificates(named, run)
        except (NinjaGameError, OSError) as error:
            self._notify(f"{which}no certificate: {reason(error)}")
            return
        if name:
            end = f"no run in {search.seconds:.0f} s"
            if search.run:
                end = f"certified, {seconds_text(search.run.end_tick)} s, kept with the level"
            self._notify(f"{name}: {end}")

    def _file_now(self, path: Path, search: Certification) -> NamedLevel | None:
        """The level of a search in its file, or in another of the player's files, as in a pack; None if it is gone."""
        with suppress(NinjaGameError, OSError):
            named = load_levels(path)[0]
            if named.level == search.level:
                return named
        # The window's catalogue is not thread-safe.
        own = (item.named for item in Catalogue(self._levels).single_levels() if item.source != GAME)
        return next((entry for entry in own if entry.level == search.level and Path(entry.file).is_file()), None)
