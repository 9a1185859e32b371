"""One file per kind: what it does at load, in its updates and thinks, and when the ninja touches it."""
