"""Commands that make levels: a new one by rules of composition, and whole packs of them."""

from __future__ import annotations

from pathlib import Path
from random import SystemRandom
from typing import TYPE_CHECKING

import click

from ninja_game.cli import options
from ninja_game.cli.commands import FAILED
from ninja_game.cli.options import NEW_FILE, OLD_FOLDER, OLD_PATH
from ninja_game.cli.progress import progress_line, with_progress
from ninja_game.errors import FileError
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.files.user_folder import free_path
from ninja_game.files.writing import check_output, write_atomically
from ninja_game.formats.run_time import seconds_text, time_text

if TYPE_CHECKING:
    from ninja_game.formats.pack.pack import Pack
    from ninja_game.levels.findings import PackFinding


@click.command(name="lint")
@click.argument("pack", type=OLD_PATH)
@click.option("--design", is_flag=True, help="Report what levels lack that good ones have, too.")
def lint(pack: Path, design: bool) -> int:
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
    from ninja_game.runs.packs import findings

    opened = Pack(pack)
    return _print_findings(opened, list(findings(opened, with_design=design)))


def _print_findings(pack: Pack, findings: list[PackFinding]) -> int:
    """Say what is odd; the exit code."""
    open_findings = [finding for finding in findings if not finding.reason]
    for finding in open_findings:
        text = f"{pack.files.place(finding.place)}: {finding.text}" if finding.file else finding.text
        click.echo(f"{shown_text(text, 500)}. {finding.hint} [{finding.code}]")
    count = len(open_findings)
    accepted = len({(finding.file, finding.code) for finding in findings if finding.reason})
    parts = [counted(len(pack.episodes), "episode"), counted(len(pack.levels), "level")]
    parts.append(counted(count, "finding") if count else "nothing odd")
    parts += [f"{accepted} accepted"] if accepted else []
    click.echo(f"{shown_text(pack.name)}: {', '.join(parts)}")
    return 1 if open_findings else 0


@click.command(name="pars")
@click.argument("pack", type=OLD_FOLDER)
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
    from ninja_game.formats.pack.pack import PARS, Pack
    from ninja_game.formats.pack.pars import MARGINS, write_pars
    from ninja_game.runs.packs import make_pars

    opened = Pack(pack)
    all_pars = dict(with_progress(make_pars(opened), "level"))
    for file, made in all_pars.items():
        times = "  ".join(f"{medal} {seconds_text(made.par(medal)):>7}" for medal in MARGINS)
        click.echo(f"{times}  difficulty {made.difficulty or 0:6.2f}  {shown_text(file)}")
    Tree(pack).write(PARS, write_pars(all_pars))
    missing = len(opened.levels) - len(all_pars)
    with_pars = f"{counted(len(all_pars), 'level')} with pars"
    click.echo(f"{with_pars}, {missing} without a sound certificate; wrote {pack / PARS}")


@click.command(name="pack")
@click.argument("pack", type=OLD_FOLDER)
@options.seconds_option(20.0)
@options.levels_jobs_option
@click.option("--zip", "zip_path", type=NEW_FILE, help="[default: PACK.zip beside it]")
def pack_up(pack: Path, seconds: float, jobs: int, zip_path: Path | None) -> int:
    """Make a pack ready to share: certificates, par times, difficulties, a list of what is odd, a zip and a link.

    Each level is certified to the exit and with all gold, --seconds each. What is there and still right is not done
    again, so that after a change only its level is searched and measured. The game's screen Packs does the same.

    Exit code 0: nothing is odd; 1: something is; 2: the pack or its index cannot be read.

    \b
    Examples:
      ninja-game levels pack my-pack/
      ninja-game levels pack my-pack/ --seconds 60 --zip shared.zip
    """
    from ninja_game.editor.ready_pack import prepare_pack

    path = zip_path or pack.resolve().with_name(f"{pack.resolve().name}.zip")
    check_output(path)
    with progress_line() as report:
        ready = prepare_pack(pack, seconds=seconds, jobs=jobs, say=lambda text, _: report.say(text))
    write_atomically(path, ready.zipped)
    code = _print_findings(ready.pack, ready.findings)
    click.echo("\n".join([*ready.notes, f"wrote {path}", ready.link]).strip())
    return code


@click.group(commands={"pack": pack_up, "pars": pars, "lint": lint})
def levels() -> None:
    """Make packs of levels ready to share: check, par times, zips and links.

    A pack is a folder or zip with an index, pack.toml.

    \b
    Examples:
      ninja-game levels pack my-pack/
      ninja-game levels lint my-pack/
      ninja-game levels pars my-pack/
    """


@click.command()
@click.option("--seed", type=options.SEED, metavar="N", help="The same seed gives the same level. [default: any]")
@click.option(
    "--difficulty", type=click.IntRange(1, 10), default=4, show_default=True, help="On the scale that the game shows."
)
@options.output_option("The level. [default: a new file in this folder, named after it]", metavar="FILE")
@click.option("--replay", metavar="FILE", type=NEW_FILE, help="Write the certificate too, the solver's run.")
def generate(seed: int | None, difficulty: int, output: Path | None, replay: Path | None) -> int:
    """Make a new level, certified by the solver.

    Seed, difficulty and version of ninja-game make the level, on every machine the same. Every level has been passed
    by the solver, and its difficulty measured as that of the game's own levels. It needs Numba (the extra `fast`).

    Exit code 0: it is written; 1: this seed gives no level that can be passed; 2: bad input.

    \b
    Examples:
      ninja-game generate --seed 7 --difficulty 3 -o seven.txt
      ninja-game generate --difficulty 9 --replay its-run.replay.txt
    """
    from ninja_game.formats.ascii.writer import headers_of, write_ascii_level
    from ninja_game.generator.generate import generate as make_level
    from ninja_game.search.certificate import named_replay, save_replay

    for path in filter(None, (output, replay)):
        check_output(path)
    if output and replay and output.resolve() == replay.resolve():
        raise FileError("level and replay would be one file", str(output), hint="choose another name for one of them")
    seed = SystemRandom().randrange(10**6) if seed is None else seed
    with progress_line() as progress:
        generated = make_level(seed, difficulty, report=progress.say)
    if generated is None:
        click.echo(f"seed {seed} gives no level of difficulty {difficulty} that can be passed; try another one")
        return FAILED
    level = generated.named
    output = output or free_path(Path(), level.name.lower().replace(" ", "-"), ".txt")
    write_atomically(output, write_ascii_level(level.level, **headers_of(level)))
    if replay:
        run = named_replay(generated.run, "generate", name=level.name, author=level.author, level_author=level.author)
        save_replay(replay, run)
    click.echo(
        f"{output}: {level.name}, seed {seed}, difficulty {generated.difficulty:.1f}, "
        f"certified in {time_text(generated.run.end_tick)}"
    )
    return 0
