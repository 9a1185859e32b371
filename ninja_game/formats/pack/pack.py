"""A pack as a whole: index, levels, episodes, certificates."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path

from ninja_game.errors import NinjaGameError, PackError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel, parse_levels
from ninja_game.formats.pack.files import INDEX, PARS, PackFiles, certificate_name, is_pack
from ninja_game.formats.pack.index import LEVELS_PER_EPISODE, EpisodeIndex, parse_index
from ninja_game.formats.pack.pars import Pars, parse_pars
from ninja_game.formats.replay.episode import episode_key


class Pack:
    """A folder or zip with ``pack.toml``. Level files that cannot be read become ``problems``; the others are there.

    Raises PackError where there is no index or a wrong one, FileError for what is not a pack; OSError as it comes.
    """

    def __init__(self, path: Path) -> None:
        self.files = PackFiles(path)
        self.problems = list(self.files.problems)
        if INDEX not in self.files.names:
            raise PackError("a pack without its index", str(path), expected=f"a file {INDEX} in it")
        self.index = parse_index(self.files.text(INDEX), file=self.files.place(INDEX))

    @property
    def name(self) -> str:
        return self.index.name

    @cached_property
    def levels(self) -> dict[str, NamedLevel]:
        """The level of each file, the first one where it holds several."""
        found = {}
        for name in self.files.levels:
            try:
                found[name] = parse_levels(self.files.text(name), file=self.files.place(name))[0]
            except NinjaGameError as error:
                self.problems.append(str(error))
            except OSError as error:
                self.problems.append(f"{self.files.place(name)}: {error.strerror}")
        return found

    @cached_property
    def episodes(self) -> dict[EpisodeIndex, tuple[NamedLevel, ...]]:
        """The levels of each episode that has any, at most five, in the order of the episodes' numbers."""
        found = {}
        for episode in self.index.episodes:
            files = episode.files(self.files.levels)
            self.problems += [f"{self.files.place(file)}: not there" for file in files if file not in self.files.names]
            levels = tuple(self.levels[file] for file in files if file in self.levels)
            if len(levels) > LEVELS_PER_EPISODE:
                self.problems.append(f"{self.files.place(files[LEVELS_PER_EPISODE])}: the sixth level of its episode")
            if levels:
                found[episode] = levels[:LEVELS_PER_EPISODE]
        return found

    @cached_property
    def pars(self) -> dict[str, Pars]:
        """The pars of levels, by level file; those of a level that was changed since count no more."""
        if PARS not in self.files.names:
            return {}
        try:
            found = parse_pars(self.files.text(PARS), file=self.files.place(PARS))
        except (NinjaGameError, OSError) as error:
            self.problems.append(str(error))
            return {}
        digests = {file: level_digest(named.level) for file, named in self.levels.items() if file in found}
        return {file: pars for file, pars in found.items() if digests.get(file, "").startswith(pars.level or "?")}

    def certificate(self, file: str, kind: str) -> str | None:
        """The name of a level file's certificate, "exit" or "gold"; None where there is none."""
        name = certificate_name(file, kind)
        return name if name in self.files.names else None


def episodes_of(path: Path) -> set[str]:
    """The keys of a pack's episodes; none of anything else. Raises as ``Pack`` does."""
    found = Pack(path).episodes.values() if is_pack(path) else ()
    return {episode_key(each.level for each in levels) for levels in found}
