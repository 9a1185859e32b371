"""The help: pages with demonstrations, and the table of keys."""
