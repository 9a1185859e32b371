"""Editing of levels without a window: the document, its operations, files, checks and certificates."""
