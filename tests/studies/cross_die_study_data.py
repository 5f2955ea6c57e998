"""Reading a run of the cross-die study: history, means over travel, fields on the blank by tool zone."""
import base64
import csv
import math
import re
import struct
import zlib

DIE_SIDE, PUNCH_SIDE = "die", "punch"


def table(file):
    with open(file) as stream:
        return list(csv.DictReader(stream))


def history(folder):
    return [{k: float(v) for k, v in row.items()} for row in table(folder / "history.csv")]


def results(folder):
    return {row["quantity"]: float(row["value"]) for row in table(folder / "results.csv")}


def mean(rows, column, low, high):
    """Mean over punch travel from low to high [mm], by the trapezoidal rule with interpolated ends."""
    points = [(r["punch_travel_mm"], r[column]) for r in rows]
    points = [p for k, p in enumerate(points) if k == 0 or p[0] > points[k - 1][0]]
    if points[0][0] > low:
        points.insert(0, (low, points[0][1]))

    def at(travel):
        for (a, fa), (b, fb) in zip(points, points[1:]):
            if a <= travel <= b:
                return fa + (fb - fa) * (travel - a) / (b - a)
        return points[-1][1]

    inside = [(low, at(low))] + [p for p in points if low < p[0] < high] + [(high, at(high))]
    return sum(0.5 * (b - a) * (fa + fb) for (a, fa), (b, fb) in zip(inside, inside[1:])) / (high - low)


class Fields:
    """One step of solution.pvd. Node values are those of the corners of the triangles; `node` names the corner that stands
    for each node."""

    def __init__(self, file):
        data = file.read_bytes()
        self.time = float(re.search(rb'Name="TIME"[^>]*>([^<]*)<', data).group(1))
        self.values = {}
        for found in re.finditer(rb'<DataArray type="(\w+)"([^>]*)format="binary"[^>]*>\s*([^<]*)<', data):
            name = re.search(rb'Name="([^"]*)"', found.group(2))
            width = re.search(rb'NumberOfComponents="(\d+)"', found.group(2))
            if found.group(1) != b"Float32":
                continue
            numbers = self.decode(found.group(3))
            n = int(width.group(1)) if width else 1
            self.values[name.group(1).decode() if name else "points"] = (
                numbers if n == 1 else [numbers[i:i + n] for i in range(0, len(numbers), n)])
        points, moved = self.values["points"], self.values["displacement"]
        self.place = points
        self.undeformed = [[x - u for x, u in zip(p, d)] for p, d in zip(points, moved)]
        self.half_length = max(p[0] for p in self.undeformed)
        first = {}
        for corner, place in enumerate(self.undeformed):
            first.setdefault((round(place[0], 2), round(place[1], 2)), corner)
        self.node = list(first.values())
        # Strain of a node: mean of its triangles.
        sums = {}
        for corner, place in enumerate(self.undeformed):
            entry = sums.setdefault((round(place[0], 2), round(place[1], 2)), [0., 0])
            entry[0] += self.values["eps_p"][corner]
            entry[1] += 1
        self.eps_p = {corner: sums[key][0] / sums[key][1] for key, corner in first.items()}

    @staticmethod
    def decode(text):
        """vtkZLibDataCompressor: number of blocks, their size, size of the last, compressed sizes; then the blocks."""
        text = b"".join(text.split())
        n = struct.unpack("<I", base64.b64decode(text[:8])[:4])[0]
        length = 4 * (3 + n)
        characters = 4 * math.ceil(length / 3)
        sizes = struct.unpack(f"<{3 + n}I", base64.b64decode(text[:characters]))[3:]
        packed, raw, begin = base64.b64decode(text[characters:]), b"", 0
        for size in sizes:
            raw += zlib.decompress(packed[begin:begin + size])
            begin += size
        return struct.unpack(f"<{len(raw) // 4}f", raw)

    def touching(self, face=DIE_SIDE):
        """Nodes in contact, as the film sees it."""
        regime = self.values[f"lubrication_regime_{face}"]
        return [i for i in self.node if math.isfinite(regime[i]) and regime[i] > 0]

    def on_outer_edge(self, i):
        return max(self.undeformed[i][:2]) > self.half_length - 0.1

    def zone(self, i):
        """Where a node of the die side lies now: what of the tool is below it, and at which part of the outline of the cross
        (arms to 80 mm, 35 mm half width, re-entrant fillet about (60, 60) mm, corner of the arm about (60, 15) mm)."""
        x, y, z = self.place[i]
        height = "flat" if z > -0.2 else "radius"
        if x < 60 and y < 60:
            part = "re-entrant fillet"
        elif x >= 60 and y >= 60:
            part = "re-entrant fillet" if height == "radius" else "corner of the blank"
        elif min(x, y) > 15:
            part = "corner of an arm"
        else:
            part = "end of an arm"
        return height, part


def steps(folder):
    """All recorded steps of a run with the travel of the punch [mm]."""
    rows = history(folder)
    for file in sorted(folder.glob("solution_*.vtu")):
        fields = Fields(file)
        nearest = min(rows, key=lambda r: abs(r["time_s"] - fields.time))
        yield nearest["punch_travel_mm"], fields
