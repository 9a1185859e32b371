"""The commands, once, and the exit codes. `tools/dev.py` reads this with a bare Python: it imports nothing else."""

from __future__ import annotations

from typing import NamedTuple


class Command(NamedTuple):
    """A command without its code, which is imported only when it runs.

    ``module``: its own, here; ``help``: the first line of its help; ``extras``: of the package that it may use;
    ``compiles``: it may have to compile the rules; ``in_place``: it may replace a file that it has read.
    """

    module: str
    help: str
    compiles: bool = False
    in_place: bool = False
    extras: tuple[str, ...] = ("fast",)


GROUPS = {
    "game": {
        "play": Command("windows", "Play a level in a window.", in_place=True, extras=()),
        "edit": Command("windows", "Make a level, or change one, in a window.", in_place=True),
        "lab": Command("windows", "Drag, paint and watch: figures about how the world works.", in_place=True),
        "player": Command("machine", "Export all data of a player to one file, or import such a file.", in_place=True),
        "film": Command(
            "film", "Write a film of a recording: a GIF, a WebM, an MP4, or a folder of pictures.", extras=("film",)
        ),
        "compile": Command(
            "machine", "Compile the rules for this machine now, so that no other command waits for it.", compiles=True
        ),
        "desktop": Command("machine", "Put the game into your menu of programs, with its icon and types of files."),
        "link": Command("convert", "Make a link that carries a level, a pack or replays."),
    },
    "levels": {
        "info": Command("info", "Show what is in level and replay files."),
        "check": Command(
            "check",
            "Certify levels: whether they can be passed, how fast, and what is odd.",
            compiles=True,
            in_place=True,
        ),
        "levels": Command(
            "levels",
            "Make packs of levels ready to share: check, par times, zips and links.",
            compiles=True,
            in_place=True,
        ),
        "generate": Command("levels", "Make a new level, certified by the solver.", compiles=True),
        "convert": Command("convert", "Turn levels and recordings from one format into another."),
    },
    "runs": {
        "tas": Command("windows", "Edit a run tick by tick, in a window.", compiles=True, in_place=True),
        "record": Command("convert", "Run inputs that a person wrote, and write the result."),
        "verify": Command("verify", "Run recordings again and judge them.", compiles=True, extras=("cluster", "fast")),
        "trace": Command("trace", "Show every tick of recordings: position, velocity, state, events.", compiles=True),
        "splits": Command("splits", "Show when runs take gold, open doors and the exit, and end.", extras=()),
        "compare": Command(
            "splits", "Compare two runs of a level: where they part, and how far one is ahead.", extras=()
        ),
        "solve": Command("search", "Find a run to the exit, then shorten it.", compiles=True),
        "improve": Command("search", "Shorten a run that exists.", compiles=True),
        "search": Command("search", "Find other keys for a span of a run.", compiles=True),
        "demonstrations": Command(
            "demonstrations",
            "Make demonstrations for learning agents of recordings.",
            compiles=True,
            extras=("fast", "learn", "minari"),
        ),
    },
    "web": {
        "site": Command("web", "Build the game as a page in a browser: a folder for any static host.", in_place=True),
        "board": Command(
            "web",
            "Rank the runs of a folder, all simulated again: tables, pages, checks.",
            compiles=True,
            in_place=True,
        ),
    },
}
COMMANDS = {name: command for group in GROUPS.values() for name, command in group.items()}

# Exit codes, the last three as shells have them.
FAILED = 1  # a recording does not do what it claims, no run was found, traces differ
BAD_INPUT = 2  # input that cannot be read, or wrong usage
INTERNAL_ERROR = 3  # a fault of this program; its traceback is on stderr
INTERRUPTED, TERMINATED = 130, 143  # by Ctrl-C, by SIGTERM
BROKEN_PIPE = 141  # the reader of our output was closed (a broken pipe)
