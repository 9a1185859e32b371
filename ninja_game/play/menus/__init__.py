"""The menus: every screen that is not a level being played or watched."""
