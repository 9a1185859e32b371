"""Texts that are made to cost much: a megabyte takes seconds of the processor and a limited memory, or is refused."""

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from ninja_game.errors import ReplayError
from ninja_game.formats.load import load_replays
from ninja_game.formats.replay import input_text
from ninja_game.formats.replay.input_text import read_inputs
from ninja_game.formats.replay.notations import Marker, write_celeste
from tests.support.samples import WALK, unclaimed_text

MEGABYTE = 1_000_000


def filled(unit: str) -> str:
    """A megabyte of something."""
    return unit * (MEGABYTE // len(unit))


def lines(form: str, size: int) -> str:
    """A megabyte of lines with numbers in them; ``size``: about how long one is."""
    return "".join(f"{form.format(number)}\n" for number in range(MEGABYTE // size))


WORST: dict[str, Callable[[], str]] = {
    "runs": lambda: unclaimed_text(WALK, filled("R L ")),
    "ticks": lambda: unclaimed_text(WALK, filled("R*2 L*2 ")),
    "empty blocks": lambda: unclaimed_text(WALK, filled("() ")),
    "blocks in blocks": lambda: unclaimed_text(WALK, "((((((( " + filled("() R ") + " )*9)*9)*9)*9)*9)*9)*9"),
    "markers": lambda: unclaimed_text(WALK, *lines("#m{} R", 8).splitlines()),
    "comments": lambda: unclaimed_text(WALK, filled("; x\n  ")),
    "semicolons": lambda: unclaimed_text(WALK, "R ;" + filled(";")),
    "one word": lambda: unclaimed_text(WALK, filled("R")),
    "an unknown header": lambda: unclaimed_text(WALK, "R", headers=filled("a") + ": 1\n"),
    "a name in JSON": lambda: unclaimed_text(WALK, "R", headers='name: "' + filled("[") + "\n"),
    "objects": lambda: WALK + "".join(f"!0^{number % 700},{number % 500}" for number in range(MEGABYTE // 10)),
    "empty objects": lambda: WALK + filled("!"),
    "values": lambda: WALK + "!0^" + filled("1,"),
    "digits": lambda: WALK + "!0^" + filled("9") + ",5",
    "hex digits": lambda: WALK + "!0^0x" + filled("f") + ",5",
    "records": lambda: filled(f"$n#a#c#{WALK}#\n"),
    "tiny records": lambda: filled("$n#a#c#0#0:0#"),
    "dollars": lambda: filled("$"),
    "hashes": lambda: "$a" + filled("#"),
    "a demo": lambda: f"{MEGABYTE // 8}:" + filled("1234567|")[:-1],
    "a demo of digits": lambda: "5:" + filled("9"),
    "a legacy demo": lambda: "A" + filled("R5L7"),
    "packed legacy demos": lambda: filled("$n#a#c##A" + "\x96b" * 58 + "#\n"),
    "frames": lambda: filled("  30,R,J\n"),
    "no frames": lambda: filled("0\n"),
    "keys of a frame": lambda: "30" + filled(",R") + "!",
    "labels": lambda: "1,R\n" + filled("#a\n"),
    "labels that are there": lambda: "1,R\n" + lines("#a-{}", 12) + filled("#a\n"),
    "repeats": lambda: filled("Repeat 2\nEndRepeat\n"),
    "movie": lambda: filled("|Kff53:ffe1|\n"),
    "keys of a movie": lambda: "|K" + filled("ff53:") + "|\n",
    "blanks": lambda: filled(" "),
    "lines": lambda: filled("\n"),
    "no text": lambda: filled("x"),
}

CHILD = r"""
import json, re, resource, sys
from pathlib import Path
from ninja_game.errors import NinjaGameError
from ninja_game.formats.load import load_levels, load_replays, parse_level
from ninja_game.runs.conversion import input_texts
from ninja_game.runs.recording_reader import recordings_in

level = parse_level(sys.argv[2])
ways = (
    lambda path: sum(1 for _ in recordings_in([path], level)), load_levels,
    lambda path: list(input_texts(load_replays(path, level=level)[:1000], "celeste")),
    lambda path: list(input_texts(load_replays(path, level=level)[:1000], "inputs")),
)
for path in sorted(Path(sys.argv[1]).iterdir()):
    seconds = []
    for way in ways:
        before = resource.getrusage(resource.RUSAGE_SELF).ru_utime
        try:
            way(path)
        except NinjaGameError:
            pass
        seconds.append(resource.getrusage(resource.RUSAGE_SELF).ru_utime - before)
    # The peak that getrusage tells may be that of the program which started this one.
    peak = int(re.search(r"VmHWM:\s+(\d+)", Path("/proc/self/status").read_text())[1]) // 1024
    print(json.dumps([path.name, max(seconds), peak]), flush=True)
"""
"""Reads every file in all ways (of many recordings, which are reported one by one, a thousand).

For each the most seconds of the processor, and the peak of the memory so far, MiB.
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="the limits of a process are those of Linux")
def test_a_megabyte_takes_seconds_of_the_processor_and_a_limited_memory(tmp_path: Path) -> None:
    folder = tmp_path / "worst"
    folder.mkdir()
    for name, text in WORST.items():
        (folder / f"{name}.txt").write_text(text(), "utf-8")
    # What grows faster than its text ends here and not in an hour.
    limits = f"ulimit -t 600 -v {4 << 20}; exec {sys.executable} -c '{CHILD}' '{folder}' '{WALK}'"
    done = subprocess.run(["/bin/sh", "-c", limits], capture_output=True, text=True, check=False)
    results = [json.loads(line) for line in done.stdout.splitlines()]
    assert (done.returncode, len(results)) == (0, len(WORST)), done.stderr
    # Five seconds are promised; a slow machine may take three times as long.
    assert [name for name, seconds, _ in results if seconds > 15] == []
    assert results[-1][2] < 500


def test_a_marker_costs_as_much_among_many() -> None:
    """CelesteTAS: the work for a marker must not grow with their number, so that many of them are done at all."""
    ticks = 200_000
    text = write_celeste(bytes([2]) * ticks, [Marker(tick, f"m{tick}") for tick in range(0, ticks, 2)])
    assert text.count("#") == ticks // 2
    assert text.startswith("#m0\n   2,R\n#m2\n   2,R\n")


def test_more_markers_than_a_text_may_hold_are_reported(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(input_text, "MAX_MARKERS", 5)
    assert len(read_inputs([(1, "#a #b #c #d #e R")]).markers) == 5
    with pytest.raises(ReplayError, match=r"2:4: too many markers; found '#f'; expected at most 5"):
        read_inputs([(1, "#a #b #c #d #e R"), (2, "   #f R")])
    (tmp_path / "part.txt").write_text("#d #e #f R")
    main = tmp_path / "run.txt"
    main.write_text(unclaimed_text(WALK, "#a #b #c R", "include part.txt"))
    with pytest.raises(ReplayError, match=r"part\.txt:1:7: too many markers"):
        load_replays(main)


def test_more_ticks_than_demos_of_older_versions_may_hold_together_are_reported(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    path = tmp_path / "old.txt"
    path.write_text(f"$n#a#c#{WALK}#AR5L7#\n" * 3)
    (first, *_) = load_replays(path)
    monkeypatch.setattr("ninja_game.formats.recording.MAX_LEGACY_TICKS", 2 * first.ticks)
    with pytest.raises(ReplayError, match=r"old\.txt:3: the demos of older versions .* are too long together"):
        load_replays(path)


def test_what_is_taken_in_again_is_read_once(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "part.txt").write_text("#here R*2 L ; a comment")
    main = tmp_path / "run.txt"
    main.write_text(unclaimed_text(WALK, *["include part.txt"] * 100))
    calls = []

    def noted(text: str) -> bool:
        calls.append(text)
        return False

    monkeypatch.setattr(input_text, "is_tas_text", noted)
    (run,) = load_replays(main)
    assert run.replay.inputs == bytes([2, 2, 1] * 100)
    assert [marker.tick for marker in run.replay.markers] == [0]
    assert len(calls) == 1


@pytest.mark.parametrize("comment", [";" * 2**19, f"; {'€' * (2**19 // 3)}"], ids=["letters", "letters of 3 bytes"])
def test_all_that_is_taken_in_together_has_a_limit(
    comment: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(input_text, "MAX_BYTES", 2**20)
    for name in "ab":
        (tmp_path / f"{name}.txt").write_text(f"R\n{comment}", "utf-8")
    main = tmp_path / "run.txt"
    main.write_text(unclaimed_text(WALK, *["include a.txt"] * 9))
    assert load_replays(main)[0].ticks == 9
    main.write_text(unclaimed_text(WALK, "include a.txt", "include b.txt"))
    with pytest.raises(ReplayError, match=r"too much included; found 'b\.txt'; expected 1 MiB in all"):
        load_replays(main)
