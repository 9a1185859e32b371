"""The front end: a window that shows the world, plays its sounds and reads the player's inputs."""
