"""What the level editor and the TAS editor share in the window: a document with its commands, and parts around it."""
