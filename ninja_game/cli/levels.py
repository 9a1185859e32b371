"""Commands for whole packs of levels."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from ninja_game.cli import solver_options as options
from ninja_game.cli.run_options import with_progress
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.run_time import seconds_text

if TYPE_CHECKING:
    from ninja_game.formats.pack.pack import Pack
    from ninja_game.levels.findings import PackFinding


@click.command(name="lint")
@click.argument("pack", type=click.Path(exists=True, path_type=Path))
@click.option("--design", is_flag=True, help="Report what levels lack that good ones have, too.")
@click.pass_context
def lint(ctx: click.Context, pack: Path, design: bool) -> None:
    """Report what is odd about a pack: its index, its levels, its certificates, its table of pars.

    A line says how to mend what was found, and ends in its code (docs/findings.md).

    Exit code 0: nothing; 1: something is odd; 2: the pack or its index cannot be read.

    \b
    Examples:
      ninja-game levels lint my-pack/
      ninja-game levels lint my-pack.zip
      ninja-game levels lint my-pack/ --design
    """
    from ninja_game.formats.pack.pack import Pack
    from ninja_game.runs.packs import lint

    opened = Pack(pack)
    found = list(lint(opened, with_design=design))
    _show(found)
    click.echo(_summary(opened, len(found)))
    ctx.exit(1 if found else 0)


def _show(found: list[PackFinding]) -> None:
    for finding in found:
        click.echo(f"{shown_text(str(finding), 500)}. {finding.hint} [{finding.code}]")


def _summary(pack: Pack, found: int) -> str:
    """What a pack holds, and how much of it is odd."""
    parts = [counted(len(pack.episodes), "episode"), counted(len(pack.levels), "level")]
    parts.append(counted(found, "finding") if found else "nothing odd")
    accepted = len(pack.index.accepted)
    return f"{shown_text(pack.name)}: {', '.join(parts)}{f', {accepted} accepted' if accepted else ''}"


@click.command(name="pars")
@click.argument("pack", type=click.Path(exists=True, file_okay=False, path_type=Path))
def pars(pack: Path) -> None:
    """Write par times and difficulties of a pack's levels into its pars.toml.

    They are derived from the certificates, replays in PACK/certificates: NAME.exit.replay.txt, the fastest run to the
    exit of NAME.txt, and NAME.gold.replay.txt, a run with all gold. A level without a sound certificate gets none.

    \b
    Examples:
      ninja-game levels pars my-pack/
      ninja-game levels pars levels/
    """
    from ninja_game.files.tree import Tree
    from ninja_game.formats.pack.files import PARS
    from ninja_game.formats.pack.pack import Pack
    from ninja_game.formats.pack.pars import MARGINS, write_pars
    from ninja_game.runs.packs import make_pars

    opened = Pack(pack)
    made = dict(with_progress(make_pars(opened), "level"))
    for file, pars in made.items():
        times = "  ".join(f"{medal} {seconds_text(pars.par(medal)):>7}" for medal in MARGINS)
        click.echo(f"{times}  difficulty {pars.difficulty or 0:6.2f}  {shown_text(file)}")
    Tree(pack).write(PARS, write_pars(made))
    without = len(opened.levels) - len(made)
    with_pars = f"{counted(len(made), 'level')} with pars"
    click.echo(f"{with_pars}, {without} without a sound certificate; wrote {pack / PARS}")


@click.command(name="pack")
@click.argument("pack", type=click.Path(exists=True, file_okay=False, path_type=Path))
@options.seconds_option(20.0)
@click.option("--jobs", type=click.IntRange(1, 1024), help="Levels at the same time. [default: one per core]")
@click.option(
    "--zip", "zip_path", type=click.Path(dir_okay=False, path_type=Path), help="[default: PACK.zip beside it]"
)
@click.pass_context
def pack_up(ctx: click.Context, pack: Path, seconds: float, jobs: int | None, zip_path: Path | None) -> None:
    """Make a pack ready to share: certificates, par times, difficulties, a list of what is odd, a zip and a link.

    Each level is certified to the exit and with all gold, --seconds each. What is there and still right is not done
    again, so that after a change only its level is searched and measured. The game's screen Packs does the same.

    Exit code 0: nothing is odd; 1: something is; 2: the pack or its index cannot be read.

    \b
    Examples:
      ninja-game levels pack my-pack/
      ninja-game levels pack my-pack/ --seconds 60 --zip shared.zip
    """
    from ninja_game.editor.packing import make_ready
    from ninja_game.files.writing import check_output, write_atomically

    path = zip_path or pack.resolve().with_name(f"{pack.resolve().name}.zip")
    check_output(path)
    with options.progress_line() as report:
        ready = make_ready(
            pack, seconds=seconds, jobs=options.default_threads(jobs), say=lambda text, _: report.say(text)
        )
    write_atomically(path, ready.zipped)
    _show(ready.findings)
    click.echo(
        "\n".join([*ready.notes, _summary(ready.pack, len(ready.findings)), f"wrote {path}", ready.link]).strip()
    )
    ctx.exit(1 if ready.findings else 0)


@click.group(commands={"pack": pack_up, "pars": pars, "lint": lint})
def levels() -> None:
    """Make packs of levels ready to share: check them, make their par times, zips and links.

    A pack is a folder or zip with an index, pack.toml.

    \b
    Examples:
      ninja-game levels pack my-pack/
      ninja-game levels lint my-pack/
      ninja-game levels pars my-pack/
    """
