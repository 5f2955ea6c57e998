#!/usr/bin/env python3
"""Springback of a U-bend from the output folder of a run, as NUMISHEET'93 measures it.

    u_bend_angles.py FOLDER

Along the middle line y = 0 of `nodes_final.csv`: A on the wall 15 mm above the bottom, B and C 17.5 and 35 mm further along it.
theta1: angle inside the part between bottom and wall, the chord A-B. theta2: angle between the upper wall, the chord B-C, and the
flange, the chord from 25 to 5 mm before its end. rho: radius of the circle through A, B and C.
"""
import csv
import math
import pathlib
import sys


def middle_line(folder):
    with open(pathlib.Path(folder) / "nodes_final.csv") as file:
        rows = [row for row in csv.DictReader(file) if float(row["y0_mm"]) == 0]
    rows.sort(key=lambda row: float(row["x0_mm"]))
    return [(float(row["x_mm"]), float(row["z_mm"])) for row in rows]


def lengths(line):
    total = [0.0]
    for a, b in zip(line, line[1:]):
        total.append(total[-1] + math.dist(a, b))
    return total


def at(line, length, s):
    """Point of the line at the length s from its beginning."""
    i = max(k for k in range(len(line) - 1) if length[k] <= s)
    share = (s - length[i]) / (length[i + 1] - length[i])
    return tuple((1 - share) * p + share * q for p, q in zip(line[i], line[i + 1]))


def height_reached(line, length, height):
    for i, (a, b) in enumerate(zip(line, line[1:])):
        if a[1] - line[0][1] < height <= b[1] - line[0][1]:
            return length[i] + (height - a[1] + line[0][1]) / (b[1] - a[1]) * (length[i + 1] - length[i])
    raise SystemExit(f"The part is not {height} mm high.")


def direction(a, b):
    return math.degrees(math.atan2(b[1] - a[1], b[0] - a[0]))


def radius(a, b, c):
    twice_area = abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    return math.dist(a, b) * math.dist(b, c) * math.dist(c, a) / (2 * twice_area) if twice_area > 0 else math.inf


def measure(line):
    length = lengths(line)
    start = height_reached(line, length, 15)
    a, b, c = (at(line, length, start + s) for s in (0, 17.5, 35))
    flange = direction(at(line, length, length[-1] - 25), at(line, length, length[-1] - 5))
    return 180 - direction(a, b), 180 - (direction(b, c) - flange), radius(a, b, c)


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    theta1, theta2, rho = measure(middle_line(arguments[0]))
    print(f"theta1 {theta1:.1f} deg, theta2 {theta2:.1f} deg, rho {rho:.0f} mm")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
