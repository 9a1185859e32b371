"""Screens that open over a level as well as over a menu: help, settings, replays."""
