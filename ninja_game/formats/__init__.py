"""Text in and out: ASCII levels, N level strings and level files, demos, replays."""
