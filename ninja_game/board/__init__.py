"""The board: simulates the runs of a folder, marks copies, ranks the rest; the result as data and as a report."""
