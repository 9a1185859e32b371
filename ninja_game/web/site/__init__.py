"""The game as a folder of files that any static host serves: `ninja-game site`."""
