"""The editor in the window."""
