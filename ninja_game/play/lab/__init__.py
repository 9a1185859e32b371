"""The lab: figures in which one drags, paints and watches what the world's own functions do."""
