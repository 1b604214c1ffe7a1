# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of a benchmark: time and memory against the size of the scan, both axes logarithmic."""
import math

WIDTH, HEIGHT, LEFT, TOP, BOTTOM, GAP = 420, 320, 60, 30, 45, 70
COLOURS = ["#1b6ca8", "#c8553d", "#4d8b31", "#7b4ea3", "#a8862b"]


class Panel:
    """One diagram: lines of (x, y), logarithmic on both axes, decades as a grid."""

    def __init__(self, left, title, lines):
        self.left, self.title = left, title
        self.lines = {name: [(x, y) for x, y in points if x > 0 and y > 0] for name, points in lines.items() if points}
        xs = [x for points in self.lines.values() for x, _ in points]
        ys = [y for points in self.lines.values() for _, y in points]
        self.x = math.floor(math.log10(min(xs))), math.ceil(math.log10(max(xs)) + 1e-9)
        self.y = math.floor(math.log10(min(ys))), math.ceil(math.log10(max(ys)) + 1e-9)

    def place(self, x, y):
        def share(value, low, high):
            return (math.log10(value) - low) / max(1, high - low)
        return self.left + WIDTH * share(x, *self.x), TOP + HEIGHT * (1 - share(y, *self.y))

    def grid(self):
        for power in range(self.x[0], self.x[1] + 1):
            x, y = self.place(10 ** power, 10 ** self.y[0])
            yield f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{y:.1f}" stroke="#ddd"/>'
            yield f'<text x="{x:.1f}" y="{y + 18:.1f}" text-anchor="middle">{10.0 ** power:g}</text>'
        for power in range(self.y[0], self.y[1] + 1):
            x, y = self.place(10 ** self.x[0], 10 ** power)
            yield f'<line x1="{x:.1f}" y1="{y:.1f}" x2="{x + WIDTH}" y2="{y:.1f}" stroke="#ddd"/>'
            yield f'<text x="{x - 6:.1f}" y="{y + 4:.1f}" text-anchor="end">{10.0 ** power:g}</text>'

    def svg(self):
        yield f'<text x="{self.left}" y="{TOP - 10}" font-weight="bold">{self.title}</text>'
        yield from self.grid()
        yield f'<text x="{self.left + WIDTH / 2}" y="{TOP + HEIGHT + 36}" text-anchor="middle">million points</text>'
        for number, (name, points) in enumerate(self.lines.items()):
            colour = COLOURS[number % len(COLOURS)]
            placed = [self.place(*point) for point in points]
            yield f'<polyline fill="none" stroke="{colour}" stroke-width="2" points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in placed)}"/>'
            yield from (f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in placed)
            yield f'<text x="{self.left + 8}" y="{TOP + 16 + 16 * number}" fill="{colour}">{name}</text>'


def plot(result):
    seconds, memory = {}, {}
    for series in ("dense", "grown"):
        cases = result.get(series, [])
        if cases:
            seconds[f"make run, {series}"] = [(c["points_m"], c["run"]["cpu_s"]) for c in cases]
            memory[f"largest stage, {series}"] = [(c["points_m"], max(r["peak_memory_mb"] for r in c["stages"].values())) for c in cases]
            memory[f"all but ingest, {series}"] = [(c["points_m"], max(r["peak_memory_mb"] for s, r in c["stages"].items() if s != "ingest"))
                                                   for c in cases]
    cases = result.get("dense") or result.get("grown") or []
    seconds["kd-tree normals"] = [(c["points_m"], c["yardsticks"]["kd_normals_s"]) for c in cases if "kd_normals_s" in c["yardsticks"]]
    seconds["CGAL reads"] = [(c["points_m"], c["yardsticks"]["cgal_read_s"]) for c in cases if "cgal_read_s" in c["yardsticks"]]
    size = LEFT + 2 * WIDTH + GAP + 20, TOP + HEIGHT + BOTTOM
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{size[0]}" height="{size[1]}" font-family="sans-serif" font-size="12">',
             '<rect width="100%" height="100%" fill="white"/>']
    if cases:
        parts += Panel(LEFT, "processor seconds", seconds).svg()
        parts += Panel(LEFT + WIDTH + GAP, "peak memory, MB", memory).svg()
    return "\n".join(parts + ["</svg>", ""])
