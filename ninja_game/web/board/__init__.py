"""The board: runs of a folder, simulated again, ranked, written as pages and as a report."""
