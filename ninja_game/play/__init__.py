"""The front end: a window in which the world is seen, heard and played. Nothing here changes a world but its inputs."""
