"""The commands, once, and the exit codes. `tools/dev.py` reads this with a bare Python: it imports nothing else."""

from __future__ import annotations

from typing import NamedTuple

_TABLE = """
game: play | windows | in-place | | Play a level in a window.
game: edit | windows | in-place | fast | Make a level, or change one, in a window.
game: lab | windows | in-place | fast | Drag, paint and watch: figures about how the world works.
game: player | machine | in-place | fast | Export all data of a player to one file, or import such a file.
game: film | film | | film | Write a film of a recording: a GIF, a WebM, an MP4, or a folder of pictures.
game: compile | machine | compiles | fast | Compile the rules for this machine now, so that no other command waits for it.
game: desktop | machine | | fast | Put the game into your menu of programs, with its icon and types of files.
game: link | convert | | fast | Make a link that carries a level, a pack or replays.
levels: info | info | | fast | Show what is in level and replay files.
levels: check | check | compiles in-place | fast | Certify levels: whether they can be passed, how fast, and what is odd.
levels: levels | levels | compiles in-place | fast | Make packs of levels ready to share: check, par times, zips and links.
levels: generate | levels | compiles | fast | Make a new level, certified by the solver.
levels: convert | convert | | fast | Turn levels and recordings from one format into the other.
runs: tas | windows | compiles in-place | fast | Edit a run tick by tick, in a window.
runs: record | convert | | fast | Run inputs that a person wrote, and write the result.
runs: verify | verify | compiles | cluster fast | Run recordings again and judge them.
runs: trace | trace | compiles | fast | Show every tick of recordings: position, velocity, state, events.
runs: splits | splits | | | Show when runs take gold, open doors and the exit, and end.
runs: compare | splits | | | Compare two runs of a level: where they part, and how far one is ahead.
runs: solve | search | compiles | fast | Find a run to the exit, then shorten it.
runs: improve | search | compiles | fast | Shorten a run that exists.
runs: search | search | compiles | fast | Find other keys for a span of a run.
runs: demonstrations | demonstrations | compiles | fast learn minari | Make demonstrations for learning agents of recordings.
web: site | web | in-place | fast | Build the game as a page in a browser: a folder for any static host.
web: board | web | compiles in-place | fast | Rank the runs of a folder, all simulated again: tables, pages, checks.
"""
"""A command a line: group and name; its module here; whether it may have to compile the rules first, and may replace a
file that it has read; extras of the package that it may use; the first line of its help."""


class Command(NamedTuple):
    module: str
    flags: str
    extras: tuple[str, ...]
    help: str


GROUPS: dict[str, dict[str, Command]] = {}
for _line in _TABLE.strip().splitlines():
    _name, _module, _flags, _extras, _help = (cell.strip() for cell in _line.split("|"))
    _group, _, _name = _name.partition(": ")
    GROUPS.setdefault(_group, {})[_name] = Command(_module, _flags, tuple(_extras.split()), _help)

COMMANDS = {name: command for group in GROUPS.values() for name, command in group.items()}

# Exit codes, the last three as shells have them.
FAILED = 1  # a recording does not do what it says, no run was found, traces differ
BAD_INPUT = 2  # input that cannot be read, or wrong usage
INTERNAL_ERROR = 3  # a fault of this program; its traceback is on stderr
INTERRUPTED, TERMINATED = 130, 143  # by Ctrl-C, by SIGTERM
BROKEN_PIPE = 141  # whoever read our output has gone
