#!/usr/bin/env python3
"""NovAtel's binary logs as insd-wire reads them, against the maker's own decoder.

    pip install novatel_edie==2.10.11
    cargo build -p insd-wire --example frames
    tests/conformance/novatel.py target/debug/examples/frames FOLDER_OF_LOGS

Prints a line for each kind of log and every difference; ends with status 1 if a frame that both sides accept is read differently. Beside
the logs, frames with random contents are made (seed 1), 2,000 of each log that we read.
"""

import json
import math
import random
import struct
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from pathlib import Path

from novatel_edie import oem

DEG = math.pi / 180
LOGS = {
    42: 72, 1429: 72, 99: 44, 1430: 44, 1335: 48, 2042: 44, 507: 88, 508: 88, 1465: 126, 268: 40, 325: 40,
    1461: 40, 1462: 40, 101: 44,
}
DEGREES = {
    "latitude", "longitude", "roll", "pitch", "azimuth", "heading", "heading_std_dev", "pitch_std_dev", "ground_track",
    "roll_std_dev", "azimuth_std_dev",
}
COUNTS = {
    "accel_z": ("push", 0), "accel_y": ("push", 1), "accel_x": ("push", 2),
    "gyro_z": ("turn", 0), "gyro_y": ("turn", 1), "gyro_x": ("turn", 2),
    "del_vel_body_z": ("push", 0), "del_vel_body_y": ("push", 1), "del_vel_body_x": ("push", 2),
    "del_ang_body_z": ("turn", 0), "del_ang_body_y": ("turn", 1), "del_ang_body_x": ("turn", 2),
}
OTHER_NAMES = {"orthometric_height": "height"}


def crc32(data):
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xEDB88320 if crc & 1 else 0)
    return crc


def scan(data):
    """Start and length of every frame with a good checksum."""
    at = data.find(b"\xaaD")
    while at >= 0:
        kind = data[at + 2:at + 3]
        if kind == b"\x12" and len(data) >= at + 10:
            end = at + data[at + 3] + struct.unpack_from("<H", data, at + 8)[0]
        elif kind == b"\x13" and len(data) > at + 3:
            end = at + 12 + data[at + 3]
        else:
            end = len(data)
        if end + 4 <= len(data) and crc32(data[at:end]) == struct.unpack_from("<I", data, end)[0]:
            yield at, end + 4 - at
        at = data.find(b"\xaaD", at + 1)


def theirs(frame):
    """What the maker's decoder says of a frame: its name and fields; `None` if it refuses it."""
    parser = oem.Parser()
    parser.write(frame)
    for message in parser:
        if hasattr(message, "to_dict") and hasattr(message, "name"):
            return message.name, message.to_dict()
    return None


def same(key, ours, value):
    if hasattr(value, "value"):
        value = value.value
    if isinstance(value, float) and not math.isfinite(value):
        return ours is None
    factor = DEG if key in DEGREES else 1
    return ours is not None and abs(ours - value * factor) <= 1e-12 + 1e-9 * abs(value * factor)


def differences(line, fields):
    for key, value in fields.items():
        if key == "header":
            head = [value["week"], round(value["milliseconds"]), value["time_status"]]
            # a short header tells no status, the maker's decoder says 20
            if line["fields"]["header"][:2] != head[:2]:
                yield f"header: {line['fields']['header']} and {head}"
            continue
        ours = line["fields"]
        if key in COUNTS:
            group, at = COUNTS[key]
            told = ours[group][at]
        else:
            told = ours.get(OTHER_NAMES.get(key, key), "absent")
        if told != "absent" and not same(key, told, value):
            yield f"{key}: {told} and {value}"


def made(rng, count):
    stream = bytearray()
    for _ in range(count):
        for number, length in LOGS.items():
            payload = body(rng, number, length)
            week, when = rng.randrange(4000), rng.randrange(604_800_000)
            if number in (325, 508, 1462):
                frame = b"\xaaD\x13" + struct.pack("<BHHI", length, number, week, when) + payload
            else:
                status = rng.choice((20, 60, 100, 160, 180))
                frame = b"\xaaD\x12" + struct.pack(
                    "<BHBBHHBBHIIHH", 28, number, 0, 32, length, 0, 99, status, week, when, 0, 0, 0) + payload
            stream += frame + struct.pack("<I", crc32(frame)) + rng.randbytes(rng.randrange(8))
    return bytes(stream)


def body(rng, number, length):
    payload = bytearray(rng.randbytes(length))
    place = {42: 8, 1429: 8, 507: 12, 508: 12, 1465: 8}.get(number)
    reals = {
        42: "24d 32f 40f 44f 48f 56f 60f", 99: "8f 12f 16d 24d 32d", 1335: "8f 12f 16f 24f 28f",
        507: "4d 28d 36d 44d 52d 60d 68d 76d", 268: "4d", 1461: "4d", 101: "4d 12d 20d",
        1465: "24d 32f 36d 44d 52d 60d 68d 76d 84f 88f 92f 96f 100f 104f 108f 112f 116f",
    }
    twin = {1429: 42, 1430: 99, 2042: 1335, 508: 507, 325: 268, 1462: 1461}
    for own in reals[twin.get(number, number)].split():
        struct.pack_into("<" + own[-1], payload, int(own[:-1]), rng.choice((rng.uniform(-1e4, 1e4), rng.uniform(-1, 1))))
    if place:
        struct.pack_into("<dd", payload, place, rng.uniform(-90, 90), rng.uniform(-180, 180))
    if number in (1461, 1462):
        payload[0] &= 7
    # codes are drawn from those that the maker's decoder has a name for
    solution, kind = range(24), (0, 1, 4, 5, 6, 8, 16, 17, 18, 19, 32, 33, 34, 48, 49, 50, 51, 53, 56, 68, 69, 77, 78)
    codes = {
        42: {0: solution, 4: kind, 36: (61,)}, 99: {0: solution, 4: kind}, 1335: {0: solution, 4: kind},
        507: {84: range(15)}, 1465: {0: range(15), 4: kind}, 101: {0: range(4), 40: range(3)},
    }
    for at, known in codes.get(twin.get(number, number), {}).items():
        struct.pack_into("<I", payload, at, rng.choice(known))
    # numbers of stations are text to the maker's decoder
    text = {42: (52, 4), 1429: (52, 4), 1335: (32, 8), 2042: (32, 4)}.get(number)
    if text:
        payload[text[0]:sum(text)] = b"1234" * (text[1] // 4)
    return bytes(payload)


def compare(program, folder, rows, notes):
    lines = subprocess.run([program, folder], capture_output=True, text=True, check=True).stdout
    cut = defaultdict(dict)
    for line in map(json.loads, lines.splitlines()):
        if line["protocol"] == "novatel" and line["way"] == "alone":
            cut[line["file"]][line["start"], line["length"]] = line
    for path in sorted(Path(folder).iterdir()):
        data = path.read_bytes()
        for start, length in scan(data):
            frame = data[start:start + length]
            number = struct.unpack_from("<H", frame, 4)[0]
            line, told = cut[path.name].get((start, length)), theirs(frame)
            read = line is not None and line["name"] != "refused"
            name = line["name"] if read and line["fields"] else told[0] if told and number in LOGS else "others"
            row = rows[name]
            row["frames"] += 1
            row["ours"] += read
            row["theirs"] += told is not None
            if not (read and told):
                notes.append(f"{path.name}: {name}: {'the other' if read else 'we'} refuse")
                continue
            row["both"] += 1
            wrong = list(differences(line, told[1])) if line["fields"] else []
            row["agree"] += not wrong
            notes += [f"{path.name}: {name}.{what}: DIFFERENT" for what in wrong]


def main():
    program, folder = sys.argv[1:]
    notes = []
    for title in ("Logs", "Random contents"):
        rows = defaultdict(Counter)
        if title == "Logs":
            compare(program, folder, rows, notes)
        else:
            with tempfile.TemporaryDirectory() as own:
                (Path(own) / "made").write_bytes(made(random.Random(1), 2000))
                compare(program, own, rows, notes)
        print(f"\n### {title}\n\n| log | frames | accepted by us | by the maker's decoder | by both | agree |\n|---|---|---|---|---|---|")
        for name, row in sorted(rows.items()):
            print(f"| {name} | " + " | ".join(f"{row[key]:,}" for key in ("frames", "ours", "theirs", "both", "agree")) + " |")
    for note, count in Counter(notes).most_common(30):
        print(f"- {note} ({count} times)")
    sys.exit(any(note.endswith("DIFFERENT") for note in notes))


if __name__ == "__main__":
    main()
