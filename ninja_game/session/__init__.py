"""What is above one world: runs that are verified, traced and compared."""
