"""The pages of a board, of runs that ``ninja_game.board`` has judged and ranked."""
