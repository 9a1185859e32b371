"""Static pages: markup that escapes, the frame of every page, the gallery of levels."""
