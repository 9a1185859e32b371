"""Draw the pictures of docs/ that explain, from the rules and the figures of the lab, and write docs/settings.md."""

from pathlib import Path
from xml.sax.saxutils import escape

from ninja_game.cli import windows
from ninja_game.formats.ascii.legend import TILE_FAMILIES, TILE_OF_CHAR
from ninja_game.play.lab.screen import export_figure
from ninja_game.player.settings import BINDING_TABLES, SPECS, Settings, setting_key
from ninja_game.view.sprites.tile_sheet import outline
from tools import ROOT

SETTINGS, PICTURES = ROOT / "docs" / "settings.md", ROOT / "docs" / "pictures"
SETTINGS_HEAD = """# Settings

`settings.toml` lies in the player's folder ([Player data](player-data.md)). The screens of the game change it; edit it
by hand if you like: comments stay, and what is missing or wrong has its default. This page is written by
`python3 tools/dev.py docs`.

| table | key | meaning | values | default |
|---|---|---|---|---|
"""
CLASSES = ("45°", "concave", "convex", "22° thin", "22° thick", "67° thin", "67° thick", "half")

FIGURES = [f"{name}.{'gif' if name in {'pairs', 'tick'} else 'png'}" for name in windows.FIGURE_NAMES]
"""Figures of the lab, and films of them."""

Point = tuple[float, float]
INK, PAPER, SOLID, FAINT, BLUE = "#333333", "#f4f4f6", "#797988", "#c4c4ce", "#2266aa"
SANS = "Verdana, DejaVu Sans, sans-serif"


class Picture:
    """An SVG picture that grows shape by shape; px, y downwards."""

    def __init__(self, width: float, height: float) -> None:
        self.size = (width, height)
        self.parts: list[str] = []
        self.box(0, 0, width, height, PAPER)

    def box(self, x: float, y: float, width: float, height: float, fill: str, stroke: str = "none") -> None:
        self.parts.append(
            f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" fill="{fill}" stroke="{stroke}"/>'
        )

    def polygon(self, points: list[Point], fill: str) -> None:
        """A filled polygon."""
        corners = " ".join(f"{x:.2f},{y:.2f}" for x, y in points)
        self.parts.append(f'<polygon points="{corners}" fill="{fill}"/>')

    def text(
        self, words: str, at: Point, size: float = 12, colour: str = INK, anchor: str = "middle", font: str = SANS
    ) -> None:
        """A line of text, ``at`` its baseline."""
        self.parts.append(
            f'<text x="{at[0]:.2f}" y="{at[1]:.2f}" font-size="{size:g}" fill="{colour}" text-anchor="{anchor}" '
            f'font-family="{font}">{escape(words)}</text>'
        )

    def save(self, path: Path) -> None:
        width, height = self.size
        box = f'viewBox="0 0 {width:g} {height:g}" width="{width:g}" height="{height:g}"'
        head = f'<svg xmlns="http://www.w3.org/2000/svg" {box}>'
        path.write_text("\n".join([head, *self.parts, "</svg>"]) + "\n", encoding="utf-8")


def draw_tile(picture: Picture, tile: int, centre: Point, zoom: float) -> None:
    corners = [(centre[0] + x * zoom, centre[1] + y * zoom) for x, y in outline(tile)]
    if corners:
        picture.polygon(corners, SOLID)


def draw_shapes() -> Picture:
    """All 34 shapes with their ids: a row for each orientation k."""
    picture = Picture(760, 340)
    picture.text("k", (20, 28), 12)
    for column, name in enumerate(CLASSES):
        picture.text(name, (90 + 84 * column, 28), 12)
        for k in range(4):
            centre = (90.0 + 84 * column, 76.0 + 72 * k)
            picture.box(centre[0] - 24, centre[1] - 24, 48, 48, "#ffffff", FAINT)
            draw_tile(picture, 2 + 4 * column + k, centre, 2)
            picture.text(str(2 + 4 * column + k), (centre[0] + 34, centre[1] + 5), 11, BLUE)
    for k in range(4):
        picture.text(str(k), (20, 80 + 72 * k), 12)
    return picture


TICK = (
    ("world.py", "step: the whole tick", ""),
    ("objects/dispatch.py", "1. update_objects: newest first", "objects/*.py"),
    ("objects/dispatch.py", "2. think: one object every fourth tick", "objects/*.py → collision/rays.py"),
    ("ninja/tick.py", "3. integrate, look up the cell", "grid.py"),
    ("objects/dispatch.py", "4. touch_objects: nine cells", "objects/*.py → ninja/contact_response.py, death.py"),
    ("collision/circle.py", "5. collide_circle: at most four cells", "circle_own_tile.py, circle_neighbours.py"),
    ("ninja/tick.py", "6. evaluate_floor, probe_walls", "collision/rays.py (solid_at)"),
    ("ninja/control.py", "7. think_in_air, think_on_ground", "keys, states, jumps"),
)
"""File, what it does there, and the files that it calls; under ninja_game/sim."""


def draw_tick() -> Picture:
    """The way of one tick through the files."""
    picture = Picture(760, 36 + 44 * len(TICK))
    for number, (file, what, calls) in enumerate(TICK):
        y = 20 + 44 * number
        picture.box(20, y, 190, 30, "#ffffff", SOLID)
        picture.text(file, (115, y + 20), 12, BLUE)
        picture.text(what, (230, y + 20), 12, INK, "start")
        picture.text(calls, (480, y + 20), 11, SOLID, "start")
        if number + 1 < len(TICK):
            picture.box(114.25, y + 31, 1.5, 6, SOLID)
            picture.polygon([(115, y + 43), (111.5, y + 36), (118.5, y + 36)], SOLID)
    return picture


def draw_legend() -> Picture:
    """The 34 tile shapes, each over its character, a family a row."""
    rows = [("empty, full", ".#"), ("half tiles", '_"[]'), *TILE_FAMILIES]
    picture = Picture(456, 20 + 66 * len(rows))
    for row, (name, characters) in enumerate(rows):
        picture.text(name, (12, 36 + 66 * row), 14, anchor="start")
        for column, character in enumerate(characters):
            x, y = 208 + 64 * column, 32 + 66 * row
            draw_tile(picture, TILE_OF_CHAR[character], (x, y), 1.5)
            picture.box(x - 18, y - 18, 36, 36, "none", FAINT)
            picture.text(character, (x, y + 36), 16, font="monospace")
    return picture


VECTORS = {"shapes.svg": draw_shapes, "tick.svg": draw_tick, "tiles.svg": draw_legend}


def settings_page() -> str:
    """docs/settings.md, a row for each setting."""
    rows = []
    for name, spec in SPECS.items():
        key = "*action*" if name in BINDING_TABLES else f"`{setting_key(name)}`"
        table = BINDING_TABLES.get(name, spec.table)
        default = getattr(Settings(), name)
        shown = (
            str(default).lower() if isinstance(default, bool) else repr(default) if default != {} else "see the game"
        )
        rows.append(f"| `[{table}]` | {key} | {spec.meaning} | {spec.expected} | {shown} |\n")
    return SETTINGS_HEAD + "".join(rows)


if __name__ == "__main__":
    SETTINGS.write_text(settings_page(), "utf-8")
    PICTURES.mkdir(exist_ok=True)
    for name, draw in VECTORS.items():
        draw().save(PICTURES / name)
    for file in FIGURES:
        export_figure(file.partition(".")[0], PICTURES / f"lab-{file}")
    print(f"drew {len(VECTORS) + len(FIGURES)} pictures into docs/pictures")
