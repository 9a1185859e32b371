"""The base of every screen: canvas, colours, letters, widgets."""
