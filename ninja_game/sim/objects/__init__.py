"""One file per kind: its rules at load, in updates, in thinks, and when the ninja touches it."""
