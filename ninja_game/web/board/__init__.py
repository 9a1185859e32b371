"""The board: runs of a folder, simulated again, ranked, as pages and as a report."""
