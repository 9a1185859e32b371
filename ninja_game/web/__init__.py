"""The game in a browser: its site, and the code of the page."""
