"""Drawing of the world: tiles, things, the ninja, particles. Everything here only reads the world."""
