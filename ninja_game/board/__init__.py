"""The board: the runs of a folder, simulated again, told from copies, ranked, as data and as a report."""
