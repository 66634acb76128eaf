"""An SVG picture. The same calls give the same bytes."""

from xml.sax.saxutils import escape

INK = "#1f2933"
GREY = "#9aa5b1"
BLUE = "#1d6fb8"
SKY = "#bcdcf5"
ORANGE = "#d9660a"
PEACH = "#fbd9b5"
GREEN = "#2f855a"
RED = "#c53030"


def number(value):
    """A coordinate to a tenth of a pixel."""
    text = f"{value:.1f}"
    return text[:-2] if text.endswith(".0") else text


def attributes(style):
    return "".join(f' {name.replace("_", "-")}="{value}"' for name, value in style.items())


def points(pairs):
    return " ".join(f"{number(x)},{number(y)}" for x, y in pairs)


class Picture:
    """Coordinates are pixels from the upper left corner. Styles are SVG attributes, with _ for -."""

    def __init__(self, width, height, title):
        self.lines = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}"'
            f' font-family="sans-serif" font-size="14" fill="{INK}">\n<title>{escape(title)}</title>\n'
            '<defs><marker id="tip" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="10" markerHeight="10"'
            f' markerUnits="userSpaceOnUse" orient="auto"><path d="M0 0 10 5 0 10z" fill="{INK}"/></marker></defs>\n'
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>'
        ]

    def _add(self, line):
        self.lines.append(line)

    def segments(self, pairs, **style):
        """Straight lines, each from one point to another, as one element."""
        data = "".join(f"M{number(ax)} {number(ay)} {number(bx)} {number(by)}" for (ax, ay), (bx, by) in pairs)
        self._add(f'<path d="{data}" fill="none"{attributes(style)}/>')

    def boxes(self, corners, **style):
        """Upright rectangles (left, top, right, bottom), as one element."""
        data = "".join(
            f"M{number(left)} {number(top)}H{number(right)}V{number(bottom)}H{number(left)}z"
            for left, top, right, bottom in corners
        )
        self._add(f'<path d="{data}"{attributes(style)}/>')

    def polygon(self, pairs, **style):
        self._add(f'<polygon points="{points(pairs)}"{attributes(style)}/>')

    def polyline(self, pairs, **style):
        self._add(f'<polyline points="{points(pairs)}" fill="none"{attributes(style)}/>')

    def dots(self, pairs, radius, **style):
        circles = "".join(f'<circle cx="{number(x)}" cy="{number(y)}" r="{number(radius)}"/>' for x, y in pairs)
        self._add(f"<g{attributes(style)}>{circles}</g>")

    def arrow(self, start, end, **style):
        self.segments([(start, end)], **{"stroke": INK, "stroke_width": 1.3, "marker_end": "url(#tip)", **style})

    def text(self, x, y, *rows, **style):
        """Rows of text, one below the other."""
        for i, row in enumerate(rows):
            self._add(f'<text x="{number(x)}" y="{number(y + 18 * i)}"{attributes(style)}>{escape(row)}</text>')

    def finish(self):
        return "\n".join([*self.lines, "</svg>", ""])
