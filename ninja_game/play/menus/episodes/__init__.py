"""Episodes: the grid, and what passing one has brought."""
