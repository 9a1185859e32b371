"""Readers and writers of text: ASCII levels, N level strings and level files, demos, replays."""
