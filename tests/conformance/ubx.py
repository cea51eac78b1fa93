#!/usr/bin/env python3
"""UBX, SBF and RTCM3 frames as insd-wire reads them, against pyubx2, pysbf2 and pyrtcm.

    pip install pyubx2==1.4.0 pysbf2==1.0.7 pyrtcm==1.2.1
    cargo build -p insd-wire --example frames
    tests/conformance/ubx.py target/debug/examples/frames FOLDER_OF_LOGS

Prints the tables of docs/conformance/ubx.md and every difference; ends with status 1 if a frame that
both sides accept is read differently. Beside the logs, frames with random contents are made (seed 1)
for each message that we read, as the logs do not hold all of them.
"""

import json
import math
import random
import struct
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from io import BytesIO
from pathlib import Path

from pyrtcm import RTCMReader, calc_crc24q
from pysbf2 import SBFReader
from pyubx2 import ERR_IGNORE, UBX_PROTOCOL, UBXReader

DEG = math.pi / 180
UBX = {
    (0x01, 0x07): "NAV-PVT", (0x01, 0x04): "NAV-DOP", (0x01, 0x36): "NAV-COV",
    (0x01, 0x14): "NAV-HPPOSLLH", (0x01, 0x20): "NAV-TIMEGPS", (0x01, 0x26): "NAV-TIMELS",
    (0x01, 0x02): "NAV-POSLLH", (0x01, 0x03): "NAV-STATUS", (0x01, 0x06): "NAV-SOL",
    (0x01, 0x12): "NAV-VELNED", (0x01, 0x21): "NAV-TIMEUTC", (0x01, 0x3C): "NAV-RELPOSNED",
    (0x0D, 0x01): "TIM-TP", (0x02, 0x15): "RXM-RAWX", (0x02, 0x13): "RXM-SFRBX",
}
SBF = {
    4007: "PVTGeodetic", 5906: "PosCovGeodetic", 5908: "VelCovGeodetic", 5938: "AttEuler",
    5939: "AttCovEuler", 5914: "ReceiverTime", 5911: "xPPSOffset", 4006: "PVTCartesian",
    4028: "BaseVectorGeod",
}


# ---- frames with good checksums, found by looking at every byte


def fletcher(data):
    a = b = 0
    for byte in data:
        a = (a + byte) & 255
        b = (b + a) & 255
    return bytes((a, b))


def crc16(data):
    crc = 0
    for byte in data:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc


def ubx_at(data, at):
    if len(data) < at + 8:
        return 0
    end = at + 8 + struct.unpack_from("<H", data, at + 4)[0]
    good = end <= len(data) and fletcher(data[at + 2:end - 2]) == data[end - 2:end]
    return end - at if good else 0


def sbf_at(data, at):
    if len(data) < at + 8:
        return 0
    crc, _, length = struct.unpack_from("<HHH", data, at + 2)
    good = 8 <= length <= len(data) - at and crc16(data[at + 4:at + length]) == crc
    return length if good else 0


def rtcm_at(data, at):
    if len(data) < at + 6 or data[at + 1] > 3:
        return 0
    end = at + 6 + struct.unpack_from(">H", data, at + 1)[0]
    return end - at if end <= len(data) and calc_crc24q(data[at:end]) == 0 else 0


SYNCS = {"ubx": (b"\xb5b", ubx_at), "sbf": (b"$@", sbf_at), "rtcm": (b"\xd3", rtcm_at)}


def scan(protocol, data):
    """Start and length of every frame, even inside another."""
    sync, length_at = SYNCS[protocol]
    at = data.find(sync)
    while at >= 0:
        length = length_at(data, at)
        if length:
            yield at, length
        at = data.find(sync, at + 1)


# ---- what the oracles say, in our names and units


def maybe(value, unknown, factor=1.0):
    return None if value in unknown else value * factor


def ubx_fields(name, m):
    known = lambda value, factor: maybe(value, (0xFFFFFFFF, round(0xFFFFFFFF * 1e-5, 12)), factor)
    dop = lambda value: None if value > 99.985 else value
    itow = {"iTOW": m.iTOW * 1_000_000} if hasattr(m, "iTOW") else {}
    raw = lambda *names: {key: getattr(m, key) for key in names}
    if name == "NAV-PVT":
        place = not m.invalidLlh
        return itow | raw(
            "year", "month", "day", "hour", "min", "second", "validDate", "validTime",
            "fullyResolved", "nano", "fixType", "gnssFixOk", "diffSoln", "carrSoln", "numSV",
        ) | {
            "tAcc": known(m.tAcc, 1e-9), "lat": m.lat * DEG if place else None,
            "lon": m.lon * DEG if place else None, "height": m.height * 1e-3 if place else None,
            "hMSL": m.hMSL * 1e-3, "hAcc": known(m.hAcc, 1e-3), "vAcc": known(m.vAcc, 1e-3),
            "velN": m.velN * 1e-3, "velE": m.velE * 1e-3, "velD": m.velD * 1e-3,
            "gSpeed": m.gSpeed * 1e-3, "headMot": ("angle", m.headMot * DEG),
            "sAcc": known(m.sAcc, 1e-3), "headAcc": known(m.headAcc, DEG), "pDOP": dop(m.pDOP),
            "headVeh": ("angle", m.headVeh * DEG) if m.headVehValid else None,
            "magDec": m.magDec * DEG if m.validMag else None,
            "magAcc": m.magAcc * DEG if m.validMag else None,
        }
    if name == "NAV-DOP":
        return itow | {key: dop(getattr(m, key)) for key in (
            "gDOP", "pDOP", "tDOP", "vDOP", "hDOP", "nDOP", "eDOP")}
    if name == "NAV-COV":
        cov = lambda of: [[getattr(m, of + k) for k in row] for row in (("NN", "NE", "ND"), ("EE", "ED"))]
        full = lambda of: cov(of) + [getattr(m, of + "DD")]
        return itow | {"posCov": full("posCov") if m.posCovValid == 1 else None,
                       "velCov": full("velCov") if m.velCovValid == 1 else None}
    if name == "NAV-HPPOSLLH":
        place = not m.invalidLlh
        # pyubx2 adds the fine digits to the coarse ones; of heights, in millimetres
        return itow | {
            "lat": m.lat * DEG if place else None, "lon": m.lon * DEG if place else None,
            "height": m.height * 1e-3 if place else None, "hMSL": m.hMSL * 1e-3,
            "hAcc": maybe(m.hAcc, (round(0xFFFFFFFF * 0.1, 12),), 1e-3),
            "vAcc": maybe(m.vAcc, (round(0xFFFFFFFF * 0.1, 12),), 1e-3)}
    if name == "NAV-POSLLH":
        return itow | {
            "lat": m.lat * DEG, "lon": m.lon * DEG, "height": m.height * 1e-3, "hMSL": m.hMSL * 1e-3,
            "hAcc": known(m.hAcc, 1e-3), "vAcc": known(m.vAcc, 1e-3)}
    if name == "NAV-VELNED":
        return itow | {key: getattr(m, key) * 1e-2 for key in (
            "velN", "velE", "velD", "speed", "gSpeed")} | {
            "heading": m.heading * DEG, "sAcc": known(m.sAcc, 1e-2), "cAcc": known(m.cAcc, DEG)}
    if name == "NAV-SOL":
        return itow | raw(
            "fTOW", "week", "gpsFix", "gpsfixOK", "diffSoln", "wknSet", "towSet", "numSV", "pDOP") | {
            key: getattr(m, key) * 1e-2 for key in (
                "ecefX", "ecefY", "ecefZ", "ecefVX", "ecefVY", "ecefVZ")} | {
            "pAcc": known(m.pAcc, 1e-2), "sAcc": known(m.sAcc, 1e-2)}
    if name == "NAV-STATUS":
        return itow | raw(
            "gpsFix", "gpsFixOk", "diffSoln", "wknSet", "towSet", "spoofDetState", "carrSoln") | {
            "ttff": m.ttff * 1_000_000, "msss": m.msss * 1_000_000}
    if name == "NAV-TIMEUTC":
        return itow | raw("nano", "year", "month", "day", "hour", "min", "sec", "validTOW",
                          "validWKN", "validUTC", "utcStandard") | {"tAcc": known(m.tAcc, 1e-9)}
    if name == "NAV-RELPOSNED":
        fine = lambda key: maybe(getattr(m, key), (round(0xFFFFFFFF * 0.1, 12),), 1e-3)
        flags = ("version", "refStationID", "gnssFixOK", "diffSoln", "relPosValid", "carrSoln", "isMoving",
                 "refPosMiss", "refObsMiss", "relPosHeadingValid", "relPosNormalized")
        # pyubx2 adds the fine digits to the coarse ones, in centimetres
        return itow | raw(*flags) | {key: ("rounded to", getattr(m, key) * 1e-2) for key in (
            "relPosN", "relPosE", "relPosD", "relPosLength")} | {
            key: fine(key) for key in ("accN", "accE", "accD", "accLength")} | {
            "relPosHeading": m.relPosHeading * DEG, "accHeading": known(m.accHeading, DEG)}
    if name == "NAV-TIMEGPS":
        return itow | raw("fTOW", "week", "towValid", "weekValid") | {
            "leapS": m.leapS if m.leapSValid else None, "tAcc": known(m.tAcc, 1e-9)}
    if name == "NAV-TIMELS":
        event = raw("srcOfLsChange", "lsChange", "timeToLsEvent", "dateOfLsGpsWn", "dateOfLsGpsDn")
        return itow | {"srcOfCurrLs": m.srcOfCurrLs, "currLs": m.currLs if m.validCurrLs else None} | {
            key: value if m.validTimeToLsEvent else None for key, value in event.items()}
    if name == "TIM-TP":
        return raw("week", "timeBase", "utc", "raim", "timeRefGnss", "utcStandard") | {
            "towMS": m.towMS * 1_000_000, "towSubMS": m.towSubMS * 1e-3,
            "qErr": None if m.qErrInvalid else m.qErr * 1e-12}
    if name == "RXM-SFRBX":
        words = [getattr(m, f"dwrd_{i + 1:02d}") for i in range(m.numWords)]
        return raw("gnssId", "svId", "sigId", "freqId", "chn", "version") | {"dwrd": words}
    rows = []
    for i in range(1, m.numMeas + 1):
        one = lambda key: getattr(m, f"{key}_{i:02d}")
        row = {key: one(key) for key in (
            "doMes", "gnssId", "svId", "sigId", "freqId", "cno", "prStd", "doStd")}
        row |= {"prMes": one("prMes") if one("prValid") else None,
                "cpMes": one("cpMes") if one("cpValid") else None,
                "locktime": one("locktime") * 1e-3,
                "cpStd": None if one("cpStd") == 15 else one("cpStd") * 0.004}
        rows.append(row)
    return raw("rcvTow", "week", "leapS", "leapSec", "clkReset") | {"measurements": rows}


def sbf_fields(name, m):
    number = lambda value, factor=1.0: None if value == -2e10 else value * factor
    get = lambda key, factor=1.0: number(getattr(m, key), factor)
    byte = lambda key: maybe(getattr(m, key), (255,))
    head = {"TOW": None if m.TOW >= 604_800_000 else m.TOW * 1_000_000, "WNc": maybe(m.WNc, (65535,))}
    mode = lambda: {key: getattr(m, key) for key in ("Type", "AutoSet", "2D", "Error")}
    if name == "PVTGeodetic":
        place = [get("Latitude"), get("Longitude"), get("Height")]
        place = [None] * 3 if None in place else place
        return head | mode() | dict(zip(("Latitude", "Longitude", "Height"), place)) | {
            "Undulation": get("Undulation"), "Vn": get("Vn"), "Ve": get("Ve"),
            "Vd": get("Vu", -1.0), "COG": get("COG", DEG), "RxClkBias": get("RxClkBias", 1e-3),
            "RxClkDrift": get("RxClkDrift", 1e-6), "TimeSystem": byte("TimeSystem"),
            "Datum": byte("Datum"), "NrSV": byte("NrSV"), "ReferenceID": m.ReferenceID,
            "MeanCorrAge": maybe(m.MeanCorrAge, (655.35,)), "SignalInfo": m.SignalInfo,
            "NrBases": m.NrBases, "Latency": maybe(m.Latency, (6.5535,)),
            "HAccuracy": maybe(m.HAccuracy, (655.35,)), "VAccuracy": maybe(m.VAccuracy, (655.35,))}
    if name == "PVTCartesian":
        place, speed = [get("X"), get("Y"), get("Z")], [get("Vx"), get("Vy"), get("Vz")]
        place, speed = ([None] * 3 if None in own else own for own in (place, speed))
        ours = head | mode() | dict(zip(("X", "Y", "Z"), place)) | dict(zip(("Vx", "Vy", "Vz"), speed))
        return ours | {
            "Undulation": get("Undulation"), "NrSV": byte("NrSV"), "NrBases": m.NrBases,
            "Latency": maybe(m.Latency, (6.5535,)), "HAccuracy": maybe(m.HAccuracy, (655.35,)),
            "VAccuracy": maybe(m.VAccuracy, (655.35,))}
    if name == "BaseVectorGeod":
        rows = []
        for i in range(1, m.N + 1):
            one = lambda key: getattr(m, f"{key}_{i:02d}")
            real = lambda key, factor=1.0: number(one(key), factor)
            rows.append({"NrSV": one("NrSV"), "Error": one("Error"), "Mode": one("Type")} | {
                "DeltaNorth": real("DeltaNorth"), "DeltaEast": real("DeltaEast"),
                "DeltaDown": real("DeltaUp", -1.0), "DeltaVn": real("DeltaVn"), "DeltaVe": real("DeltaVe"),
                "DeltaVd": real("DeltaVu", -1.0), "Azimuth": round(one("Azimuth") * 100),
                "Elevation": round(one("Elevation") * 100), "ReferenceID": one("ReferenceID"),
                "CorrAge": maybe(one("CorrAge"), (655.35,)), "SignalInfo": one("SignalInfo")})
        return head | {"vectors": rows}
    if name in ("PosCovGeodetic", "VelCovGeodetic"):
        a, b, c, d = ("latlat", "lonlon", "hgthgt", "bb") if name[0] == "P" else ("VnVn", "VeVe", "VuVu", "DtDt")
        rest = ("latlon", "lathgt", "latb", "lonhgt", "lonb", "hb") if name[0] == "P" else (
            "VnVe", "VnVu", "VnDt", "VeVu", "VeDt", "VuDt")
        return head | mode() | {"variances": [get("Cov_" + key) for key in (a, b, c, d)],
                                "covariances": [get("Cov_" + key) for key in rest]}
    if name == "AttEuler":
        angles = ("Heading", "Pitch", "Roll", "PitchDot", "RollDot", "HeadingDot")
        return head | {"NrSV": byte("NrSV"), "Error": m.Error, "Mode": m.Mode} | {
            key: get(key, DEG) for key in angles}
    if name == "AttCovEuler":
        square = lambda *keys: [get("Cov_" + key, DEG * DEG) for key in keys]
        return head | {"Error": m.Error, "variances": square("HeadHead", "PitchPitch", "RollRoll"),
                       "covariances": square("HeadPitch", "HeadRoll", "PitchRoll")}
    if name == "ReceiverTime":
        return head | {"DeltaLS": maybe(m.DeltaLS, (-128,)), "SyncLevel": m.SyncLevel}
    return head | {"SyncAge": m.SyncAge, "TimeScale": m.TimeScale, "Offset": None if m.Offset == -20.0 else ("rounded", m.Offset)}


def same(ours, theirs):
    """Whether a value is the same; numbers to nine digits or the oracle's rounding."""
    if isinstance(theirs, tuple):
        kind, value = theirs
        if ours is None:
            return False
        if kind == "angle":
            return abs(math.remainder(ours - value, math.tau)) < 1e-9
        if kind == "rounded to":
            return abs(ours - value) < 1e-6
        return abs(ours - value) < 6e-13  # the oracle rounds seconds to twelve digits
    if isinstance(theirs, (list, dict)):
        keys = range(len(theirs)) if isinstance(theirs, list) else theirs
        return len(ours or ()) >= len(theirs) and all(same(ours[key], theirs[key]) for key in keys)
    if isinstance(theirs, float) and not math.isfinite(theirs):
        return ours is None
    if theirs is None or ours is None:
        return theirs is None and ours is None
    return abs(ours - theirs) <= max(2e-14, 1e-9 * abs(theirs))


def parsed(protocol, frame):
    """The oracle's message, or None if it refuses the frame."""
    try:
        if protocol == "ubx":
            return UBXReader.parse(frame)
        return SBFReader.parse(frame) if protocol == "sbf" else RTCMReader.parse(frame)
    except Exception:  # each of them has its own family of errors
        return None


# ---- frames of random contents


def made(rng, count):
    """UBX and SBF frames of every message that we read, fields within what we accept."""
    stream = bytearray()
    for _ in range(count):
        for (cls, ident), name in UBX.items():
            payload = random_ubx(rng, name)
            body = struct.pack("<BBH", cls, ident, len(payload)) + payload
            stream += b"\xb5b" + body + fletcher(body) + rng.randbytes(rng.randrange(8))
        for ident, name in SBF.items():
            payload = random_sbf(rng, name)
            payload += bytes(-len(payload) % 4)
            body = struct.pack("<HH", ident | 2 << 13, 8 + len(payload)) + payload
            stream += b"$@" + struct.pack("<H", crc16(body)) + body + rng.randbytes(rng.randrange(8))
    return bytes(stream)


def random_ubx(rng, name):
    lengths = {"NAV-PVT": 92, "NAV-DOP": 18, "NAV-COV": 64, "NAV-HPPOSLLH": 36,
               "NAV-TIMEGPS": 16, "NAV-TIMELS": 24, "TIM-TP": 16,
               "NAV-POSLLH": 28, "NAV-STATUS": 16, "NAV-SOL": 52, "NAV-VELNED": 36,
               "NAV-TIMEUTC": 20, "NAV-RELPOSNED": 64}
    groups = rng.randrange(6)
    length = lengths.get(name) or (16 + 32 * groups if name == "RXM-RAWX" else 8 + 4 * groups)
    payload = bytearray(rng.randbytes(length))
    if name == "NAV-RELPOSNED":
        payload[0] = 1
    places = {"NAV-PVT": 24, "NAV-HPPOSLLH": 8, "NAV-POSLLH": 4}
    if name in places:
        at = places[name]
        struct.pack_into("<ii", payload, at, rng.randrange(-1_799_999_999, 1_799_999_999),
                         rng.randrange(-899_999_999, 899_999_999))
    if name in ("NAV-COV", "NAV-TIMELS", "NAV-HPPOSLLH"):
        payload[0 if name == "NAV-HPPOSLLH" else 4] = 0
    if name == "NAV-COV":
        payload[5:7] = bytes((rng.randrange(2), rng.randrange(2)))
    if name.startswith("RXM"):
        payload[11 if name == "RXM-RAWX" else 4] = groups
    if name == "RXM-RAWX":
        struct.pack_into("<d", payload, 0, rng.uniform(0, 604_800))
    return bytes(payload)


def random_sbf(rng, name):
    real = lambda: rng.choice((-2e10, rng.uniform(-1e3, 1e3), rng.uniform(-1, 1)))
    reals = lambda n: struct.pack(f"<{n}f", *(real() for _ in range(n)))
    head = struct.pack("<IH", rng.randrange(604_800_000), rng.choice((65535, rng.randrange(65535))))
    if name == "PVTGeodetic":
        place = (rng.uniform(-1.57, 1.57), rng.uniform(-3.14, 3.14), rng.uniform(-100, 9000))
        place = rng.choice((place, (-2e10,) * 3))
        return head + rng.randbytes(2) + struct.pack("<ddd", *place) + reals(5) + struct.pack(
            "<d", real()) + reals(1) + rng.randbytes(27)
    if name == "PVTCartesian":
        real8 = lambda: struct.pack("<d", real())
        return head + rng.randbytes(2) + real8() + real8() + real8() + reals(5) + real8() + reals(1) + (
            rng.randbytes(27))
    if name == "BaseVectorGeod":
        count = rng.randrange(4)
        vector = lambda: rng.randbytes(4) + struct.pack("<ddd", real(), real(), real()) + reals(3) + rng.randbytes(12)
        return head + bytes((count, 52)) + b"".join(vector() for _ in range(count))
    lengths = {"PosCovGeodetic": 10, "VelCovGeodetic": 10, "AttEuler": 6, "AttCovEuler": 6}
    if name in lengths:
        return head + rng.randbytes(6 if name == "AttEuler" else 2) + reals(lengths[name])
    return head + (rng.randbytes(8) if name == "ReceiverTime" else rng.randbytes(2) + reals(1))


# ---- the comparison


class Table:
    """Counts per protocol and message."""

    def __init__(self):
        self.rows = defaultdict(Counter)
        self.notes = []

    def show(self, title):
        print(f"\n### {title}\n\n| message | frames | accepted by us | by the oracle | by both | agree |")
        print("|---|---|---|---|---|---|")
        for key, row in sorted(self.rows.items()):
            cells = [row[column] for column in ("frames", "ours", "theirs", "both", "agree")]
            print("| " + " | ".join([f"{key[0]} {key[1]}"] + [f"{cell:,}" for cell in cells]) + " |")
        for note, count in Counter(self.notes).items():
            print(f"- {note}" + (f" ({count} times)" if count > 1 else ""))


def name_of(protocol, frame):
    if protocol == "ubx":
        return UBX.get((frame[2], frame[3]), "others")
    if protocol == "sbf":
        return SBF.get(struct.unpack_from("<H", frame, 4)[0] & 0x1FFF, "others")
    return "all"


def compare(program, folder, table):
    lines = subprocess.run([program, folder], capture_output=True, text=True, check=True).stdout
    cut = defaultdict(dict)
    for line in map(json.loads, lines.splitlines()):
        cut[line["file"], line["way"], line["protocol"]][line["start"], line["length"]] = line
    for path in sorted(Path(folder).iterdir()):
        data = path.read_bytes()
        for protocol in SYNCS:
            ours = cut[path.name, "mixed", protocol]
            compare_file(path.name, protocol, data, ours, table)
        compare_ways(path.name, cut, table)
        stream_reader(path.name, data, cut[path.name, "mixed", "ubx"], table)
    return cut


def compare_file(file, protocol, data, ours, table):
    found = set(scan(protocol, data))
    for start, length in sorted(found | set(ours)):
        frame = data[start:start + length]
        row = table.rows[protocol, name_of(protocol, frame)]
        row["frames"] += 1
        line, message = ours.get((start, length)), parsed(protocol, frame)
        accepted = line is not None and line["name"] != "refused"
        row["ours"] += accepted
        row["theirs"] += message is not None
        row["both"] += accepted and message is not None
        if not accepted or message is None:
            who = "we" if not accepted else "the oracle"
            why = "" if line is None else f" {line['fields'] if line['name'] == 'refused' else ''}"
            table.notes.append(f"{file}: {protocol} {identity(protocol, frame)}: {who} refuse{why}")
            continue
        row["agree"] += agree(file, protocol, frame, line, message, table)


def identity(protocol, frame):
    return frame[2:4].hex("-") if protocol == "ubx" else name_of(protocol, frame)


def agree(file, protocol, frame, line, message, table):
    name = name_of(protocol, frame)
    if protocol == "rtcm":
        return line["name"] == message.identity.split("(")[0]
    if name == "others":
        return True
    theirs = (ubx_fields if protocol == "ubx" else sbf_fields)(name, message)
    wrong = [key for key, value in theirs.items() if not same(line["fields"][key], value)]
    for key in wrong:
        table.notes.append(f"{file}: {name}.{key}: {line['fields'][key]} and {theirs[key]}: DIFFERENT")
    return not wrong


def compare_ways(file, cut, table):
    """Frames that one protocol alone finds, and all of them mixed do not, or the reverse."""
    everything = [
        (at, at + length, protocol)
        for protocol in ("ubx", "sbf", "rtcm", "nmea") for at, length in cut[file, "mixed", protocol]
    ]
    for protocol in ("nmea", "ubx", "sbf", "rtcm"):
        mixed, alone = cut[file, "mixed", protocol], cut[file, "alone", protocol]
        row = table.rows["cutting", protocol]
        row["frames"] += len(set(mixed) | set(alone))
        row["ours"] += len(mixed)
        row["theirs"] += len(alone)
        row["both"] += len(set(mixed) & set(alone))
        row["agree"] += len(set(mixed) & set(alone))
        for at, length in sorted(set(mixed) ^ set(alone)):
            which = mixed.get((at, length)) or alone[at, length]
            inside = [who for start, end, who in everything if start <= at and at + length <= end
                      and (start, end - start) != (at, length)]
            way = "mixed" if (at, length) in mixed else "alone"
            where = f"inside a frame of {inside[0]}" if inside else f"{which['name']!r}, in no other frame"
            table.notes.append(f"{file}: {protocol} found only {way}: {where}")


def stream_reader(file, data, ours, table):
    """Frames that pyubx2's own reader of streams finds."""
    theirs, failures = Counter(), 0
    reader = UBXReader(BytesIO(data), protfilter=UBX_PROTOCOL, quitonerror=ERR_IGNORE, parsing=False)
    while True:
        try:
            raw, _ = reader.read()
        except UnicodeDecodeError:  # of bytes after a dollar; it goes on behind them
            failures += 1
            continue
        if raw is None:
            break
        theirs[raw] += 1
    if failures:
        table.notes.append(f"{file}: pyubx2's reader fails on bytes that are no text, {failures} times")
    mine = Counter(data[at:at + length] for at, length in ours)
    row = table.rows["pyubx2's reader", "ubx"]
    row["frames"] += sum((mine | theirs).values())
    row["ours"] += sum(mine.values())
    row["theirs"] += sum(theirs.values())
    row["both"] += sum((mine & theirs).values())
    row["agree"] += sum((mine & theirs).values())
    if mine != theirs:
        lost, extra = sum((mine - theirs).values()), sum((theirs - mine).values())
        table.notes.append(f"{file}: of pyubx2's reader: {lost} frames fewer and {extra} more than ours")


def pulses(cut):
    """Each TIM-TP against the NAV-TIMEGPS of its second: the next whole second, in UTC."""
    waits = Counter()
    for (file, way, protocol), lines in cut.items():
        if (way, protocol) != ("mixed", "ubx"):
            continue
        gps = None
        for _, line in sorted(lines.items()):
            fields = line["fields"]
            if line["name"] == "NAV-TIMEGPS":
                gps, leaps = fields["gps"], fields["leapS"]
            if line["name"] == "TIM-TP" and gps and "utc" in (fields["pulse"] or {}):
                utc = gps + (315_964_800 - (leaps or 0)) * 10**9
                waits[round((fields["pulse"]["utc"] - utc) / 1e9, 3), leaps] += 1
    print("\nTIM-TP: seconds from the last NAV-TIMEGPS to the pulse, leap seconds: how often")
    for key, count in sorted(waits.items(), key=str):
        print(f"- {key}: {count}")


def main():
    program, folder = sys.argv[1:]
    table = Table()
    cut = compare(program, folder, table)
    table.show("Logs")
    pulses(cut)
    random_table = Table()
    with tempfile.TemporaryDirectory() as made_folder:
        (Path(made_folder) / "made").write_bytes(made(random.Random(1), 2000))
        compare(program, made_folder, random_table)
    random_table.show("Random contents")
    wrong = [note for note in table.notes + random_table.notes if note.endswith("DIFFERENT")]
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
