"""The text formats of N v1.4: level strings, level files, demos."""
