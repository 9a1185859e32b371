"""From keys and gamepad buttons to actions, as the player has bound them."""
