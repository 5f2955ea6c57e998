#!/usr/bin/env python3
"""Test of u_bend_angles.py on a part of straight lines and one arc."""
import math
import unittest

import u_bend_angles

RADIUS, FIRST, FLANGE = 140.0, 85.0, -29.0  # of the wall [mm], directions of its beginning and of the flange [deg]


def part():
    line = [(float(x), 0.0) for x in range(26)]
    step = 0.5
    for k in range(120):  # a wall of 60 mm that curls outwards
        angle = math.radians(FIRST) - (k + 0.5) * step / RADIUS
        chord = 2 * RADIUS * math.sin(step / (2 * RADIUS))
        line.append((line[-1][0] + chord * math.cos(angle), line[-1][1] + chord * math.sin(angle)))
    for k in range(60):
        line.append((line[-1][0] + math.cos(math.radians(FLANGE)), line[-1][1] + math.sin(math.radians(FLANGE))))
    return line


class UBendAngles(unittest.TestCase):
    def test_lines_and_arc(self):
        theta1, theta2, rho = u_bend_angles.measure(part())
        # dz/ds = sin(first - s/r): the height of 15 mm is reached where r (cos(first - s/r) - cos(first)) = 15.
        s = RADIUS * (math.radians(FIRST) - math.acos(math.cos(math.radians(FIRST)) + 15 / RADIUS))
        turned = math.degrees(s / RADIUS)
        half_chord = math.degrees(17.5 / RADIUS) / 2
        self.assertAlmostEqual(theta1, 180 - (FIRST - turned - half_chord), delta=0.05)
        self.assertAlmostEqual(theta2, 180 - (FIRST - turned - 3 * half_chord - FLANGE), delta=0.05)
        self.assertAlmostEqual(rho, RADIUS, delta=0.5)

    def test_a_flat_part_is_refused(self):
        with self.assertRaises(SystemExit):
            u_bend_angles.measure([(float(x), 0.0) for x in range(50)])


if __name__ == "__main__":
    unittest.main()
