#!/usr/bin/env python3
"""Smooths simulated voyages with a MEMS unit from which the fixes are taken away for a minute eleven times, and holds them against the truth.

    contrib/smoothing/campaign.py [--insd PROGRAM] [--seeds 1..21] [--scenario FILE] [--work FOLDER]

Tells the horizontal error in those minutes as the filter told it at the time and as it is known afterwards, beside the limits of both, and the NEES of each
component. Needs nothing but Python.
"""

import argparse
import csv
import json
import math
import pathlib
import shutil
import subprocess
import sys

OUTAGES = [(start, start + 60) for start in range(1500, 7000, 500)]
# heading and biases are known from here on, s
SETTLED = 1200.0
RADIUS = 6_371_000.0
COMPONENTS = ["n", "e", "d", "vn", "ve", "vd", "roll", "pitch", "heading"]
COLUMNS = ["lat_deg", "lon_deg", "height_m", "vn_mps", "ve_mps", "vd_mps", "roll_deg", "pitch_deg", "heading_deg"]
SIGMAS = ["std_n_m", "std_e_m", "std_d_m", "std_vn_mps", "std_ve_mps", "std_vd_mps", "std_roll_deg", "std_pitch_deg",
          "std_heading_deg"]


def rows(path):
    with open(path, newline="") as file:
        yield from csv.DictReader(file)


def errors(row, truth):
    """Errors north, east, down (m), of the velocity (m/s) and the angles (deg)."""
    own, true = ([float(of[column]) for column in COLUMNS] for of in (row, truth))
    off = [a - b for a, b in zip(own, true)]
    off[0] = math.radians(off[0]) * RADIUS
    off[1] = math.radians(off[1]) * RADIUS * math.cos(math.radians(true[0]))
    off[2] = -off[2]
    off[8] = (off[8] + 180.0) % 360.0 - 180.0
    return off


def score(nav, truth):
    """Mean squares: of normalised errors, of horizontal errors in the outages and in their middle."""
    squares, count = [0.0] * 9, 0
    outage, middle = [], []
    for row in rows(nav):
        time = float(row["t_s"])
        true = truth.get(round(time * 1000))
        if true is None or time < SETTLED:
            continue
        off = errors(row, true)
        count += 1
        for index, sigma in enumerate(SIGMAS):
            squares[index] += (off[index] / float(row[sigma])) ** 2
        level = off[0] ** 2 + off[1] ** 2
        for begin, until in OUTAGES:
            if begin <= time < until:
                outage.append(level)
            if time == (begin + until) / 2:
                middle.append(level)
    mean = lambda values: sum(values) / len(values)
    return {"nees": [square / count for square in squares], "outage": mean(outage), "middle": mean(middle)}


def insd(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return done


def limits(program, scenario, *more):
    """Root mean squares of the limit over all outages, second by second, and in their middle, m."""
    at = {"outage": [t for begin, until in OUTAGES for t in range(begin, until)],
          "middle": [(begin + until) // 2 for begin, until in OUTAGES]}
    asked = sorted({t for all in at.values() for t in all})
    arguments = ["--json", *more]
    for begin, until in OUTAGES:
        arguments += ["--outage", f"{begin}..{until}"]
    for instant in asked:
        arguments += ["--at", instant]
    told = json.loads(insd(program, "limit", scenario, *arguments).stdout)["limits"]
    by_time = {row["at_s"]: row["horizontal_m"] for row in told}
    return {name: math.sqrt(sum(by_time[t] ** 2 for t in all) / len(all)) for name, all in at.items()}


def main():
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--insd", default="target/release/insd")
    parser.add_argument("--seeds", default="1..21")
    parser.add_argument("--scenario", default=here / "mems.toml")
    parser.add_argument("--work", default=pathlib.Path("target/smoothing"), type=pathlib.Path)
    arguments = parser.parse_args()
    first, last = map(int, arguments.seeds.split(".."))
    found = {"replay": [], "smooth": []}
    for seed in range(first, last):
        voyage = arguments.work / "voyage"
        shutil.rmtree(voyage, ignore_errors=True)
        arguments.work.mkdir(parents=True, exist_ok=True)
        insd(arguments.insd, "simulate", arguments.scenario, "--seed", seed, "--out", voyage)
        truth = {round(float(row["t_s"]) * 1000): row for row in rows(voyage / "truth.csv")}
        for command, scores in found.items():
            nav = arguments.work / f"{command}.csv"
            without = [word for begin, until in OUTAGES for word in ("--outage", f"gnss:{begin}..{until}")]
            insd(arguments.insd, command, voyage, "--out", nav, *without)
            scores.append(score(nav, truth))
        print(f"seed {seed} done", file=sys.stderr)
        shutil.rmtree(voyage)
    both = {"replay": limits(arguments.insd, arguments.scenario),
            "smooth": limits(arguments.insd, arguments.scenario, "--smoothed")}
    for command, scores in found.items():
        print(f"insd {command}, {len(scores)} voyages, {len(OUTAGES)} outages of 60 s each")
        for name in ["outage", "middle"]:
            rms = math.sqrt(sum(own[name] for own in scores) / len(scores))
            print(f"  horizontal, {name:8} {rms:7.3f} m   limit {both[command][name]:7.3f} m")
        nees = [sum(own["nees"][index] for own in scores) / len(scores) for index in range(9)]
        print("  NEES " + "  ".join(f"{name} {value:.2f}" for name, value in zip(COMPONENTS, nees)))


if __name__ == "__main__":
    main()
