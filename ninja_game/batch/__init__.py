"""Many worlds in one block of memory, stepped together."""
