"""The lab: figures to drag and paint in, computed by the world's own functions."""
