"""Makes levels by rules of composition, and keeps those that the solver can pass."""
