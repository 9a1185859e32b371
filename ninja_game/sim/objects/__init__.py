"""One file a kind: what it does at load, in its updates and thinks, and when the ninja touches it."""
