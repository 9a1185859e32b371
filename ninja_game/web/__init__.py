"""The game in a browser: its site, and what runs in the page."""
