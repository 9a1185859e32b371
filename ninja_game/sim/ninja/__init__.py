"""The ninja's tick: keys, states, jumps, and what contacts do to him."""
