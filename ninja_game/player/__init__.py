"""A player's data: attempts, records, progress, settings.

``play`` shows them in its window; commands, pages and tests read them without one.
"""
