"""What every screen is drawn with: canvas, colours, letters, widgets."""
