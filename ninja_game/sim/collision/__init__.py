"""The ninja's body against the tiles, and rays through the grid."""
