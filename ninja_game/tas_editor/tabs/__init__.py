"""The tabs below the level: watched values, branches, the lead over another run, searches."""
