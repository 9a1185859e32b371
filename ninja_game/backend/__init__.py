"""The memories that worlds are held in, and what compiles for them: chosen, opened, proven, kept on disk."""
