"""`ninja-game`: the list of commands, and the handling of errors.

Commands are loaded when they are named and import what they need when they run, so that `--help` comes at once.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from difflib import get_close_matches
from importlib import import_module
from typing import Any, NoReturn

import click

from ninja_game import __version__
from ninja_game.backend.numba_import import remove_foreign_settings
from ninja_game.cli.commands import BAD_INPUT, BROKEN_PIPE, COMMANDS, GROUPS, INTERNAL_ERROR, INTERRUPTED, TERMINATED
from ninja_game.cli.terminal import guard_terminal, print_error, say
from ninja_game.errors import NinjaGameError
from ninja_game.files.reading import protect_inputs
from ninja_game.signals import Terminated, announced, end_on_signals, leave_signals, raising, received


class CommandGroup(click.Group):
    """A group that imports a command when it is needed, and turns expected errors into one line and an exit code."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        command = getattr(import_module(f"ninja_game.cli.{COMMANDS[cmd_name].module}"), cmd_name)
        assert isinstance(command, click.Command)  # noqa: S101 - for the type checker
        if COMMANDS[cmd_name].compiles:
            _announce_compiling()
        raising.set()
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The named command; a usage error for an unknown one suggests the nearest."""
        near = get_close_matches(args[0], COMMANDS, 1) if args and args[0] not in COMMANDS else []
        if near:
            ctx.fail(f"No such command {args[0]!r}; did you mean '{near[0]}'?")
        resolved = super().resolve_command(ctx, args)
        command = COMMANDS.get(resolved[0] or "")
        protect_inputs(not (command and command.in_place))
        return resolved

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        width = max(map(len, COMMANDS))
        for title, group in GROUPS.items():
            with formatter.section(title.capitalize()):
                formatter.write_dl([(name.ljust(width), command.help) for name, command in group.items()])

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; a closed output is not an error."""
        try:
            code = super().invoke(ctx)
            sys.stdout.flush()
        except (BrokenPipeError, SystemExit) as error:
            # Rich, which draws tables, exits with 1 where the reader of the output was closed.
            if not isinstance(error, BrokenPipeError) and not isinstance(error.__context__, BrokenPipeError):
                raise
            # Python's flush at exit must not fail again.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return BROKEN_PIPE
        except KeyboardInterrupt as error:
            # click would write an empty line for one.
            raise click.Abort from error
        finally:
            protect_inputs(False)
        return code

    def main(self, args: Sequence[str] | None = None, *more: Any, **named: Any) -> NoReturn:
        """Run, then leave with an exit code; errors of the caller are a line on stderr."""
        named["standalone_mode"] = False
        failed: BaseException | None = None
        code: Any = None
        try:
            try:
                code = super().main(args, *more, **named)
            finally:
                raising.clear()
        except SystemExit as error:
            code = error.code
        except BaseException as error:  # noqa: BLE001 - nothing may end like a run that failed
            failed = error
        sys.exit(_stopped(failed) or (_failed(failed) if failed else code))


def _stopped(error: BaseException | None) -> int:
    """Report that a signal stopped the command; its exit code, 0 without a signal.

    Python wraps one that arrives while a class is made in another error, and some libraries swallow it.
    """
    while error and not isinstance(error, (click.Abort, KeyboardInterrupt, Terminated)):
        error = error.__cause__ or error.__context__
    error = next(iter(received), error)
    if not error:
        return 0
    announced.set()
    print_error("terminated" if isinstance(error, Terminated) else "interrupted")
    return TERMINATED if isinstance(error, Terminated) else INTERRUPTED


def _failed(error: BaseException) -> int:
    match error:
        case click.exceptions.NoArgsIsHelpError():
            say(error.format_message())
        case click.ClickException():
            print_error(error.format_message())
            if isinstance(error, click.UsageError) and error.ctx:
                say(f"Try '{error.ctx.command_path} --help'.")
        case NinjaGameError():
            print_error(str(error))
        case MemoryError():
            print_error("not enough memory for that")
        case OSError():
            print_error(f"{error.filename}: {error.strerror}" if error.filename else str(error))
        case _:
            import traceback

            say("".join(traceback.format_exception(error)).rstrip())
            print_error("this is a fault of ninja-game, not of your input; please report it with the lines above")
            return INTERNAL_ERROR
    return BAD_INPUT


@click.command(cls=CommandGroup, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="ninja-game", message="%(prog)s %(version)s")
def cli() -> None:
    """Play N-style levels, and verify, trace, convert and measure them.

    \b
    Examples:
      ninja-game play
      ninja-game info 00-0-first-steps
      ninja-game convert level.nlevel level.txt
    """


def main() -> NoReturn:
    """The program `ninja-game`."""
    guard_terminal()
    end_on_signals()
    if sys.argv[1:]:
        # A shell that asks for completions passes no arguments to the program.
        os.environ.pop("_NINJA_GAME_COMPLETE", None)
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    # We multiply no matrices; with little memory the threads of the BLAS library would wait for ever.
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    # They may make NumPy fail, which some commands import before Numba is set up.
    remove_foreign_settings()
    try:
        cli.main(prog_name="ninja-game")
    finally:
        # An interrupt within a text run by `exec` makes `python -m` end by the signal, whatever its exit code:
        # the next text run makes Python forget it.
        exec("")  # noqa: S102
        leave_signals()


def _announce_compiling() -> None:
    """Announce that rules are compiled first, since that takes a while; compile all others in the background."""
    from ninja_game.backend.background_compiler import start
    from ninja_game.backend.kernel_cache import before_compiling

    text = "ninja-game: compiling the rules for this machine, the first time only; it takes a minute or two"
    before_compiling[:] = [lambda: click.echo(text, err=True), start]
