"""Write docs/settings.md from the rules of the settings. Run it after a change of them."""

from __future__ import annotations

from ninja_game.player.settings import BINDING_TABLES, RULES, Settings, key_of
from tools import ROOT

PAGE = ROOT / "docs" / "settings.md"
HEAD = """# Settings

`settings.toml` lies in the player's folder ([Player data](player-data.md)). The screens of the game change it; edit it
by hand if you like: comments stay, and what is missing or wrong has its default. This page is written by
`python3 tools/dev.py docs`.

| table | key | meaning | values | default |
|---|---|---|---|---|
"""


def page() -> str:
    """The page with a row for each setting."""
    rows = []
    for name, rule in RULES.items():
        key = "*action*" if name in BINDING_TABLES else f"`{key_of(name)}`"
        table = BINDING_TABLES.get(name, rule.table)
        default = getattr(Settings(), name)
        shown = (
            str(default).lower() if isinstance(default, bool) else repr(default) if default != {} else "see the game"
        )
        rows.append(f"| `[{table}]` | {key} | {rule.meaning} | {rule.expected} | {shown} |\n")
    return HEAD + "".join(rows)


if __name__ == "__main__":
    PAGE.write_text(page(), "utf-8")
