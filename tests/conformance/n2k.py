#!/usr/bin/env python3
"""Our readers and writers of NMEA 2000 beside three other decoders, message by message, field by field.

    tests/conformance/n2k.py --ours target/debug/examples --canboat CANBOAT/rel/linux-x86_64 \\
        --node-modules FOLDER --nmea2000 PROGRAM FOLDER_OF_LOGS...

- CANBOAT: the C programs of https://github.com/canboat/canboat (`make -C analyzer`,
  `make -C candump2analyzer`);
- FOLDER: where `npm install @canboat/canboatjs` has put its packages;
- PROGRAM: n2k_decode.cpp, built with the library NMEA2000 as its head tells.

First the logs: `analyzer` assembles the messages of every file, and everybody decodes the same bytes.
Every field must be what the others find, to the last digit that they print, "not available" included.
Then our own messages: `n2k_encode` writes each field over its whole range, and the others must read
what was meant within half a step. A difference is either given a reason here, or the recipe ends with 1.
"""

import argparse
import collections
import datetime
import json
import math
import os
import re
import subprocess
import sys

DEG = math.pi / 180
TURN = 2 * math.pi

NORTH = {0: "True", 1: "Magnetic"}
SYSTEM = dict(enumerate(
    "Gps Glonass GpsGlonass GpsSbas GpsSbasGlonass Chayka Integrated Surveyed Galileo".split()))
METHOD = dict(enumerate(
    "NoFix Gnss Differential Precise RtkFixed RtkFloat DeadReckoning Manual Simulated".split()))
INTEGRITY = dict(enumerate("NoChecking Safe Caution Unsafe".split()))
MODE = dict(enumerate("OneD TwoD ThreeD Auto".split()))
KIND = dict(enumerate("PaddleWheel PitotTube Doppler Correlation Electromagnetic".split()))
WAY = {0: "Forward", 1: "Reverse"}
TIMES = dict(enumerate(
    "Gps Glonass RadioStation LocalCesium LocalRubidium LocalCrystal".split()))
SOURCE = dict(enumerate("Manual Chart Table Calculation".split()))
SOURCE |= {4 + place: f"Wmm({2000 + 5 * place})" for place in range(6)}

# The words of canboat for these codes, where they are not the same as ours but for case.
WORDS = {
    "GPS+GLONASS": "GpsGlonass", "GPS+SBAS/WAAS": "GpsSbas",
    "GPS+SBAS/WAAS+GLONASS": "GpsSbasGlonass", "no GNSS": "NoFix", "GNSS fix": "Gnss",
    "DGNSS fix": "Differential", "Precise GNSS": "Precise", "RTK Fixed Integer": "RtkFixed",
    "RTK float": "RtkFloat", "Estimated (DR) mode": "DeadReckoning", "Manual Input": "Manual",
    "Simulate mode": "Simulated", "No integrity checking": "NoChecking", "1D": "OneD", "2D": "TwoD",
    "3D": "ThreeD", "Paddle wheel": "PaddleWheel", "Pitot tube": "PitotTube",
    "Correlation (ultra sound)": "Correlation", "Electro Magnetic": "Electromagnetic",
    "Radio Station": "RadioStation", "Local Cesium clock": "LocalCesium",
    "Local Rubidium clock": "LocalRubidium", "Local Crystal clock": "LocalCrystal",
    "Automatic Chart": "Chart", "Automatic Table": "Table", "Automatic Calculation": "Calculation",
}


def code(bits, names, other=False):
    """A code; `other` if we hand on numbers without a name."""
    return {"code": names, "bits": bits, "other": other}


def number(step, least, most, **more):
    return {"step": step, "least": least, "most": most, **more}


BYTE = number(1, 0, 252)
DATE = number(1, 0, 65532, date=True)
TIME = number(1e-4, 0, 86401, time=True)
AGE = number(0.01, 0, 655.32, age=True)
HEADING = number(1e-4, 0, TURN, turn=True)
YAW = number(1e-4, -math.pi, math.pi, turn=True)
ANGLE = number(1e-4, -math.pi, math.pi)
SPEED = number(0.01, 0, 655.32)
FINE = number(0.001, -32.767, 32.764)
DILUTION = number(0.01, -327.67, 327.64)
DISTANCE = number(1, 0, 4294967292)
COORDINATE = number(1e-7 * DEG, -math.pi, math.pi, degrees=True)
FINE_COORDINATE = number(1e-16 * DEG, -math.pi, math.pi, degrees=True)

# Group: our name of a field, canboat's, and what it is.
GROUPS = {
    126992: [("sid", "SID", BYTE), ("source", "Source", code(4, TIMES)), ("date", "Date", DATE),
             ("time", "Time", TIME)],
    127250: [("sid", "SID", BYTE), ("heading", "Heading", HEADING), ("deviation", "Deviation", ANGLE),
             ("variation", "Variation", ANGLE), ("reference", "Reference", code(2, NORTH))],
    127251: [("sid", "SID", BYTE), ("rate", "Rate", number(3.125e-8, -67.2, 67.2))],
    127252: [("sid", "SID", BYTE), ("heave", "Heave", DILUTION)],
    127257: [("sid", "SID", BYTE), ("yaw", "Yaw", YAW), ("pitch", "Pitch", ANGLE),
             ("roll", "Roll", ANGLE)],
    127258: [("sid", "SID", BYTE), ("source", "Source", code(4, SOURCE)),
             ("date", "Age of service", DATE), ("variation", "Variation", ANGLE)],
    128259: [("sid", "SID", BYTE), ("water", "Speed Water Referenced", SPEED),
             ("ground", "Speed Ground Referenced", SPEED),
             ("kind", "Speed Water Referenced Type", code(8, KIND)),
             ("direction", "Speed Direction", code(4, WAY))],
    128275: [("date", "Date", DATE), ("time", "Time", TIME), ("log", "Log", DISTANCE),
             ("trip", "Trip Log", DISTANCE)],
    129025: [("latitude", "Latitude", COORDINATE), ("longitude", "Longitude", COORDINATE)],
    129026: [("sid", "SID", BYTE), ("reference", "COG Reference", code(2, NORTH)),
             ("course", "COG", HEADING), ("speed", "SOG", SPEED)],
    129029: [("sid", "SID", BYTE), ("date", "Date", DATE), ("time", "Time", TIME),
             ("latitude", "Latitude", FINE_COORDINATE), ("longitude", "Longitude", FINE_COORDINATE),
             ("altitude", "Altitude", number(1e-6, -1e13, 1e13)),
             ("system", "GNSS type", code(4, SYSTEM, True)), ("method", "Method", code(4, METHOD, True)),
             ("integrity", "Integrity", code(2, INTEGRITY)), ("satellites", "Number of SVs", BYTE),
             ("hdop", "HDOP", DILUTION), ("pdop", "PDOP", DILUTION),
             ("geoid", "Geoidal Separation", number(0.01, -21474837, 21474837))],
    129033: [("date", "Date", DATE), ("time", "Time", TIME),
             ("local_offset", "Local Offset", number(1, -32767, 32764, minutes=True))],
    129291: [("sid", "SID", BYTE), ("reference", "Set Reference", code(2, NORTH)),
             ("set", "Set", HEADING), ("drift", "Drift", SPEED)],
    129539: [("sid", "SID", BYTE), ("desired", "Desired Mode", code(3, MODE, True)),
             ("actual", "Actual Mode", code(3, MODE, True)), ("hdop", "HDOP", DILUTION),
             ("vdop", "VDOP", DILUTION), ("tdop", "TDOP", DILUTION)],
    129542: [("sid", "SID", BYTE), ("range_rms", "RMS of Position Uncertainty", SPEED),
             ("major", "STD of Major axis", SPEED), ("minor", "STD of Minor axis", SPEED),
             ("orientation", "Orientation of Major axis", HEADING),
             ("latitude_std", "STD of Lat Error", SPEED),
             ("longitude_std", "STD of Lon Error", SPEED), ("altitude_std", "STD of Alt Error", SPEED)],
    130578: [("forward_water", "Longitudinal Speed, Water-referenced", FINE),
             ("starboard_water", "Transverse Speed, Water-referenced", FINE),
             ("forward_ground", "Longitudinal Speed, Ground-referenced", FINE),
             ("starboard_ground", "Transverse Speed, Ground-referenced", FINE),
             ("stern_starboard_water", "Stern Speed, Water-referenced", FINE),
             ("stern_starboard_ground", "Stern Speed, Ground-referenced", FINE)],
}
STATION = [("system", "Reference Station Type", code(4, SYSTEM, True)),
           ("id", "Reference Station ID", number(1, 0, 4092)),
           ("age", "Age of DGNSS Corrections", AGE)]


# What the others say, under our names, each value with the size of its last digit.


def named(field, value):
    """A code by its number."""
    if value is None:
        return None
    limit = (1 << field["bits"]) - 1 - {2: 1, 3: 1, 4: 2, 8: 3}[field["bits"]]
    if value in field["code"]:
        return field["code"][value]
    return f"Other({value})" if field["other"] and value <= limit else None


def from_analyzer(field, value):
    word = None
    if isinstance(value, dict):
        value, word = value.get("value"), value.get("name")
    if value is None:
        return None, 0
    if "code" in field:
        if word is None:
            return named(field, int(value)), 0
        return WORDS.get(word, word.title().replace("Wmm ", "Wmm(") + ")" * ("WMM" in word)), 0
    if "time" in field:
        return int(value) * 1e-4, 0
    if "age" in field:
        return int(value) * 0.01, 0
    if "minutes" in field:
        return int(value) / 60, 0
    unit = DEG if "degrees" in field else 1
    decimals = len(str(value).partition(".")[2])
    return float(value) * unit, 10.0 ** -decimals * unit if decimals else 0


def from_canboatjs(field, value):
    if value is None:
        return None, 0
    if "code" in field:
        return named(field, value), 0
    if "date" in field:
        year, month, day = map(int, value.split("."))
        return (datetime.date(year, month, day) - datetime.date(1970, 1, 1)).days, 0
    if isinstance(value, str):
        sign = -1 if value.startswith("-") else 1
        hours, minutes, seconds = value.lstrip("-").split(":")
        seconds = sign * (int(hours) * 3600 + int(minutes) * 60 + float(seconds))
        return (seconds / 60 if "minutes" in field else seconds), 0
    unit = DEG if "degrees" in field else 1
    # a rate of turn is rounded to 1e-8
    return value * unit, 1e-8 if field["step"] == 3.125e-8 else 0


def from_nmea2000(field, value):
    if "code" in field:
        return named(field, value), 0
    return (value * DEG if value is not None and "degrees" in field else value), 0


def all_fields(pgn, theirs, convert, ours_named):
    """Our names and the others' values of a message."""
    found = {}
    for ours, name, field in GROUPS[pgn]:
        key = ours if ours_named else name
        if not ours_named or key in theirs:
            found[ours] = (field, *convert(field, theirs.get(key)))
    for place, station in enumerate(theirs.get("list", [])):
        for ours, name, field in STATION:
            found[f"station {place} {ours}"] = (field, *convert(field, station.get(name)))
    if "first_system" in theirs:
        for ours, _, field in STATION:
            found[f"station 0 {ours}"] = (field, *convert(field, theirs["first_" + ours]))
    return found


def our_value(fields, name):
    if name.startswith("station"):
        _, place, name = name.split()
        stations = fields["stations"]
        return stations[int(place)][name] if int(place) < len(stations) else None
    return fields[name]


# Programs.


def run(command, text, **more):
    done = subprocess.run(command, input=text.encode("latin-1"), stdout=subprocess.PIPE, check=True,
                          stderr=subprocess.DEVNULL, **more)
    return done.stdout.decode("latin-1").splitlines()


def analyze(options, text, *more):
    """Messages of our groups: (line, fields)."""
    command = [os.path.join(options.canboat, "analyzer"), "-json", "-si", "-nv", "-empty", "-q",
               "-debugdata", *more]
    for line in run(command, text, env={"TZ": "UTC"}):
        head = re.search(r'"pgn":(\d+)', line)
        if not head or int(head.group(1)) not in GROUPS:
            continue
        # numbers stay text, so that their last digit is known
        message = json.loads(line, parse_float=str)
        data = re.findall("..", message["data"].lower())
        # logs differ in how they write the time, and no field depends on it
        parts = ["2026-01-01T00:00:00.000Z", message["prio"], message["pgn"], message["src"],
                 message["dst"], len(data), *data]
        fields = message.get("fields", {})
        yield ",".join(map(str, parts)), fields


def others(options, lines, from_logs):
    """For each decoder: its name, how its values are turned into ours, and its fields."""
    text = "\n".join(lines) + "\n"
    # the analyzer has been asked already where lines come from its logs
    theirs = {"analyzer": (from_analyzer, from_logs)}
    if options.node_modules:
        script = os.path.join(os.path.dirname(__file__), "n2k_decode.cjs")
        answers = run(["node", script], text, env=os.environ | {"NODE_PATH": options.node_modules})
        theirs["canboatjs"] = (from_canboatjs, [json.loads(answer) for answer in answers])
    if options.nmea2000:
        answers = run([options.nmea2000], text)
        theirs["NMEA2000"] = (from_nmea2000, [json.loads(answer) for answer in answers])
    for name, (_, answers) in theirs.items():
        assert len(answers) == len(lines), f"{name}: {len(answers)} of {len(lines)} messages"
    return theirs


# Comparison.


def same(field, ours, value, digit, half):
    if ours is None or value is None or "code" in field:
        return ours == value
    apart = ours - value
    if "turn" in field:
        apart = (apart + math.pi) % TURN - math.pi
    # half a turn is written as the last step below it
    steps = 0.93 if half and field["most"] == math.pi and abs(ours) > 3.1415 else 0.5
    allowed = (field["step"] * steps if half else 0) + digit / 2
    return abs(apart) <= allowed * (1 + 1e-6) + max(abs(ours), 1e-3) * 1e-14


def is_code(steps):
    """Whether a number is one of the three largest of some width."""
    return any(-4 < steps - 2**bits < 2**bits * 1e-15 for bits in (8, 15, 16, 31, 32, 63))


def why(decoder, pgn, name, field, ours, value):
    """The reason of a difference, or None."""
    number = "code" not in field
    if decoder == "NMEA2000" and name == "station 0 id" and ours is not None and value & 0xFFF == ours:
        return "the id is taken for a signed number: from 2048 on its sign fills the upper bits"
    if decoder == "NMEA2000" and pgn == 128275 and ours is None and value == 2**32 - 10**9:
        return "not available is -1e9 there, and here put into an unsigned number"
    if decoder == "NMEA2000" and name == "station 0 id" and ours is None and value & 0xFFF == 0xFFF:
        return "not available: theirs is 65535, by the same sign"
    if decoder == "NMEA2000" and number and ours is None and is_code(value / field["step"]):
        return "a code for an error, or reserved: theirs is a number"
    if decoder == "canboatjs" and number and value is None:
        # their limit is 327.64 / 0.01, which is a little less than 32764
        if field["most"] / field["step"] < round(ours / field["step"]):
            return "the largest number: their limit, divided by the step, is rounded down"
    if decoder == "canboatjs" and "minutes" in field and ours < 0 and ours % 60:
        return "less than zero and no whole hours: theirs rounds hours down, and minutes up"
    if ours is None and number and not field["least"] <= value <= field["most"]:
        return "outside of the range of its field: ours is unknown"
    return None


def compare(options, title, lines, ours, from_analyzer_fields, half):
    table = collections.defaultdict(collections.Counter)
    differences, unexplained = collections.Counter(), []
    for decoder, (convert, answers) in others(options, lines, from_analyzer_fields).items():
        for line, fields, theirs in zip(lines, ours, answers):
            pgn = int(line.split(",")[2])
            found = all_fields(pgn, theirs, convert, decoder == "NMEA2000") if theirs else {}
            row = table[pgn]
            row[decoder, "messages"] += bool(found)
            for name, (field, value, digit) in found.items():
                row[decoder, "fields"] += 1
                row[decoder, "known"] += value is not None
                mine = our_value(fields, name) if fields else None
                if same(field, mine, value, digit, half):
                    row[decoder, "agree"] += 1
                    continue
                reason = why(decoder, pgn, name, field, mine, value)
                differences[decoder, pgn, re.sub(r"\d", "n", name), reason] += 1
                if reason is None:
                    unexplained.append((decoder, pgn, name, mine, value, line))
    report(title, table, differences, unexplained)
    return bool(unexplained)


def report(title, table, differences, unexplained):
    decoders = [name for name in ("analyzer", "canboatjs", "NMEA2000")
                if any((name, "fields") in row for row in table.values())]
    print(f"\n## {title}\n")
    print("| group | messages | " + " | ".join(f"{name}: fields | not n/a | agree" for name in decoders) + " |")
    print("|---|---:|" + "---:|---:|---:|" * len(decoders))
    total = collections.Counter()
    for row in table.values():
        total.update(row)
    for pgn, row in sorted(table.items()) + [("all", total)]:
        cells = [row[decoder, what] for decoder in decoders for what in ("fields", "known", "agree")]
        print(f"| {pgn} | {row['analyzer', 'messages']} | " + " | ".join(map(str, cells)) + " |")
    print("\nDifferences:")
    for (decoder, pgn, name, reason), count in sorted(differences.items(), key=str):
        print(f"  {count} {decoder} {pgn} {name}: {reason}")
    print(f"Unexplained: {len(unexplained)}")
    seen = collections.Counter()
    for place in unexplained:
        seen[place[:3]] += 1
        if seen[place[:3]] <= 3:
            print("  ", *place)


def messages_of(options, path):
    """Messages of our groups in a log; None if canboat cannot make anything of it."""
    with open(path, encoding="latin-1") as file:
        text = file.read()
    for convert in (False, True):
        if convert:
            lines = run([os.path.join(options.canboat, "candump2analyzer")], text)
            text = "\n".join(lines) + "\n"
        try:
            return list(analyze(options, text))
        except subprocess.CalledProcessError:
            continue
    return None


def our_fields(options, lines):
    program = os.path.join(options.ours, "n2k_fields")
    answers = [json.loads(line) for line in run([program], "\n".join(lines) + "\n")]
    assert len(answers) == len(lines)
    return answers


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ours", required=True)
    parser.add_argument("--canboat", required=True)
    parser.add_argument("--node-modules")
    parser.add_argument("--nmea2000")
    parser.add_argument("logs", nargs="*")
    options = parser.parse_args()

    lines, theirs, files, unread = [], [], 0, []
    for folder in options.logs:
        for name in sorted(os.listdir(folder)):
            path = os.path.join(folder, name)
            if os.path.isfile(path) and not name.startswith("LICENSE"):
                messages = messages_of(options, path)
                if messages is None:
                    unread.append(name)
                    continue
                files += bool(messages)
                lines += [line for line, _ in messages]
                theirs += [fields for _, fields in messages]
    failed = False
    if lines:
        answers = our_fields(options, lines)
        refused = [(line, answer) for line, answer in zip(lines, answers) if "fault" in answer]
        ours = [answer.get("fields") for answer in answers]
        failed |= compare(options, f"Logs: {files} files", lines, ours, theirs, False)
        print(f"Not read by canboat: {' '.join(unread) or 'none'}")
        print(f"Refused by us: {len(refused)}")
        for line, answer in refused[:10]:
            print("  ", answer["fault"], line)

    made = [json.loads(line) for line in run([os.path.join(options.ours, "n2k_encode")], "")]
    lines = [message["line"] for message in made]
    read = list(analyze(options, "\n".join(lines) + "\n", "-format", "FAST"))
    assert [line.split(",")[2:] for line, _ in read] == [line.split(",")[2:] for line in lines]
    meant = [message["meant"] for message in made]
    theirs = [fields for _, fields in read]
    failed |= compare(options, "Our messages", lines, meant, theirs, True)
    sys.exit(failed)


main()
