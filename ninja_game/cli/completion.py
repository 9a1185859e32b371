"""`ninja-game completion`: the shell's part of completion, made by click."""

from __future__ import annotations

import click

STARTUP_FILES = {
    "bash": ("~/.bashrc", 'eval "$(ninja-game completion bash)"'),
    "zsh": ("~/.zshrc", 'eval "$(ninja-game completion zsh)"'),
    "fish": ("~/.config/fish/config.fish", "ninja-game completion fish | source"),
}
"""The file that a shell reads at its start, and the line to add there."""


@click.command()
@click.argument("shell", type=click.Choice(list(STARTUP_FILES)), required=False)
@click.pass_context
def command(ctx: click.Context, shell: str | None) -> None:
    """Set up completion of commands and options in your shell.

    Without SHELL, tells which line to add to which file; with it, prints the script that such a line runs.

    \b
    Examples:
      ninja-game completion
      eval "$(ninja-game completion bash)"
    """
    if shell is None:
        for name, (file, line) in STARTUP_FILES.items():
            click.echo(f"{name}: add this line to {file} and start a new shell:\n  {line}")
        return

    from click.shell_completion import get_completion_class

    kind = get_completion_class(shell)
    if kind is None:
        raise click.UsageError(f"no completion for {shell}")
    # Not `source()`: it starts the shell to ask for its version, and the shell may be elsewhere.
    script = kind(ctx.find_root().command, {}, "ninja-game", "_NINJA_GAME_COMPLETE")
    click.echo(script.source_template % script.source_vars())
