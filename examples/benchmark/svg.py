"""Charts as SVG text, as much as the benchmark's plots need."""

import math

FONT = 'font-family="sans-serif" font-size="12"'


class Axis:
    """Maps values to pixels, linearly or by logarithm."""

    def __init__(self, low, high, start, end, log=False):
        self.low, self.high, self.start, self.end, self.log = low, high, start, end, log

    def at(self, value):
        low, high = (math.log(self.low), math.log(self.high)) if self.log else (self.low, self.high)
        value = math.log(max(value, 1e-300)) if self.log else value
        return self.start + (self.end - self.start) * (value - low) / ((high - low) or 1.0)

    def ticks(self):
        """Round values within the axis."""
        if not self.log:
            raw = (self.high - self.low) / 5 or 1.0
            power = 10 ** math.floor(math.log10(raw))
            step = power * next(m for m in (1, 2, 5, 10) if power * m >= raw * 0.999)
            first = math.ceil(self.low / step - 1e-9)
            return [k * step for k in range(first, int(self.high / step + 1e-9) + 1)]
        first, last = math.floor(math.log10(self.low)), math.ceil(math.log10(self.high))
        factors = (1, 2, 5) if last - first <= 3 else (1,)
        values = [f * 10.0**k for k in range(first, last + 1) for f in factors]
        return [v for v in values if self.low * 0.999 <= v <= self.high * 1.001]


def around(values, factor=1.25):
    """Ends of a logarithmic axis that holds the values."""
    values = [v for v in values if v > 0] or [1.0, 10.0]
    return min(values) / factor, max(values) * factor


def short(value):
    """A number for a tick."""
    for size, letter in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if abs(value) >= size:
            return f"{value / size:g}{letter}"
    return f"{value:g}"


class Panel:
    """One pair of axes in a picture."""

    def __init__(self, box, x, y, title="", x_label="", y_label="", x_ticks=None, log=(True, True)):
        left, top, width, height = box
        self.x = Axis(*x, left, left + width, log[0])
        self.y = Axis(*y, top + height, top, log[1])
        self.parts = []
        right, bottom = left + width, top + height
        for value in x_ticks or self.x.ticks():
            px = self.x.at(value)
            self.parts.append(f'<path d="M{px:.1f} {top}V{bottom}" stroke="#ddd"/>')
            self.text(px, bottom + 16, short(value), "middle")
        for value in self.y.ticks():
            py = self.y.at(value)
            self.parts.append(f'<path d="M{left} {py:.1f}H{right}" stroke="#ddd"/>')
            self.text(left - 6, py + 4, short(value), "end")
        self.parts.append(f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#888"/>')
        self.text(left + width / 2, top - 8, title, "middle", bold=True)
        self.text(left + width / 2, bottom + 34, x_label, "middle")
        if y_label:
            x0, y0 = left - 44, top + height / 2
            self.parts.append(
                f'<text x="{x0}" y="{y0}" text-anchor="middle" transform="rotate(-90 {x0} {y0})" {FONT}>{y_label}</text>'
            )

    def text(self, x, y, text, anchor="start", bold=False, colour="#222"):
        weight = ' font-weight="bold"' if bold else ""
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}" {FONT}{weight}>{text}</text>')

    def points_of(self, points):
        return " ".join(f"{self.x.at(x):.1f},{self.y.at(y):.1f}" for x, y in points)

    def line(self, points, colour, dash=""):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(
            f'<polyline points="{self.points_of(points)}" fill="none" stroke="{colour}" stroke-width="2"{dashes}/>'
        )

    def band(self, low, high, colour):
        outline = self.points_of(low + high[::-1])
        self.parts.append(f'<polygon points="{outline}" fill="{colour}" fill-opacity="0.15" stroke="none"/>')

    def dots(self, points, colour, radius=3.5, opacity=1.0):
        for x, y in points:
            self.parts.append(
                f'<circle cx="{self.x.at(x):.1f}" cy="{self.y.at(y):.1f}" r="{radius}" fill="{colour}" fill-opacity="{opacity}"/>'
            )

    def bars(self, edges, heights, colour):
        base = self.y.start
        for low, high, height in zip(edges, edges[1:], heights):
            top, left = self.y.at(height), self.x.at(low)
            if base - top > 0.05:
                width = max(0.5, self.x.at(high) - left)
                self.parts.append(
                    f'<rect x="{left:.1f}" y="{top:.1f}" width="{width:.1f}" height="{base - top:.1f}" fill="{colour}"/>'
                )

    def legend(self, entries, x, y):
        """Lines of text with a coloured square each, from a point given in pixels."""
        for row, (colour, text) in enumerate(entries):
            py = y + 17 * row
            self.parts.append(f'<rect x="{x}" y="{py - 9}" width="10" height="10" fill="{colour}"/>')
            self.text(x + 15, py, text)


def picture(width, height, panels):
    """The file's text."""
    body = "\n".join(part for panel in panels for part in panel.parts)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">\n'
        f'<rect width="{width}" height="{height}" fill="white"/>\n{body}\n</svg>\n'
    )
