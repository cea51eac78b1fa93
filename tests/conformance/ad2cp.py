#!/usr/bin/env python3
"""Compares the bottom track records of Nortek's AD2CP as insd reads them with dolfyn 1.3.

    pip install "numpy<2" "xarray<2025" "scipy<1.14" h5py netCDF4 numba dolfyn==1.3.0
    cargo build -p insd-wire --example frames
    tests/conformance/ad2cp.py target/debug/examples/frames FOLDER

FOLDER holds recordings, `*.ad2cp`. Prints how many records were offered, read and equal; ends with 1 if any differs.
"""

import json
import math
import pathlib
import struct
import subprocess
import sys

from dolfyn.io import nortek2_defs as defs

HEADER = 10
BOTTOM_TRACK = 0x17
# name in dolfyn, name in `frames`, unit of the latter in that of the former
PLAIN = [
    ("ver", "ver", 1), ("config", "config", 1), ("SerialNum", "SerialNum", 1),
    ("usec100", "usec100", 1e-4), ("c_sound", "c_sound", 0.1), ("temp", "temp", 0.01),
    ("pressure", "pressure", 0.001), ("heading", "heading", math.radians(0.01)),
    ("pitch", "pitch", math.radians(0.01)), ("roll", "roll", math.radians(0.01)),
    ("beam_config", "beam_config", 1), ("batt", "batt", 0.1), ("vel_scale", "vel_scale", 1),
    ("error", "error", 1), ("status", "status", 1), ("_ensemble", "ensemble", 1),
]


def records(data):
    """Where each bottom track record begins, and its contents."""
    at = 0
    while at + HEADER <= len(data):
        length = struct.unpack_from("<H", data, at + 4)[0]
        if data[at + 2] == BOTTOM_TRACK and at + HEADER + length <= len(data):
            yield at, data[at + HEADER : at + HEADER + length]
        at += HEADER + length


def decoded(contents):
    """A record as dolfyn has it."""
    config, beams = struct.unpack_from("<H", contents, 2)[0], contents[31] >> 4
    layout = defs._calc_bt_struct(config, beams)
    values = layout._struct.unpack(contents[: layout.nbyte])
    out, at = {}, 0
    for name, count in zip(layout._names, layout._N):
        out[name] = values[at] if count == 1 else list(values[at : at + count])
        at += count
    # dolfyn takes the temperature as unsigned: water below zero is 653 deg C there
    out["temp"] = (out["temp"] ^ 0x8000) - 0x8000
    return out


def near(own, other):
    return math.isclose(own, other, rel_tol=1e-9, abs_tol=1e-9)


def equal(own, other):
    """Whether all fields are; bad beams are to be unknown."""
    good = all(near(own[name], other[key] * unit) for key, name, unit in PLAIN)
    clock = [other[key] for key in ("year", "month", "day", "hour", "minute", "second")]
    good &= own["clock"] == clock
    for beam, merit in enumerate(other["fom"]):
        bad = merit == 0xFFFF
        good &= own["fom"][beam] == (None if bad else merit)
        velocity = other["vel"][beam] * 10.0 ** other["vel_scale"]
        good &= own["vel"][beam] is None if bad else near(own["vel"][beam], velocity)
        far = other["dist"][beam]
        good &= own["dist"][beam] is None if far <= 0 else near(own["dist"][beam], far * 1e-3)
    return good


def main():
    frames, folder = sys.argv[1:3]
    lines = subprocess.run([frames, folder], check=True, capture_output=True).stdout.splitlines()
    own = {}
    for line in map(json.loads, lines):
        if line["protocol"] == "ad2cp" and line["way"] == "mixed" and line["name"] == "bottom track":
            own[line["file"], line["start"]] = line["fields"]
    offered = read = same = 0
    for path in sorted(pathlib.Path(folder).glob("*.ad2cp")):
        for at, contents in records(path.read_bytes()):
            offered += 1
            found = own.get((path.name, at))
            read += found is not None
            same += found is not None and equal(found, decoded(contents))
    print(f"offered {offered}, read {read}, equal {same}")
    sys.exit(offered != same)


if __name__ == "__main__":
    main()
