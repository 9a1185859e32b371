"""The figures: one module each, but for those about cells."""
