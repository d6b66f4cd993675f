"""A drawing of a plane scene as SVG, for the examples in Python: metres in, y up."""
COLOURS = {"robot": "#0067a8", "obstacle": "#b84700", "wall": "#6b7683", "quiet": "#76818d", "limit": "#b3161f"}


class Picture:
    def __init__(self, low, high):
        self.low, self.high, self.scale = low, high, 720 / (high[0] - low[0])
        self.elements = []

    def place(self, point):
        return f"{(point[0] - self.low[0]) * self.scale:.1f},{(self.high[1] - point[1]) * self.scale:.1f}"

    def disc(self, centre, radius, colour, opacity=0.5):
        self.ellipse(centre, (radius, radius), 0, colour, opacity)

    def ellipse(self, centre, half_axes, heading, colour, opacity):
        self.elements.append(
            f"<ellipse rx='{half_axes[0] * self.scale:.1f}' ry='{half_axes[1] * self.scale:.1f}' "
            f"transform='translate({self.place(centre)}) rotate({-heading * 57.29578:.1f})' fill='{COLOURS[colour]}' "
            f"fill-opacity='{opacity:.2f}' stroke='{COLOURS[colour]}'/>")

    def area(self, corners, colour, opacity=0.35):
        points = " ".join(map(self.place, corners))
        self.elements.append(f"<polygon points='{points}' fill='{COLOURS[colour]}' fill-opacity='{opacity}'/>")

    def line(self, points, colour, width=2):
        points = " ".join(map(self.place, points))
        self.elements.append(f"<polyline points='{points}' fill='none' stroke='{COLOURS[colour]}' stroke-width='{width}'/>")

    def text(self, at, words):
        x, y = self.place(at).split(",")
        self.elements.append(f"<text x='{x}' y='{y}' font-family='sans-serif' font-size='14' fill='#18212b'>{words}</text>")

    def save(self, file):
        height = (self.high[1] - self.low[1]) * self.scale
        with open(file, "w", encoding="utf-8") as out:
            out.write(f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 720 {height:.1f}' role='img'>\n"
                      "<rect width='100%' height='100%' fill='#ffffff'/>\n" + "\n".join(self.elements) + "\n</svg>\n")
