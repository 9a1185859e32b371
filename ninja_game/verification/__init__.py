"""Archives of recordings of any size, verified and traced by many processes."""
