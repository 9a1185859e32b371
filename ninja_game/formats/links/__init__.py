"""Links that carry everything: a level, a pack or replays as compressed text behind the # of an address."""
