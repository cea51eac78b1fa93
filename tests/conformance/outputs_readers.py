"""What independent readers make of the sentences of a port. For outputs.py.

Every reader gives, for each sentence, a list of readings {quantity: (value, half a step)}; an empty list
if it does not know the sentence or makes nothing of it, None if it refuses it, and ABSENT if it was not
shown it. Half a step is what the reader's own text hides. Quantities, all with the signs of the truth table:

lat, lon deg; height m above the ellipsoid; heading, course deg true, heading_m, course_m deg magnetic;
roll deg + starboard down; heel deg, the same against the horizon; pitch deg + bow up; heave m + up;
heave_rate m/s + up; sog, ahead, starboard, vn, ve, vd m/s; rot deg/min + to starboard; clock s of the
day; day since 1970.
"""

import bisect
import datetime
import decimal
import json
import math
import os
import re
import subprocess
import warnings

try:
    import pynmea2
except ImportError:
    pynmea2 = None
try:
    import pynmeagps
except ImportError:
    pynmeagps = None

from outputs_layouts import KNOT, WITHOUT_CHECKSUM, day_of

ABSENT = object()
DEG = math.pi / 180


# The decoders of PyPI. Their numbers carry no digits, so half a step is that of the layout.


def plain(names, get, factors=None):
    """{quantity: value} of the attributes that are there."""
    out = {}
    for quantity, name in names.items():
        value = get(name)
        if value not in (None, ""):
            out[quantity] = float(value) * (factors or {}).get(quantity, 1)
    return out


def day_second(value):
    if value in (None, ""):
        return None
    return value.hour * 3600 + value.minute * 60 + value.second + value.microsecond * 1e-6


def timed(out, time, date=None):
    if day_second(time) is not None:
        out["clock"] = day_second(time)
    if date not in (None, ""):
        out["day"] = day_of(date.year, date.month, date.day)
    return out


def magnetic(out, get, names):
    """Magnetic and true heading of HDG from reading, deviation and variation with their letters."""
    reading, deviation, deviation_side, variation, variation_side = (get(name) for name in names)

    def signed(value, side):
        return -float(value) if side == "W" else float(value)

    if reading not in (None, ""):
        out["heading_m"] = float(reading)
        if deviation not in (None, ""):
            out["heading_m"] += signed(deviation, deviation_side)
        if variation not in (None, ""):
            out["heading"] = out["heading_m"] + signed(variation, variation_side)
    return out


def height(out, get, msl, geoid):
    if get(msl) not in (None, "") and get(geoid) not in (None, ""):
        out["height"] = float(get(msl)) + float(get(geoid))
    return out


GPS_NAMES = {
    "HDT": {"heading": "headingT"}, "HDM": {"heading_m": "headingM"}, "THS": {"heading": "headt"},
    "HCR": {"heading": "headingt"}, "ROT": {"rot": "rot"},
    "GGA": {"lat": "lat", "lon": "lon"}, "GNS": {"lat": "lat", "lon": "lon"},
    "GLL": {"lat": "lat", "lon": "lon"},
    "RMC": {"lat": "lat", "lon": "lon", "sog": "spd", "course": "cog"},
    "VTG": {"course": "cogt", "course_m": "cogm", "sog": "sogn"},
    "VBW": {"ahead": "longgroundspd", "starboard": "transgroundspd"},
    "VHW": {"heading": "hdgT", "heading_m": "hdgM"},
    "PASHR": {"heading": "trueHdg", "roll": "roll", "pitch": "pitch", "heave": "reserved"},
    "PFEC,GPatt": {"heading": "yaw", "pitch": "pitch", "roll": "roll"},
    "PFEC,GPhve": {"heave": "heave"},
}
PYNMEA2_NAMES = {
    "HDT": {"heading": "heading"}, "HDM": {"heading_m": "heading"}, "ROT": {"rot": "rate_of_turn"},
    "RMC": {"sog": "spd_over_grnd", "course": "true_course"},
    "VTG": {"course": "true_track", "course_m": "mag_track", "sog": "spd_over_grnd_kts"},
    "VBW": {"ahead": "lon_grnd_spd", "starboard": "trans_grnd_spd"},
    "VHW": {"heading": "heading_true", "heading_m": "heading_magnetic"},
    "PASHR": {"heading": "true_heading", "roll": "roll", "pitch": "pitch", "heave": "heave"},
    "PSXN,23": {"heading": "head", "roll": "roll", "pitch": "pitch", "heave": "heave"},
    "PSXN,24": {"heave_rate": "vertical_vel"},
}
IN_KNOTS = {"sog": KNOT, "ahead": KNOT, "starboard": KNOT}


class PyPi:
    """A decoder of PyPI. It hands on heave and its rate as sent, which are positive downward in PASHR and
    PSXN, but for the sentences of `heave_up`."""

    def __init__(self, heave_up):
        self.heave_down = {"PASHR", "PSXN,23", "PSXN,24"} - heave_up

    def read(self, sentences):
        return [self.attempt(each) if each.text.startswith("$") else ABSENT for each in sentences]

    def attempt(self, sentence):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                out = self.decode(sentence)
        except Exception as fault:  # whatever a decoder raises, it has refused, or does not know it
            return [] if self.is_unknown(fault) else None
        if out is None:
            return []
        if sentence.kind in self.heave_down:
            out |= {name: -out[name] for name in ("heave", "heave_rate") if name in out}
        hidden = {"lat": self.degrees, "lon": self.degrees}
        return [{name: (value, hidden.get(name, 0)) for name, value in out.items()}]


class Pynmeagps(PyPi):
    name = f"pynmeagps {pynmeagps.version}" if pynmeagps else None
    degrees = 5e-11  # it rounds them to ten decimals

    def is_unknown(self, fault):
        return "Unknown" in str(fault)

    def decode(self, sentence):
        check = pynmeagps.VALNONE if sentence.kind in WITHOUT_CHECKSUM else pynmeagps.VALCKSUM
        message = pynmeagps.NMEAReader.parse(sentence.text, validate=check)
        if hasattr(message, "field_01"):
            return None  # it has numbered the fields of a sentence that it does not know

        def get(name):
            return getattr(message, name, None)

        out = plain(GPS_NAMES.get(sentence.kind, {}), get, IN_KNOTS)
        if sentence.kind == "XDR":
            out = transducers((get(f"tdrid_{n:02d}"), get(f"data_{n:02d}")) for n in range(1, 10))
        if sentence.kind == "HDG":
            names = ("headingM", "deviation", "deviationEW", "variation", "variationEW")
            out = magnetic(out, get, names)
        if sentence.kind == "ZDA" and get("year"):
            return timed(out, get("time"), datetime.date(get("year"), get("month"), get("day")))
        out = height(out, get, "alt", "sep") if sentence.kind in ("GGA", "GNS") else out
        return timed(out, get("time") or get("utctime"), get("date"))


class Pynmea2(PyPi):
    name = f"pynmea2 {pynmea2.__version__}" if pynmea2 else None
    degrees = 0

    def is_unknown(self, fault):
        return isinstance(fault, pynmea2.SentenceTypeError)

    def decode(self, sentence):
        message = pynmea2.parse(sentence.text, check=sentence.kind not in WITHOUT_CHECKSUM)
        if not getattr(message, "fields", None):
            return None

        def get(name):
            return getattr(message, name, None)

        out = plain(PYNMEA2_NAMES.get(sentence.kind, {}), get, IN_KNOTS)
        if sentence.kind in ("GGA", "GNS", "GLL", "RMC") and get("lat") and get("lon"):
            out |= {"lat": message.latitude, "lon": message.longitude}
        if sentence.kind == "XDR":
            data = message.data
            out = transducers((data[n + 3], data[n + 1]) for n in range(0, len(data) - 3, 4))
        if sentence.kind == "HDG":
            names = ("heading", "deviation", "dev_dir", "variation", "var_dir")
            out = magnetic(out, get, names)
        if sentence.kind == "ZDA" and get("year"):
            date = datetime.date(int(get("year")), int(get("month")), int(get("day")))
            return timed(out, get("timestamp"), date)
        out = height(out, get, "altitude", "geo_sep") if sentence.kind in ("GGA", "GNS") else out
        return timed(out, get("timestamp"), get("datestamp"))


def transducers(pairs):
    names = {"PITCH": "pitch", "PTCH": "pitch", "ROLL": "roll", "HEAVE": "heave"}
    known = ((names.get(str(name).upper()), value) for name, value in pairs)
    return {name: float(value) for name, value in known if name and value not in (None, "")}


class SignalK:
    """Signal K's parser, through signalk.cjs."""

    PATHS = {
        "navigation.headingTrue": ("heading", 1 / DEG),
        "navigation.headingMagnetic": ("heading_m", 1 / DEG),
        "navigation.courseOverGroundTrue": ("course", 1 / DEG),
        "navigation.courseOverGroundMagnetic": ("course_m", 1 / DEG),
        "navigation.speedOverGround": ("sog", 1),
        "navigation.rateOfTurn": ("rot", 60 / DEG),
    }

    def __init__(self):
        self.script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "signalk.cjs")
        self.name = self.run("--version").strip()

    def run(self, *arguments, **more):
        return subprocess.run(
            ["node", self.script, *arguments], check=True, capture_output=True, text=True, **more
        ).stdout

    def read(self, sentences):
        shown = [sentence for sentence in sentences if "*" in sentence.text]
        answers = iter(self.run(input="".join(each.text + "\n" for each in shown)).splitlines())
        return [self.one(json.loads(next(answers))) if "*" in each.text else ABSENT for each in sentences]

    def one(self, answer):
        if "refused" in answer:
            return None
        out, values = {}, answer.get("values", {})
        for path, (quantity, factor) in self.PATHS.items():
            if values.get(path) is not None:
                out[quantity] = values[path] * factor, 0
        position = values.get("navigation.position")
        if position:
            out |= {"lat": (position["latitude"], 0), "lon": (position["longitude"], 0)}
        msl = values.get("navigation.gnss.antennaAltitude")
        geoid = values.get("navigation.gnss.geoidalSeparation")
        if msl is not None and geoid is not None:
            out["height"] = msl + geoid, 0
        when = values.get("navigation.datetime")
        if when:
            out |= instant(when, 0.0005)
        return [out] if out else []


def instant(text, step):
    """clock and day of 2026-11-21T12:00:00.100Z."""
    when = datetime.datetime.fromisoformat(text.replace("Z", "+00:00"))
    return {"clock": (day_second(when), step), "day": (day_of(when.year, when.month, when.day), 0)}


def following(places, last):
    """The first of the places behind the last one."""
    index = bisect.bisect_right(places, last)
    return places[index] if index < len(places) else None


class Gpsd:
    """gpsd's decoder: `gpsdecode -v` and `gpspipe -r -w` print a sentence and then what gpsd reports.

    A report repeats what was known before, and a live gpsd reports once in an epoch. So each field counts
    for the last sentence of its epoch that carries it, and once; what gpsd works out itself does not. It
    passes over a VTG without a course or with mode E or N, and makes a speed from the positions.
    """

    SOURCES = {
        "lat": "GGA GNS GLL RMC", "lon": "GGA GNS GLL RMC", "altHAE": "GGA GNS",
        "speed": "RMC VTG", "track": "RMC VTG", "magtrack": "RMC VTG HDG",
        "heading": "HDT PASHR", "rot": "ROT", "pitch": "XDR PASHR", "roll": "XDR PASHR",
        "time": "GGA GNS GLL RMC",
    }
    NAMES = {"altHAE": "height", "speed": "sog", "track": "course", "magtrack": "course_m"}
    def __init__(self, program=None, log=None):
        self.program, self.log = program, log
        if program:
            answer = subprocess.run([program, "-V"], capture_output=True, text=True)
            version = re.search(r"[0-9]+\.[0-9][^ ,\n]*", answer.stdout + answer.stderr)
            self.name = f"gpsd {version.group(0) if version else ''}"
        else:
            release = re.search(r'"release":"([^"]*)"', self.text())
            self.name = f"gpsd {release.group(1) if release else ''} live"

    def text(self, raw=b""):
        if self.log:
            with open(self.log, encoding="latin-1") as file:
                return file.read()
        return subprocess.run(
            [self.program, "-v"], input=raw, capture_output=True, check=True
        ).stdout.decode("latin-1")

    def read(self, sentences, raw=b""):
        out = [None if "*" in sentence.text else ABSENT for sentence in sentences]
        places = {}
        for place, sentence in enumerate(sentences):
            places.setdefault(sentence.text, []).append(place)
        first, last, here, carriers = None, -1, None, {}
        for line in self.text(raw).splitlines():
            if line.startswith("$"):
                here = following(places.get(line.strip(), []), last)
                if here is None or first is None and self.log and not sentences[here].clock:
                    here = None  # a log is joined at a sentence that has a time
                    continue
                if sentences[here].row != sentences[last].row:
                    carriers = {}
                kind = "" if self.is_passed_over(sentences[here]) else sentences[here].kind
                carriers |= {name: here for name, kinds in self.SOURCES.items() if kind in kinds.split()}
                first = here if first is None else first
                last, out[here] = here, []
            elif line.startswith("{") and here is not None:
                self.report(line, carriers, out)
        return self.shown(sentences, out, first, last)

    @staticmethod
    def is_passed_over(sentence):
        return sentence.kind == "VTG" and ("VTG,," in sentence.body or sentence.body[-2:] in (",E", ",N"))

    def shown(self, sentences, out, first, last):
        """Parts from the refused what it was not shown, before and behind a live log, and what it does not
        know: a sentence whose talker its lexer never lets pass."""
        if self.log and first is not None:
            out[:first] = [ABSENT] * first
            out[last + 1 :] = [ABSENT] * (len(out) - last - 1)
        talkers = {each.text[1:3] for each, found in zip(sentences, out) if isinstance(found, list)}
        return [[] if found is None and each.text[1:3] not in talkers else found
                for each, found in zip(sentences, out)]

    def report(self, line, carriers, out):
        """Hands the fields of a report to the sentences that carry them."""
        try:
            report = json.loads(line, parse_float=decimal.Decimal)
        except ValueError:
            return
        if report.get("class") not in ("TPV", "ATT"):
            return
        for name in [name for name in carriers if name in report]:
            reading = instant(report[name], 0.0005) if name == "time" else {
                self.NAMES.get(name, name): (float(report[name]), half_a_digit(report[name]))}
            out[carriers.pop(name)].append(reading)


def half_a_digit(number):
    return 0.5 * 10.0 ** decimal.Decimal(number).as_tuple().exponent
