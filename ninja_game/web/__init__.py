"""The game in a browser: its site, the code of its page, and the pages of boards."""
