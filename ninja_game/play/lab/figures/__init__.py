"""The figures: a module for each, or for some that show the same."""
