"""A few lines of SVG: shapes in px, y downwards, for the pictures of docs/."""

from __future__ import annotations

from pathlib import Path
from xml.sax.saxutils import escape

Point = tuple[float, float]

INK, PAPER, SOLID, FAINT = "#333333", "#f4f4f6", "#797988", "#c4c4ce"
SANS = "Verdana, DejaVu Sans, sans-serif"
RED, BLUE, GREEN, GOLD = "#aa2222", "#2266aa", "#2f7d3a", "#b98a00"


class Picture:
    """An SVG picture that grows shape by shape."""

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

    def line(self, start: Point, end: Point, colour: str = INK, width: float = 1, dash: str = "") -> None:
        """A line, dashed if ``dash`` says how."""
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(
            f'<line x1="{start[0]:.2f}" y1="{start[1]:.2f}" x2="{end[0]:.2f}" y2="{end[1]:.2f}" '
            f'stroke="{colour}" stroke-width="{width:g}" stroke-linecap="round"{dashed}/>'
        )

    def circle(self, centre: Point, radius: float, fill: str = "none", stroke: str = INK, width: float = 1) -> None:
        self.parts.append(
            f'<circle cx="{centre[0]:.2f}" cy="{centre[1]:.2f}" r="{radius:g}" '
            f'fill="{fill}" stroke="{stroke}" stroke-width="{width:g}"/>'
        )

    def text(
        self, words: str, at: Point, size: float = 12, colour: str = INK, anchor: str = "middle", font: str = SANS
    ) -> None:
        """A line of text, ``at`` its baseline."""
        self.parts.append(
            f'<text x="{at[0]:.2f}" y="{at[1]:.2f}" font-size="{size:g}" fill="{colour}" text-anchor="{anchor}" '
            f'font-family="{font}">{escape(words)}</text>'
        )

    def arrow(self, start: Point, end: Point, colour: str = INK, width: float = 1.5) -> None:
        """A line with a head."""
        self.line(start, end, colour, width)
        dx, dy = end[0] - start[0], end[1] - start[1]
        length = (dx * dx + dy * dy) ** 0.5 or 1.0
        ux, uy = dx / length * 7, dy / length * 7
        left = (end[0] - ux - uy * 0.5, end[1] - uy + ux * 0.5)
        right = (end[0] - ux + uy * 0.5, end[1] - uy - ux * 0.5)
        self.polygon([end, left, right], colour)

    def svg(self) -> str:
        width, height = self.size
        box = f'viewBox="0 0 {width:g} {height:g}" width="{width:g}" height="{height:g}"'
        head = f'<svg xmlns="http://www.w3.org/2000/svg" {box}>'
        return "\n".join([head, *self.parts, "</svg>"]) + "\n"

    def save(self, path: Path) -> None:
        path.write_text(self.svg(), encoding="utf-8")
