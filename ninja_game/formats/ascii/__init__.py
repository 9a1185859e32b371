"""The readable text format of levels."""
