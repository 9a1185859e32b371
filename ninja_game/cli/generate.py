"""`ninja-game generate`: a new level by rules of composition, certified by the solver."""

from __future__ import annotations

from pathlib import Path
from random import SystemRandom

import click

from ninja_game.cli import solver_options as options
from ninja_game.files.user_folder import free_path


@click.command()
@click.option(
    "--seed", type=click.IntRange(0, 10**9), metavar="N", help="The same seed gives the same level. [default: any]"
)
@click.option(
    "--difficulty", type=click.IntRange(1, 10), default=4, show_default=True, metavar="D",
    help="Difficulty, 1 to 10, on the scale that the game shows.",
)  # fmt: skip
@click.option(
    "-o", "--output", metavar="FILE", type=click.Path(dir_okay=False, path_type=Path),
    help="Where to write the level. [default: a new file in the current folder, named after the level]",
)  # fmt: skip
@click.option(
    "--replay", metavar="FILE", type=click.Path(dir_okay=False, path_type=Path),
    help="Write the certificate too, the solver's run to the exit.",
)  # fmt: skip
@click.pass_context
def generate(
    ctx: click.Context, /, seed: int | None, difficulty: int, output: Path | None, replay: Path | None
) -> None:
    """Make a new level, certified by the solver.

    Seed, difficulty and version of ninja-game make the level, on every machine the same. Every level has been passed
    by the solver, and its difficulty measured as that of the game's own levels. It needs Numba (the extra `fast`).

    Exit code 0: it is written; 1: this seed gives no level that can be passed; 2: bad input.

    \b
    Examples:
      ninja-game generate --seed 7 --difficulty 3 -o seven.txt
      ninja-game generate --difficulty 9 --replay its-run.replay.txt
    """
    from ninja_game.errors import FileError
    from ninja_game.files.writing import check_output, write_atomically
    from ninja_game.generator.generate import generate
    from ninja_game.search.certificate import named_run, save_replay

    for path in filter(None, (output, replay)):
        check_output(path)
    if output and replay and output.resolve() == replay.resolve():
        raise FileError("level and replay would be one file", str(output), hint="choose another name for one of them")
    seed = SystemRandom().randrange(10**6) if seed is None else seed
    with options.progress_line() as progress:
        made = generate(seed, difficulty, report=progress.say)
    if made is None:
        click.echo(f"seed {seed} gives no level of difficulty {difficulty} that can be passed; try another one")
        ctx.exit(options.NOT_FOUND)
    output = output or free_path(Path(), made.name.lower().replace(" ", "-"), ".txt")
    write_atomically(output, made.text)
    if replay:
        run = named_run(made.run, "generate", name=made.name, author=made.author, level_author=made.author)
        save_replay(replay, run)
    click.echo(
        f"{output}: {made.name}, seed {seed}, difficulty {made.difficulty:.1f}, "
        f"certified in {options.time_text(made.run.end_tick)}"
    )
