"""Our reader of PD0 against dolfyn, ensemble by ensemble.

Needs dolfyn from PyPI, and files of Doppler logs (those in the examples of MHKiT, for instance):

    python3 -m venv venv && venv/bin/pip install dolfyn
    cargo run -q -p insd-wire --example pd0_fields -- FOLDER > ours.jsonl
    venv/bin/python tests/conformance/pd0.py FOLDER ours.jsonl

Ends with 1 if an ensemble that dolfyn reads is missing, or if a value differs by more than its least bit.
"""

import collections
import json
import os
import sys
import warnings

import dolfyn
import numpy as np

# name of ours, name of theirs, least bit
SCALARS = [("heading", "heading", 0.01), ("pitch", "pitch", 0.01), ("roll", "roll", 0.01),
           ("temperature", "temp", 0.01)]
VECTORS = [("velocity", "vel_bt", 0.001), ("range", "dist_bt", 0.01)]


def ours_of(path):
    ensembles, told = collections.defaultdict(lambda: collections.defaultdict(list)), {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            entry = json.loads(line)
            if "read" in entry:
                told[entry["file"]] = entry
            else:
                # an instrument that starts again counts some numbers twice
                ensembles[entry["file"]][entry["number"]].append(entry)
    return ensembles, told


def unlike(ours, theirs, bit):
    """Whether a value differs; what is bad is None here and NaN there."""
    if ours is None or np.isnan(theirs):
        return ours is not None and not np.isnan(theirs)
    return abs(ours - theirs) > 1.01 * bit


def compare(own, data):
    differences = collections.Counter()
    common = 0
    for index, number in enumerate(data["number"].values):
        if not own[int(number)]:
            continue
        entry = own[int(number)].pop(0)
        common += 1
        for name, theirs, bit in SCALARS:
            if theirs in data and unlike(entry[name], float(data[theirs].values[index]), bit):
                differences[name] += 1
        for name, theirs, bit in VECTORS:
            if entry["bottom"] is None or theirs not in data:
                continue
            pairs = zip(entry["bottom"][name], data[theirs].values[:, index])
            if any(unlike(mine, float(value), bit) for mine, value in pairs):
                differences[name] += 1
    return common, differences


def main():
    folder, path = sys.argv[1:]
    ensembles, told = ours_of(path)
    failed = False
    for name in sorted(told):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                data = dolfyn.read(os.path.join(folder, name))
            except Exception as error:  # whatever it raises, it has refused
                print(f"{name}: ours {told[name]}; dolfyn refuses: {type(error).__name__} {error}")
                continue
        common, differences = compare(ensembles[name], data)
        theirs = len(data["number"])
        own = told[name]
        print(f"{name}: read {own['read']}, refused {own['refused']}, damaged {own['damaged']}; "
              f"dolfyn {theirs}, in common {common}, different: {dict(differences) or 'nothing'}")
        failed |= bool(differences) or own["refused"] > 0
    sys.exit(1 if failed else 0)


main()
