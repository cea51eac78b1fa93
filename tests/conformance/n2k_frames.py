#!/usr/bin/env python3
"""Assembly of fast packets: the same frames through `insd sniff` and canboat's analyzer.

    tests/conformance/n2k_frames.py --insd target/debug/insd --canboat canboat/rel/linux-x86_64 canboat/samples

Takes the logs of canboat whose every line is one frame, writes them as logs of candump, and counts
the messages of each group and sender that either side puts together. Ends with status 1 if they differ.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

GROUPS = {
    59904, 60928, 126208, 126464, 126992, 126996, 126998, 127250, 127251, 127252, 127257, 127258,
    128259, 128275, 129025, 129026, 129029, 129033, 129291, 129539, 129540, 129542, 130578,
}


def frames(path):
    """The frames of a log as lines of candump; nothing if a line holds more than a frame."""
    lines = []
    for line in path.read_text(encoding="latin1").splitlines():
        parts = line.strip().split(",")
        try:
            priority, pgn, source, destination, length = map(int, parts[1:6])
            data = bytes(int(digits, 16) for digits in parts[6 : 6 + length])
        except (ValueError, IndexError):
            continue
        if length > 8 or len(data) != length or pgn > 0x3FFFF:
            return []
        addressed = (pgn >> 8 & 0xFF) < 240
        group = pgn & 0x3FF00 | (destination if addressed else pgn & 0xFF)
        identifier = priority << 26 | group << 8 | source
        lines.append(f"({len(lines) * 0.0005:.6f}) can0 {identifier:08X}#{data.hex().upper()}")
    return lines


def ours(insd, log):
    """Messages by sender and group, of insd."""
    told = subprocess.run([insd, "sniff", log, "--json"], check=True, capture_output=True, text=True)
    devices = json.loads(told.stdout)["ports"][0]["bus"]["devices"]
    return {(device["address"], group["pgn"]): group["count"] for device in devices for group in device["groups"]}


def theirs(canboat, log):
    """The same of canboat's analyzer."""
    counts = collections.Counter()
    plain = subprocess.run([canboat / "candump2analyzer"], stdin=open(log), capture_output=True, text=True)
    told = subprocess.run([canboat / "analyzer", "-json", "-si", "-nv", "-q"], input=plain.stdout, capture_output=True, text=True)
    for line in told.stdout.splitlines():
        message = json.loads(line)
        if "pgn" in message:
            counts[message["src"], message["pgn"]] += 1
    return counts


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--insd", required=True)
    parser.add_argument("--canboat", required=True, type=pathlib.Path)
    parser.add_argument("samples", type=pathlib.Path)
    options = parser.parse_args()
    total, differences = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        log = pathlib.Path(folder) / "frames.log"
        for path in sorted(options.samples.iterdir()):
            lines = frames(path) if path.is_file() else []
            if not lines:
                continue
            log.write_text("\n".join(lines) + "\n")
            own, other = ours(options.insd, log), theirs(options.canboat, log)
            total.update(files=1, frames=len(lines))
            for key in own.keys() | other.keys():
                if key[1] in GROUPS and key[0] < 254:
                    total.update(ours=own.get(key, 0), theirs=other.get(key, 0))
                    if own.get(key, 0) != other.get(key, 0):
                        differences += 1
                        print(path.name, key, own.get(key, 0), other.get(key, 0))
    print(dict(total), "differences:", differences)
    sys.exit(differences > 0)


if __name__ == "__main__":
    main()
