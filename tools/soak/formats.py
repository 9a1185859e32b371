"""Feed odd levels, demos, replays, traces and names to all readers: only errors of ours, none after over two seconds.

    python3 tools/dev.py tool soak.formats [--count 1000000] [--seed 1] [--reference]

Exit code 0: nothing found; 1: something was, printed with the seed that makes it.
"""

from __future__ import annotations

import argparse
import dataclasses
import io
import json
import random
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import file_stem, shown_text
from ninja_game.formats.ascii.reader import parse_ascii_level, write_ascii_level
from ninja_game.formats.links.fragment import read_link, write_link
from ninja_game.formats.links.making import level_link, replay_link
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.n14.demo import parse_demo, write_demo
from ninja_game.formats.n14.legacy_demo import write_legacy_demo
from ninja_game.formats.n14.level_file import read_level_file
from ninja_game.formats.n14.level_string import level_digest, parse_level_string, write_level_string
from ninja_game.formats.named_level import parse_levels
from ninja_game.formats.numbers import format_exact, parse_number
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.recording import parse_replays, record_of
from ninja_game.formats.replay.text import Replay, parse_replay, write_replay
from ninja_game.levels.warnings import level_warnings
from ninja_game.runs.recording_reader import recordings_of, records_of
from ninja_game.runs.run_trace import trace_level
from ninja_game.runs.trace_files import FiledTrace, read_csv, write_csv
from tools import ROOT
from tools.soak.odd_texts import Trial, odd

DEMO = "902:35791394|35791394|115483170|107374182|17895697|0"
LEVEL = (
    ("1" * 23 + ("0" * 20 + ":13") * 29 + "1" * 23)
    + "|5^60,540!0^396,300!1^204,180!2^60,564,0.707106781186547,-0.707106781186547!3^588,108!4^252,570,1"
    + "!6^252,132,0,1,0,2!7^348,372,3!8^444,84,1!9^468,348,0,0,20,14,1,-1,0!10^636,60!11^708,516,84,60"
    + "!12^300,561!0^408.15,NaN"
)


def read_level(text: str) -> None:
    """An in-game string: read, digest, writing in both forms; of some the warnings, which take longest."""
    level = parse_level_string(text)
    level_digest(level)
    if len(text) % 8 == 0:
        level_warnings(level)
    write_ascii_level(level)
    write_level_string(level, exact=True)


def read_demo(text: str) -> None:
    """A demo, 4-bit or legacy: read, played back, written."""
    demo = parse_demo(text)
    demo.playback(1000)
    write_demo(demo)


def read_ascii(text: str) -> None:
    """An ASCII level: what is read is the same when it is written and read again."""
    read = parse_ascii_level(text)
    again = parse_ascii_level(write_ascii_level(read.level, name=read.name, author=read.author, comment=read.comment))
    if level_digest(again.level) != level_digest(read.level) or (again.name, again.author) != (read.name, read.author):
        raise AssertionError("an ASCII level changes when it is written and read")


def read_replay(text: str) -> None:
    """A replay of ours: what is read is the same when it is written and read again."""
    written = write_replay(parse_replay(text))
    if write_replay(parse_replay(written)) != written:
        raise AssertionError("a replay changes when it is written and read")


def read_recordings(text: str) -> None:
    """Recordings of any format, as an archive and one by one, each as a record of N too."""
    list(recordings_of(records_of(text), ""))
    for recording in parse_replays(text):
        record_of(recording)


def show(text: str) -> None:
    """A name: shown in one line, and in a file's name."""
    shown = shown_text(text)
    if not shown.isprintable() or len(shown) > 2100 or len(file_stem(text).encode()) > 200:
        raise AssertionError("a name that cannot be shown")


READERS: dict[str, Callable[[str], object]] = {
    "level string": read_level,
    "level file": read_level_file,
    "ASCII level": read_ascii,
    "demo": read_demo,
    "replay": read_replay,
    "any levels": parse_levels,
    "any recordings": read_recordings,
    "trace table": lambda text: list(read_csv(text.splitlines(keepends=True))),
    "name": show,
    "link": read_link,
    "level in a link": lambda text: load_levels(write_link("level", [text])),
    "replay in a link": lambda text: load_replays(write_link("replay", [text])),
    "pack in a link": lambda text: Pack(Path(write_link("pack", [text]))).episodes,
    "number": lambda text: format_exact(parse_number(text[:60])),
}


def seeds(*, reference: bool) -> list[str]:
    """Texts of all formats; with ``reference`` also those of ``../shared/n14``."""
    level = parse_level_string(LEVEL)
    demo = parse_demo(DEMO)
    replay = Replay(demo.inputs[:60], 99, "dead", 3, "0f" * 32, level=level, name="walk")
    trace = io.StringIO()
    write_csv([FiledTrace(0, "walk", trace_level(level, demo.inputs[:20], memory="plain"))], trace)
    texts = [
        LEVEL,
        DEMO,
        write_legacy_demo(demo),
        f"free text\n$a hill#us#x#{LEVEL}#\n-- ep01 --\n$###{LEVEL}#{DEMO}#\n",
        f"free text\n&userdata=\n$a+hill%21#us#x#{LEVEL}#\n$###{LEVEL[:300]}\n{LEVEL[300:]}#{DEMO}",
        f"##{DEMO}#",
        write_ascii_level(level, name="A hill", author="us", legend=True),
        write_replay(replay),
        write_replay(dataclasses.replace(replay, name='"two\nlines"\ud800', author=" me\0", level_name="\ud800")),
        " -0x1.5e+2",
        json.dumps({"pack.toml": 'name = "p"\n[[episode]]\nnumber = 0', "00-0-a.txt": LEVEL, "pars.toml": ""}),
        "https://example.org/game/" + level_link(level, name="A hill"),
        replay_link([replay, replay]),
        trace.getvalue(),
        *[path.read_text(encoding="utf-8") for path in sorted(ROOT.glob("levels/*.txt"))],
        *[path.read_text(encoding="utf-8") for path in sorted(ROOT.glob("levels/certificates/*.txt"))],
    ]
    if reference:
        from tests.support import reference as data

        texts += [f"$###{run.data}#{run.demo}#" for run in data.random_runs()[::10]]
        texts += [scene.data for scene in data.scenes()[::5]]
    return texts


def taken_by(text: str) -> list[str]:
    """The readers that take a text as it is."""
    names = []
    for name, reader in READERS.items():
        try:
            reader(text)
            names.append(name)
        except NinjaGameError:
            continue
    return names


def case(seed: int, texts: list[str], fitting: dict[str, list[str]]) -> tuple[str, str]:
    """A reader's name and an odd text for it; now and then one that was made of another format."""
    rng = random.Random(seed)
    name = list(READERS)[seed % len(READERS)]
    text = rng.choice(texts if rng.random() < 0.1 else fitting[name])
    return name, odd(text, rng.choice(texts), rng)


def main() -> int:
    """Fuzz, print what was found and a summary."""
    parser = argparse.ArgumentParser(description="Feed mutated levels, demos and replays to all readers.")
    parser.add_argument("--count", type=int, default=100_000, help="how many texts (default 100000)")
    parser.add_argument("--seed", type=int, default=1, help="of the first text (default 1)")
    parser.add_argument("--reference", action="store_true", help="mutate texts of ../shared/n14 too")
    options = parser.parse_args()
    texts = seeds(reference=options.reference)
    taken = [(text, taken_by(text)) for text in texts]
    fitting = {name: [text for text, names in taken if name in names] for name in READERS}
    trial = Trial()
    for seed in range(options.seed, options.seed + options.count):
        name, text = case(seed, texts, fitting)
        trial.read(name, f"seed {seed}", partial(READERS[name], text))
        if trial.wrong >= 20:
            break
    return trial.summary()


if __name__ == "__main__":
    sys.exit(main())
