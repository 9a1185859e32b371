"""The command line: related commands in one file, heavy imports inside the commands."""
