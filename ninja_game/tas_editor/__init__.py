"""The TAS editor: a run tick by tick beside its level, to edit, to play on by hand, to search and to compare."""
