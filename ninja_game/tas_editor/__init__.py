"""The TAS editor: a run tick by tick beside its level, to be edited, taken over, searched and compared."""
