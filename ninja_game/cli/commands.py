"""The commands, once, and the exit codes. `tools/dev.py` reads this with a bare Python: it imports nothing else."""

from __future__ import annotations

from typing import NamedTuple

_TABLE = """
game
play | windows | in-place | | Play a level in a window.
edit | windows | in-place | fast | Make a level, or change one, in a window.
lab | windows | in-place | fast | Drag, paint and watch: figures about how the world works.
player | machine | in-place | fast | Export all data of a player to one file, or import such a file.
film | film | | film | Write a film of a recording: a GIF, a WebM, an MP4, or a folder of pictures.
compile | machine | compiles | fast | Compile the rules for this machine now, so that no other command waits for it.
desktop | machine | | fast | Put the game into your menu of programs, with its icon and types of files.
link | convert | | fast | Make a link that carries a level, a pack or replays.

levels
info | info | | fast | Show what is in level and replay files.
check | check | compiles in-place | fast | Certify levels: whether they can be passed, how fast, and what is odd.
levels | levels | compiles in-place | fast | Make packs of levels ready to share: check, par times, zips and links.
generate | levels | compiles | fast | Make a new level, certified by the solver.
convert | convert | | fast | Turn levels and recordings from one format into the other.

runs
tas | windows | compiles in-place | fast | Edit a run tick by tick, in a window.
record | convert | | fast | Run inputs that a person wrote, and write the result.
verify | verify | compiles | cluster fast | Run recordings again and judge them.
trace | trace | compiles | fast | Show every tick of recordings: position, velocity, state, events.
splits | splits | | | Show when runs take gold, open doors and the exit, and end.
compare | splits | | | Compare two runs of a level: where they part, and how far one is ahead.
solve | search | compiles | fast | Find a run to the exit, then shorten it.
improve | search | compiles | fast | Shorten a run that exists.
search | search | compiles | fast | Find other keys for a span of a run.
demonstrations | demonstrations | compiles | fast learn minari | Make demonstrations for learning agents of recordings.

web
site | web | in-place | fast | Build the game as a page in a browser: a folder for any static host.
board | web | compiles in-place | fast | Rank the runs of a folder, all simulated again: tables, pages, checks.
"""
"""By groups, a command a line: its name; its module here; whether it may have to compile the rules first, and may
replace a file that it has read; extras of the package that it may use; the first line of its help."""


class Command(NamedTuple):
    module: str
    flags: str
    extras: tuple[str, ...]
    help: str


def _read(block: str) -> tuple[str, dict[str, Command]]:
    group, *lines = block.splitlines()
    rows = [[cell.strip() for cell in line.split("|")] for line in lines]
    return group, {name: Command(module, flags, tuple(uses.split()), text) for name, module, flags, uses, text in rows}


GROUPS = dict(map(_read, _TABLE.strip().split("\n\n")))
COMMANDS = {name: command for group in GROUPS.values() for name, command in group.items()}

# Exit codes, the last three as shells have them.
FAILED = 1  # a recording does not do what it says, no run was found, traces differ
BAD_INPUT = 2  # input that cannot be read, or wrong usage
INTERNAL_ERROR = 3  # a fault of this program; its traceback is on stderr
INTERRUPTED, TERMINATED = 130, 143  # by Ctrl-C, by SIGTERM
BROKEN_PIPE = 141  # whoever read our output has gone
