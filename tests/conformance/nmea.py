"""Our readers of NMEA 0183 against two independent decoders, sentence by sentence, field by field.

Needs pynmeagps and pynmea2 from PyPI:

    python3 -m venv venv && venv/bin/pip install pynmeagps pynmea2
    cargo run -q -p insd-wire --example nmea_fields -- CORPUS > ours.jsonl
    venv/bin/python tests/conformance/nmea.py CORPUS ours.jsonl

The sentences are found here a second time, by a regular expression on the bytes, so that nothing is
missed by our cutter. Ends with 1 if a sentence was missed, if less than 99.9 % of the sentences of our
types are accepted, or if a difference is not explained.
"""

import collections
import json
import math
import os
import re
import sys
import warnings

import pynmea2
from pynmeagps import NMEAReader, VALCKSUM

SENTENCE = re.compile(rb"\$([ -#%-)+-~]*)\*([0-9A-Fa-f]{2})")
KNOT = 1852 / 3600
OURS = "DTM GGA GLL GNS GSA GST GSV HDG HDM HDT ROT RMC THS VBW VDR VHW VLW VTG ZDA".split()
OURS += "PASHR PSXN PNORBT0 PNORBT4 PNORBT6 PNORBT7 PNORBT8 PNORBT9".split()
DEG = math.pi / 180


# What the other decoders say, in SI units under our names. None is unknown.


def text(value):
    return None if value in (None, "") else str(value)


def number(value):
    return None if value in (None, "") else float(value)


def scaled(value, unit):
    return None if number(value) is None else number(value) * unit


def angle(value):
    return scaled(value, DEG)


def turn(value):
    """An angle in [0, 2 pi)."""
    return None if number(value) is None else (number(value) % 360.0) * DEG


def signed(value, letter, negative):
    if number(value) is None or letter in (None, ""):
        return None
    return -number(value) if letter == negative else number(value)


def clock(value):
    """Nanoseconds of the day."""
    if value in (None, ""):
        return None
    seconds = value.hour * 3600 + value.minute * 60 + value.second
    return seconds * 10**9 + value.microsecond * 1000


def day(value):
    return None if value in (None, "") else value.isoformat()


def speed(knots, kmh):
    return scaled(knots, KNOT) if number(knots) is not None else scaled(kmh, 1 / 3.6)


def from_pynmeagps(kind, message):
    def get(name):
        return getattr(message, name, None)

    def position():
        # both angles have their sign already
        return {"latitude": angle(get("lat")), "longitude": angle(get("lon"))}

    if kind == "GGA":
        return position() | {
            "time": clock(get("time")), "quality": number(get("quality")),
            "satellites": number(get("numSV")), "hdop": number(get("HDOP")),
            "altitude": number(get("alt")), "geoid_separation": number(get("sep")),
            "age": number(get("diffAge")), "station": number(get("diffStation")),
        }
    if kind == "GNS":
        return position() | {
            "time": clock(get("time")), "modes": get("posMode"),
            "satellites": number(get("numSV")), "hdop": number(get("HDOP")),
            "altitude": number(get("alt")), "geoid_separation": number(get("sep")),
            "age": number(get("diffAge")), "station": number(get("diffStation")),
            "nav_status": text(get("navStatus")),
        }
    if kind == "GLL":
        return position() | {
            "time": clock(get("time")), "valid": get("status") == "A", "mode": text(get("posMode")),
        }
    if kind == "RMC":
        return position() | {
            "time": clock(get("time")), "valid": get("status") == "A",
            "speed": scaled(get("spd"), KNOT), "course": turn(get("cog")), "date": day(get("date")),
            "variation": angle(signed(get("mv"), get("mvEW"), "W")),
            "mode": text(get("posMode")), "nav_status": text(get("navStatus")),
        }
    if kind == "GSA":
        satellites = [number(get(f"svid_{place:02d}")) for place in range(1, 13)]
        return {
            "automatic": get("opMode") == "A", "dimension": number(get("navMode")),
            "satellites": satellites, "pdop": number(get("PDOP")), "hdop": number(get("HDOP")),
            "vdop": number(get("VDOP")), "system": number(get("systemId")),
        }
    if kind == "GSV":
        names = [("svid", float), ("elv", angle), ("az", turn), ("cno", float)]
        satellites = []
        for place in range(1, 5):
            if get(f"svid_{place:02d}") is not None:
                row = [(get(f"{name}_{place:02d}"), to) for name, to in names]
                satellites.append([None if value == "" else to(value) for value, to in row])
        return {
            "sentences": number(get("numMsg")), "number": number(get("msgNum")),
            "in_view": number(get("numSV")), "satellites": satellites,
            "signal": None if get("signalID") in (None, "") else float(int(str(get("signalID")), 16)),
        }
    if kind == "GST":
        return {
            "time": clock(get("time")), "range_rms": number(get("rangeRms")),
            "major_std": number(get("stdMajor")), "minor_std": number(get("stdMinor")),
            "orientation": turn(get("orient")), "latitude_std": number(get("stdLat")),
            "longitude_std": number(get("stdLong")), "altitude_std": number(get("stdAlt")),
        }
    if kind == "DTM":
        return {
            "datum": text(get("datum")), "subdivision": text(get("subDatum")),
            "latitude_offset": scaled(signed(get("latOfset"), get("NS"), "S"), DEG / 60),
            "longitude_offset": scaled(signed(get("lonOfset"), get("EW"), "W"), DEG / 60),
            "altitude_offset": number(get("alt")), "reference": text(get("refDatum")),
        }
    if kind == "HDG":
        return {
            "reading": turn(get("headingM")),
            "deviation": angle(signed(get("deviation"), get("deviationEW"), "W")),
            "variation": angle(signed(get("variation"), get("variationEW"), "W")),
        }
    if kind == "HDT":
        return {"heading": turn(get("headingT"))}
    if kind == "HDM":
        return {"heading": turn(get("headingM"))}
    if kind == "THS":
        return {"heading": turn(get("headt")), "mode": get("mi")}
    if kind == "VDR":
        return {
            "set": turn(get("dirT")), "set_magnetic": turn(get("dirM")),
            "drift": scaled(get("spd"), KNOT),
        }
    if kind == "VBW":
        names = {
            "water": ("longwaterspd", "transwaterspd"), "ground": ("longgroundspd", "transgroundspd")
        }
        speeds = {ours: [scaled(get(name), KNOT) for name in pair] for ours, pair in names.items()}
        return speeds | {
            "water_valid": get("waterspdstatus") == "A", "ground_valid": get("groundspdstatus") == "A",
            "stern_water": scaled(get("sterntranswaterspd"), KNOT),
            "stern_water_valid": get("sternwaterspdstatus") == "A",
            "stern_ground": scaled(get("sterntransgroundspd"), KNOT),
            "stern_ground_valid": get("sterngroundspdstatus") == "A",
        }
    if kind == "ROT":
        return {"rate": scaled(get("rot"), DEG / 60), "valid": get("valid") == "A"}
    if kind == "VHW":
        return {
            "heading": turn(get("hdgT")), "heading_magnetic": turn(get("hdgM")),
            "speed": speed(get("spdN"), get("spdK")),
        }
    if kind == "VLW":
        names = {"water": "twd", "water_trip": "wd", "ground": "tgd", "ground_trip": "gd"}
        return {ours: scaled(get(theirs), 1852.0) for ours, theirs in names.items()}
    if kind == "VTG":
        return {
            "course": turn(get("cogt")), "course_magnetic": turn(get("cogm")),
            "speed": speed(get("sogn"), get("sogk")), "mode": text(get("posMode")),
        }
    if kind == "ZDA":
        parts = [get(name) for name in ("year", "month", "day")]
        date = None if None in parts or "" in parts else "%04d-%02d-%02d" % tuple(parts)
        return {
            "time": clock(get("time")), "date": date, "zone_hours": number(get("ltzh")),
            "zone_minutes": number(get("ltzn")),
        }
    return {}


def from_pynmea2(kind, message):
    """All but the navigational status of GNS, the ground distances of VLW and the stern of VBW."""

    def get(name):
        return getattr(message, name, None)

    def position():
        known = text(get("lat")) and text(get("lon"))
        return {
            "latitude": angle(message.latitude) if known else None,
            "longitude": angle(message.longitude) if known else None,
        }

    if kind == "GGA":
        return position() | {
            "time": clock(get("timestamp")), "quality": number(get("gps_qual")),
            "satellites": number(get("num_sats")), "hdop": number(get("horizontal_dil")),
            "altitude": number(get("altitude")), "geoid_separation": number(get("geo_sep")),
            "age": number(get("age_gps_data")), "station": number(get("ref_station_id")),
        }
    if kind == "GNS":
        return position() | {
            "time": clock(get("timestamp")), "modes": get("mode_indicator"),
            "satellites": number(get("num_sats")), "hdop": number(get("hdop")),
            "altitude": number(get("altitude")), "geoid_separation": number(get("geo_sep")),
            "age": number(get("age_gps_data")), "station": number(get("diferential")),
        }
    if kind == "GLL":
        return position() | {
            "time": clock(get("timestamp")), "valid": get("status") == "A",
            "mode": text(get("faa_mode")),
        }
    if kind == "RMC":
        return position() | {
            "time": clock(get("timestamp")), "valid": get("status") == "A",
            "speed": scaled(get("spd_over_grnd"), KNOT), "course": turn(get("true_course")),
            "date": day(get("datestamp")),
            "variation": angle(signed(get("mag_variation"), get("mag_var_dir"), "W")),
            "mode": text(get("mode_indicator")), "nav_status": text(get("nav_status")),
        }
    if kind == "GSA":
        return {
            "automatic": get("mode") == "A", "dimension": number(get("mode_fix_type")),
            "satellites": [number(get(f"sv_id{place:02d}")) for place in range(1, 13)],
            "pdop": number(get("pdop")), "hdop": number(get("hdop")), "vdop": number(get("vdop")),
        }
    if kind == "GSV":
        names = [("sv_prn_num", float), ("elevation_deg", angle), ("azimuth", turn), ("snr", float)]
        satellites = []
        for place in range(1, 5):
            if get(f"elevation_deg_{place}") is not None:
                row = [(get(f"{name}_{place}"), to) for name, to in names]
                satellites.append([None if value in (None, "") else to(value) for value, to in row])
        return {
            "sentences": number(get("num_messages")), "number": number(get("msg_num")),
            "in_view": number(get("num_sv_in_view")), "satellites": satellites,
        }
    if kind == "GST":
        return {
            "time": clock(get("timestamp")), "range_rms": number(get("rms")),
            "major_std": number(get("std_dev_major")), "minor_std": number(get("std_dev_minor")),
            "orientation": turn(get("orientation")), "latitude_std": number(get("std_dev_latitude")),
            "longitude_std": number(get("std_dev_longitude")),
            "altitude_std": number(get("std_dev_altitude")),
        }
    if kind == "DTM":
        return {
            "datum": text(get("datum")), "subdivision": text(get("subd_datum")),
            "latitude_offset": scaled(signed(get("lat"), get("lat_dir"), "S"), DEG / 60),
            "longitude_offset": scaled(signed(get("lon"), get("lon_dir"), "W"), DEG / 60),
            "altitude_offset": number(get("altitude")), "reference": text(get("datum_code")),
        }
    if kind == "HDG":
        return {
            "reading": turn(get("heading")),
            "deviation": angle(signed(get("deviation"), get("dev_dir"), "W")),
            "variation": angle(signed(get("variation"), get("var_dir"), "W")),
        }
    if kind in ("HDT", "HDM"):
        return {"heading": turn(get("heading"))}
    if kind == "VDR":
        return {
            "set": turn(get("deg_t")), "set_magnetic": turn(get("deg_m")),
            "drift": scaled(get("current"), KNOT),
        }
    if kind == "VBW":
        names = {
            "water": ("lon_water_spd", "trans_water_spd"), "ground": ("lon_grnd_spd", "trans_grnd_spd")
        }
        speeds = {ours: [scaled(get(name), KNOT) for name in pair] for ours, pair in names.items()}
        return speeds | {
            "water_valid": get("data_validity_water_spd") == "A",
            "ground_valid": get("data_validity_grnd_spd") == "A",
        }
    if kind == "ROT":
        return {"rate": scaled(get("rate_of_turn"), DEG / 60), "valid": get("status") == "A"}
    if kind == "VHW":
        return {
            "heading": turn(get("heading_true")), "heading_magnetic": turn(get("heading_magnetic")),
            "speed": speed(get("water_speed_knots"), get("water_speed_km")),
        }
    if kind == "VLW":
        return {
            "water": scaled(get("trip_distance"), 1852.0),
            "water_trip": scaled(get("trip_distance_reset"), 1852.0),
        }
    if kind == "VTG":
        return {
            "course": turn(get("true_track")), "course_magnetic": turn(get("mag_track")),
            "speed": speed(get("spd_over_grnd_kts"), get("spd_over_grnd_kmph")),
            "mode": text(get("faa_mode")),
        }
    if kind == "ZDA":
        parts = [get(name) for name in ("year", "month", "day")]
        date = None if None in parts or "" in parts else "%04d-%02d-%02d" % tuple(parts)
        return {
            "time": clock(get("timestamp")), "date": date, "zone_hours": number(get("local_zone")),
            "zone_minutes": number(get("local_zone_minutes")),
        }
    if kind == "PASHR":
        return {
            "time": clock(get("timestamp")), "heading": turn(get("true_heading")),
            "roll": angle(get("roll")), "pitch": angle(get("pitch")),
            "heave_as_sent": number(get("heave")), "roll_std": angle(get("roll_accuracy")),
            "pitch_std": angle(get("pitch_accuracy")), "heading_std": angle(get("heading_accuracy")),
            "quality_digit": number(get("aiding_status")), "status_digit": number(get("imu_status")),
        }
    if kind == "PSXN" and get("message_type") == 23:
        return {
            "roll": angle(get("roll")), "pitch": angle(get("pitch")), "heading": turn(get("head")),
            "heave": number(get("heave")),
        }
    if kind == "PSXN" and get("message_type") == 20:
        names = ("horiz_qual", "hgt_qual", "head_qual", "rp_qual")
        return {"qualities": [number(get(name)) for name in names]}
    if kind == "PNORBT7" or kind == "PNORBT9":
        return nortek(get, kind)
    return {}


def nortek(get, kind):
    def valid(name, invalid):
        return None if number(get(name)) == invalid else number(get(name))

    track = {
        "trigger_to_echo": scaled(get("dt1"), 1e-3), "echo_to_output": scaled(get("dt2"), 1e-3),
        "velocity": [valid(name, -32.768) for name in ("vx", "vy", "vz")],
        "figure_of_merit": valid("fom", 10.0),
        "distances": [valid(name, 0.0) for name in ("d1", "d2", "d3", "d4")],
    }
    if kind == "PNORBT9":
        status = get("stat")
        track["sensors"] = [
            number(get("battery_voltage")), number(get("sound_speed")),
            scaled(get("pressure"), 1e4), number(get("temp")),
            None if status in (None, "") else float(int(status, 16)),
        ]
    return track


# Comparison.


def known(values):
    """A list without the empty entries at its end."""
    while values and (values[-1] is None or values[-1] == [None] * 4):
        values = values[:-1]
    return values


def same(ours, theirs):
    if isinstance(ours, list) and isinstance(theirs, list):
        ours, theirs = known(ours), known(theirs)
        return len(ours) == len(theirs) and all(same(a, b) for a, b in zip(ours, theirs))
    if isinstance(ours, bool) or isinstance(theirs, bool):
        return ours == theirs
    if isinstance(ours, (int, float)) and isinstance(theirs, (int, float)):
        return math.isclose(ours, theirs, rel_tol=1e-9, abs_tol=2e-12)
    return ours == theirs


def body(line):
    return line[1 : line.rindex("*")].split(",")


def why(kind, field, line, ours):
    """The reason of a difference, or None."""
    fields = body(line)
    if kind == "GSA" and len(fields) >= 30 and field in ("satellites", "pdop", "hdop", "vdop"):
        return "24 satellites (SiRF-III): theirs knows 12, and takes empty places for the dilutions"
    if kind == "RMC" and len(fields) == 12 and fields[11] in "ADEFMNPRS" and fields[11]:
        if field == "mode":
            return "11 fields, the mode in the place of E or W: theirs finds no mode"
        if field == "variation":
            return "11 fields, the mode in the place of E or W: the variation has no sign"
    if kind == "GSV" and field == "satellites" and len(fields) % 4 == 1:
        return "a signal identifier at the end: theirs takes it for the number of another satellite"
    bad = left_out(kind, field, fields) if ours is None else None
    if bad is not None:
        return bad
    if kind == "ZDA" and field == "zone_minutes" and (len(fields) < 7 or not fields[6]):
        return "minutes of the zone that are not told are 0 beside its hours"
    if kind == "ZDA" and field in ("date", "zone_hours") and len(fields[4]) == 2:
        return "a year of two digits: theirs has it in the first century"
    places = {"RMC": (2, 3, 5), "GGA": (6, 2, 4), "GLL": (6, 1, 3)}
    status, north, east = places.get(kind, (0, 0, 0))
    void = kind in places and fields[status] in ("V", "0")
    if void and field in ("latitude", "longitude") and ours is None:
        latitude, longitude = fields[north], fields[east]
        if latitude[2:4] == "60" or float(latitude) > 9000 or float(longitude) > 18000:
            return "not valid by its own word, and no position: 60 minutes, or 360 degrees"
    return None


def left_out(kind, field, fields):
    """Why we have left a field out that theirs takes, or None."""
    if kind == "RMC" and field == "variation" and float(fields[10]) > 180:
        return "a variation beyond 180 deg is left out"
    if kind == "GST" and field == "orientation" and float(fields[5]) < 0:
        return "a negative orientation is left out"
    if kind == "GSA" and field == "system" and "." in fields[18]:
        return "a fourth dilution in the place of the system is left out"
    if kind == "ZDA" and field == "time" and not any(fields[2:5]):
        return "a time without a date is left out"
    return None


def sentences_of(corpus):
    """(file, end, line) of each sentence with a good checksum."""
    for folder, _, names in sorted(os.walk(corpus)):
        for name in sorted(names):
            path = os.path.join(folder, name)
            with open(path, "rb") as file:
                content = file.read()
            for match in SENTENCE.finditer(content):
                total = 0
                for byte in match.group(1):
                    total ^= byte
                if total == int(match.group(2), 16):
                    relative = os.path.relpath(path, corpus)
                    yield relative, match.end(), match.group(0).decode()


def kind_of(line):
    address = body(line)[0]
    return address if address.startswith("P") else address[2:]


def attempt(decode):
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return decode()
    except Exception:  # whatever a decoder raises, it has refused
        return None


def main():
    corpus, path = sys.argv[1:]
    ours = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            entry = json.loads(line)
            ours[entry["file"], entry["end"]] = entry
    table = collections.defaultdict(collections.Counter)
    others = collections.defaultdict(collections.Counter)
    differences = collections.Counter()
    refused, missed, unexplained = collections.Counter(), [], []
    for file, end, line in sentences_of(corpus):
        kind = kind_of(line)
        entry = ours.get((file, end))
        if entry is None:
            missed.append((file, end, line))
            continue
        if not any(body(line)[1:]):
            others[kind]["says nothing"] += 1
            continue
        if kind not in OURS or "other" in entry:
            others[kind][entry.get("other", "read, and not compared")] += 1
            continue
        row = table[kind]
        row["good"] += 1
        fields = entry.get("fields")
        row["ours"] += fields is not None
        if fields is None:
            refused[kind, entry["fault"], file, line] += 1
        decoded = {
            "pynmeagps": attempt(
                lambda: from_pynmeagps(kind, NMEAReader.parse(line, validate=VALCKSUM))
            ),
            "pynmea2": attempt(lambda: from_pynmea2(kind, pynmea2.parse(line, check=True))),
        }
        for decoder, theirs in decoded.items():
            row[decoder] += theirs is not None
            if fields is None or not theirs:
                continue
            row["both " + decoder] += 1
            unlike = [name for name in theirs if not same(fields[name], theirs[name])]
            row["agree " + decoder] += not unlike
            for name in unlike:
                reason = why(kind, name, line, fields[name])
                differences[kind, name, decoder, reason] += 1
                if reason is None:
                    unexplained.append((kind, name, decoder, file, line, fields[name], theirs[name]))
    report(table, differences, refused, missed, unexplained)
    print("\nSentences of other kinds:")
    for kind, counts in sorted(others.items()):
        print(f"  {kind}:", ", ".join(f"{count} {word}" for word, count in counts.items()))
    good = sum(row["good"] for row in table.values())
    accepted = sum(row["ours"] for row in table.values())
    failed = missed or unexplained or accepted < 0.999 * good
    sys.exit(1 if failed else 0)


def report(table, differences, refused, missed, unexplained):
    columns = [
        "good", "ours", "pynmeagps", "pynmea2",
        "both pynmeagps", "agree pynmeagps", "both pynmea2", "agree pynmea2",
    ]
    print("| sentence | " + " | ".join(columns) + " |")
    print("|---|" + "---:|" * len(columns))
    total = collections.Counter()
    for kind, row in sorted(table.items()):
        total.update(row)
        print(f"| {kind} | " + " | ".join(str(row[column]) for column in columns) + " |")
    print("| all | " + " | ".join(str(total[column]) for column in columns) + " |")
    print(f"\nNot found by our cutter: {len(missed)}")
    for place in missed[:20]:
        print("  ", *place)
    print("\nRefused by us:")
    for (kind, fault, file, line), count in refused.items():
        print(f"  {count} {kind} {file}: {fault}: {line}")
    print("\nDifferences:")
    for (kind, name, decoder, reason), count in sorted(differences.items(), key=str):
        print(f"  {count} {kind} {name} {decoder}: {reason}")
    print(f"\nUnexplained: {len(unexplained)}")
    seen = collections.Counter()
    for place in unexplained:
        seen[place[:3]] += 1
        if seen[place[:3]] <= 3:
            print("  ", *place)


main()
