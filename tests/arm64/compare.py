#!/usr/bin/env python3
"""Two solutions of one voyage, replayed by different computers: are they the same bytes, and if not, how far apart?

    compare.py ONE.csv OTHER.csv

Modes and instants have to be the same, and each value within a thousandth of the sigma that is claimed for it. What is told is the
largest of the differences over the sigmas."""

import csv
import math
import sys

LIMIT = 1e-3  # of a sigma
METRES_A_DEGREE = 111_200.0  # of latitude, mean of the ellipsoid, to 1 %
CLAIMS = {
    "lat_deg": "std_n_m", "lon_deg": "std_e_m", "height_m": "std_d_m",
    "vn_mps": "std_vn_mps", "ve_mps": "std_ve_mps", "vd_mps": "std_vd_mps",
    "roll_deg": "std_roll_deg", "pitch_deg": "std_pitch_deg", "heading_deg": "std_heading_deg",
}


def apart(one, other, value):
    """The difference of a value in the unit of its sigma; zero if neither has it."""
    if not one[value] and not other[value]:
        return 0.0
    difference = float(one[value]) - float(other[value])
    if value in ("lon_deg", "heading_deg"):
        difference = (difference + 180.0) % 360.0 - 180.0
    if value in ("lat_deg", "lon_deg"):
        difference *= METRES_A_DEGREE
    if value == "lon_deg":
        difference *= math.cos(math.radians(float(one["lat_deg"])))
    return abs(difference)


def main(first, second):
    with open(first, newline="") as one, open(second, newline="") as other:
        if one.read() == other.read():
            print("ok    the solution is that of this computer, to the byte")
            return 0
        one.seek(0), other.seek(0)
        rows, others = list(csv.DictReader(one)), list(csv.DictReader(other))
    words = ("t_s", "mode")
    if [[row[word] for word in words] for row in rows] != [[row[word] for word in words] for row in others]:
        print("FAIL  instants or modes are not those of this computer")
        return 1
    differing = sum(row != twin for row, twin in zip(rows, others))
    worst, value = max(
        (apart(row, twin, value) / float(row[sigma]), value)
        for row, twin in zip(rows, others) for value, sigma in CLAIMS.items() if row[sigma])
    print(f"{'ok   ' if worst <= LIMIT else 'FAIL '} the solution is that of this computer within {worst:.2g} sigma, of {value}; "
          f"{differing} of {len(rows)} rows differ in a digit")
    return 0 if worst <= LIMIT else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
