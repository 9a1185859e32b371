"""The ninja's figure: poses, animation, ragdoll."""
