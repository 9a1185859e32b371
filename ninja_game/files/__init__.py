"""Files: reading, writing, and where they lie."""
