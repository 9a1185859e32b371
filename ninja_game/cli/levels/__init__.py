"""Commands about levels."""
