"""Commands that convert files: convert, record, link."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

import click

from ninja_game.cli import options
from ninja_game.cli.progress import heartbeat, with_progress
from ninja_game.cli.terminal import data_output
from ninja_game.errors import FileError, LevelError
from ninja_game.files.shown_text import counted, file_stem, name_key, name_problem, shown_text
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import REPLAY_SUFFIX, free_path
from ninja_game.files.writing import check_output, write_atomically
from ninja_game.formats.ascii.writer import headers_of, write_ascii_level
from ninja_game.formats.lines import MAX_NAME
from ninja_game.formats.links import is_link, level_link, recording_link
from ninja_game.formats.load import NamedLevel, Recording, load_levels, load_replays, texts_of
from ninja_game.formats.n14.level_string import write_level_string
from ninja_game.formats.pack.pack import PackFiles, is_pack
from ninja_game.formats.recording import holds_recordings
from ninja_game.formats.replay.text import parse_replay
from ninja_game.formats.run_time import seconds_text

RUN_FORMS = {"replay": REPLAY_SUFFIX, "inputs": ".inputs.txt", "celeste": ".tas", "libtas": ".libtas.txt"}
"""The forms of recordings of which a file holds one, and how it is called."""

_FORMS = ("ascii", "string", "file", *RUN_FORMS, "episode")
STANDARD_STREAM = "-"

FORM_OF_NAME = {
    **{suffix: form for form, suffix in RUN_FORMS.items()}, ".replay": "replay", ".demo": "file", ".nlevel": "string",
    ".episode.txt": "episode",
}  # fmt: skip
"""Format that is written, by the ending of OUT."""


@click.command()
@click.argument("sources", metavar="IN...", nargs=-1, required=True, type=options.LevelPath())
@click.argument("target", metavar="OUT", type=click.Path(allow_dash=True))
@click.option("--to", "form", type=click.Choice(_FORMS), help="The form to write, whatever OUT is called.")
@click.option("--legend", is_flag=True, help="End readable levels with the meaning of all characters, as comments.")
@options.level_option
@click.option("--author", metavar="NAME", help="Who made the recordings that do not say it, such as demos of N.")
@options.budget_option
@click.option("--force", is_flag=True, help="Replace files that exist. IN is never replaced.")
def convert(
    sources: Sequence[Path],
    target: str,
    form: str | None,
    legend: bool,
    level_path: Path | None,
    author: str | None,
    budget: int,
    force: bool,
) -> None:
    """Turn levels and recordings from one format into another.

    IN is a file, folder or link in any format; OUT a file, a folder, or - for the terminal. What is written:

    \b
      ascii   levels as a picture and a list of objects; several: one file each, in the folder OUT
      string  levels as in-game strings of N, one a line
      file    a level file of N, $name#author#comment#level#, recordings with their demos behind the level
      replay  recordings as our replay texts, run once; several: one file each, in the folder OUT
      episode the recordings, in the order of an episode's levels, as one text: the time is carried on
      inputs  recordings as replay texts, not run, with all their inputs
      celeste, libtas  the same in the notations of these tools

    Without --to: replay where OUT ends in .replay.txt or .replay, episode for .episode.txt, inputs for .inputs.txt,
    celeste for .tas, file for .demo, string for .nlevel; else levels of N become ascii and readable ones a level file.
    What the form cannot hold is reported.

    \b
    Examples:
      ninja-game convert userlevels.txt my-levels/
      ninja-game convert my-levels/ userlevels.txt
      ninja-game convert first.txt second.txt pack.txt
      ninja-game convert my-levels/first.txt first.nlevel
      ninja-game convert demos.txt replays/ --to replay --author Ann
      ninja-game convert 0.replay.txt 1.replay.txt 2.replay.txt 3.replay.txt 4.replay.txt 00.episode.txt
      ninja-game convert run.replay.txt run.demo
      ninja-game convert first.nlevel -
    """
    from ninja_game.runs.conversion import by_player, episode_text, input_texts, left_out, level_file_text, replay_texts

    output = Output(target, sources, force=force)
    texts = [named for source in sources for named in texts_of(source)]
    level = options.load_level_option(level_path)
    form = form or next((form for suffix, form in FORM_OF_NAME.items() if target.lower().endswith(suffix)), "")
    if level and form in ("ascii", "string"):
        raise click.UsageError("--level is for recordings: add --to replay or --to file")
    if author and form not in ("replay", "inputs", "episode"):
        raise click.UsageError("--author is for recordings: add --to replay")
    player = shown_text(author or "", MAX_NAME).strip()
    items: Sequence[NamedLevel | Recording]
    if form in RUN_FORMS or form == "episode" or level:
        found = (recording for source in sources for recording in load_replays(source, level=level))
        items = recordings = [by_player(recording, player) for recording in found]
        form = form or "file"
        if form in RUN_FORMS:
            written = replay_texts(recordings, budget) if form == "replay" else input_texts(recordings, form)
            output.write_each(list(with_progress(written, "recording")), recordings, RUN_FORMS[form])
        elif form == "episode":
            output.write(episode_text(recordings, budget))
    else:
        items = levels = [named for source in sources for named in load_levels(source)]
        form = form or ("file" if all(named.ascii for named in levels) else "ascii")
        if form == "ascii":
            pictures = [write_ascii_level(named.level, **headers_of(named), legend=legend) for named in levels]
            output.write_each(pictures, levels, ".txt")
    if form == "file":
        output.write(level_file_text(texts, level))
    elif form == "string":
        output.write("".join(write_level_string(named.level, exact=True) + "\n" for named in items))
    if lost := left_out(form, items, [text for _, text in texts]):
        click.echo(f"left out: {', '.join(lost)}", err=True)


class Output:
    """The target of the texts: a file, a folder or the terminal. Nothing is overwritten unless ``force``."""

    def __init__(self, target: str, sources: Sequence[Path], *, force: bool) -> None:
        self.target = target
        self.sources = [source for source in sources if not is_link(source)]
        self.force = force

    def write(self, text: str) -> None:
        """Write one file, or to the terminal."""
        if self.target == STANDARD_STREAM:
            click.echo(text, data_output(), nl=False, color=True)  # else a pipe loses what looks like a colour
        else:
            self._put([(Path(self.target), text)])

    def write_each(self, texts: Sequence[str], items: Sequence[NamedLevel | Recording], suffix: str) -> None:
        """Write a file each; one text is a file by itself unless OUT is a folder."""
        folder = Path(self.target)
        if self.target == STANDARD_STREAM and (suffix == ".txt" or len(texts) == 1):
            self.write("\n".join(texts))
        elif len(texts) == 1 and not folder.is_dir() and not self.target.endswith(("/", "\\")):
            self.write(texts[0])
        elif (folder.exists() and not folder.is_dir()) or folder.suffix or self.target == STANDARD_STREAM:
            what = f"{len(texts)} {'levels' if suffix == '.txt' else 'recordings'} do not fit into one file"
            raise LevelError(what, self.target, hint="name a folder, or use --to file")
        else:
            names = _file_names(items, suffix)
            self._put([(folder / name, text) for name, text in zip(names, texts, strict=True)], Tree(folder))
            click.echo(f"{counted(len(texts), 'file')} written to {folder}", err=True)

    def _put(self, files: Sequence[tuple[Path, str]], tree: Tree | None = None) -> None:
        """Write files, those of a folder into ``tree``. Raises FileError, before any is written, if one must stay."""
        for path in [path for path, _ in files if os.path.lexists(path)]:
            if path.exists() and any(source.samefile(path) for source in self.sources):
                raise FileError("the output is the input", str(path), hint="choose another name for the output")
            if not self.force:
                raise FileError("the file already exists", str(path), hint="--force replaces it")
            check_output(path, keep=self.sources)
            if tree:
                tree.check(path.name)
        for path, text in files:
            if tree:
                tree.write(path.name, text)
            else:
                write_atomically(path, text, keep=self.sources)


def _file_names(items: Sequence[NamedLevel | Recording], suffix: str) -> Iterator[str]:
    """`0007-name-of-the-level.txt`, of several files with theirs before it; single files keep their names."""
    digits = max(3, len(str(len(items) - 1)))
    stems = [Path(item.file).name.removesuffix(".txt").removesuffix(".replay") for item in items]
    names = [Path(stem).stem + suffix for stem in stems]
    alone = len({name_key(name) for name in names}) == len(items) > 1 and not any(map(name_problem, names))
    several = len({item.file for item in items}) > 1
    for number, (item, own) in enumerate(zip(items, names, strict=True)):
        name = file_stem(f"{stems[number]} {item.name}" if several else item.name)
        numbered = f"{number:0{digits}d}-{name}".rstrip("-")
        yield own if alone else numbered + suffix


@click.command()
@click.argument("inputs", metavar="FILE", type=options.OLD_FILE)
@options.output_option("The replay. [default: FILE's name and .replay.txt, in this folder]")
@options.record_option
@options.play_on_option
@options.budget_option
@click.option("--force", is_flag=True, help="Replace a file that exists. FILE is never replaced.")
def record(
    inputs: Path, output: Path | None, record: int | None, level_path: Path | None, budget: int, force: bool
) -> None:
    """Run inputs that a person wrote, and write the result.

    FILE is a replay text with or without claims (docs/replay-format.md), or any other recording. Its inputs run until
    the exit, death or their end; outcome, gold, digest and waypoints of that run are written with them. Comments,
    blocks and files that are included become plain inputs; markers, names and authors stay. So does a replay whose
    level was changed after the recording: its inputs run on the level as it is now.

    \b
    Examples:
      ninja-game record idea.inputs.txt
      ninja-game record idea.inputs.txt -o best.replay.txt --force
      ninja-game record celeste.tas --level level.txt
      ninja-game record old.replay.txt --level changed.txt
    """
    from ninja_game.runs.conversion import on_level, replay_texts

    level = options.load_level_option(level_path)
    recording = options.choose(load_replays(inputs, level=level, changed=True), "recordings", inputs, record)
    with heartbeat(lambda: "running the inputs"):
        (text,) = replay_texts([on_level(recording, level)], budget)
    path = output or free_path(Path(), inputs.name.partition(".")[0], REPLAY_SUFFIX)
    Output(str(path), [inputs], force=force).write(text)
    new = parse_replay(text)
    length = new.length
    when = f"{'in tick' if new.end_tick >= 0 else 'after ticks:'} {length} ({seconds_text(length)} s)"
    click.echo(f"{shown_text(str(path))}: {new.outcome} {when}, {new.gold} gold")


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=options.LevelPath())
@options.record_option
@click.option("--base", metavar="URL", default="", help="Address of a page with the game, which opens the link.")
def link(files: Sequence[Path], record: int | None, base: str) -> None:
    """Make a link that carries a level, a pack or replays.

    FILE is a level, a pack (a folder or zip with pack.toml) or a replay, in any format; several replays of one level
    run side by side. The link holds the whole text, compressed: whoever opens it needs nothing else, and a link
    without --base is opened with `ninja-game play LINK`. How links are written: docs/links.md.

    \b
    Examples:
      ninja-game link 00-0-first-steps --base https://example.org/game/
      ninja-game link my-pack.zip
      ninja-game link mine.replay.txt yours.replay.txt
      ninja-game play '#level=1.…'
    """
    click.echo(base.partition("#")[0] + link_of(files, record))


def link_of(files: Sequence[Path], record: int | None = None) -> str:
    """The link of what files hold: one pack, one level, or all the recordings. Raises NinjaGameError."""
    first = files[0]
    if is_pack(first):
        if len(files) > 1 or record is not None:
            raise click.UsageError("a link carries one pack, whole")
        return PackFiles(first).link()
    if all(holds_recordings(text) for file in files for _, text in texts_of(file)):
        runs = [run for file in files for run in load_replays(file)]
        return recording_link(runs if record is None else [options.choose(runs, "recordings", first, record)])
    if len(files) > 1:
        raise click.UsageError("a link carries one level; make a pack of several, or give replays only")
    named = options.choose(load_levels(first), "levels", first, record)
    return level_link(named.level, **headers_of(named))
