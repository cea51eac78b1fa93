"""Sentences by their layouts alone, for outputs.py: a reader as independent of the others as of ours.

The layouts are patterns in the manner of the device definitions of OpenRVDAS. They were written from the
makers' and others' descriptions of each sentence, not from our Rust code. The quantities and their senses
are those of outputs_readers.py.
"""

import datetime
import re

KNOT = 1852 / 3600

# {name} is a number; {name:c} letters; {name:t} hhmmss.s; {name:m} degrees and minutes; {} anything.
# "--" stands for any talker. All fields may be empty. A name with a unit or a sense at its end
# (_kn, _kmh, _down, _cm, _centi, _tenth) is turned into SI, degrees and the senses above.
LAYOUTS = [
    "--HDT,{heading},T",
    "--THS,{heading},{mode:c}",
    "--HDM,{heading_m},M",
    "--HDG,{reading},{deviation},{deviation_side:c},{variation},{variation_side:c}",
    "--HCR,{heading},{mode:c},{},{}",
    "--ROT,{rot},{status:c}",
    "--GGA,{clock:t},{lat:m},{ns:c},{lon:m},{ew:c},{quality},{},{},{msl},{},{geoid},{},{},{}",
    "--GNS,{clock:t},{lat:m},{ns:c},{lon:m},{ew:c},{mode:c},{},{},{msl},{geoid},{},{}",
    "--GNS,{clock:t},{lat:m},{ns:c},{lon:m},{ew:c},{mode:c},{},{},{msl},{geoid},{},{},{nav:c}",
    "--GLL,{lat:m},{ns:c},{lon:m},{ew:c},{clock:t},{status:c},{mode:c}",
    "--RMC,{clock:t},{status:c},{lat:m},{ns:c},{lon:m},{ew:c},{sog_kn},{course},{date:c},"
    "{variation},{variation_side:c},{mode:c}",
    "--RMC,{clock:t},{status:c},{lat:m},{ns:c},{lon:m},{ew:c},{sog_kn},{course},{date:c},"
    "{variation},{variation_side:c},{mode:c},{nav:c}",
    "--VTG,{course},T,{course_m},M,{sog_kn},N,{sog2_kmh},K,{mode:c}",
    "--VBW,{},{},{},{ahead_kn},{starboard_kn},{status:c},{},{},{},{}",
    "--VHW,{heading},T,{heading_m},M,{},N,{},K",
    "--ZDA,{clock:t},{dd},{mm},{yyyy},{},{}",
    "--DTM,{},{},{},{},{},{},{},{}",
    "--GST,{clock:t},{},{},{},{},{},{},{}",
    "--GBS,{clock:t},{},{},{},{},{},{},{}",
    "PASHR,{clock:t},{heading},T,{roll},{pitch},{heave_down},{},{},{},{quality}",
    "PASHR,{clock:t},{heading},T,{roll},{pitch},{heave_down},{},{},{},{quality},{status}",
    "PSXN,20,{},{},{},{}",
    "PSXN,23,{roll},{pitch},{heading},{heave_down}",
    "PSXN,24,{},{},{},{heave_rate_down}",
    "PHTRO,{tilt},{tilt_side:c},{list},{list_side:c}",
    "PHLIN,{},{},{heave}",
    "PHSPD,{},{},{heave_rate}",
    "PHCMP,{lat:m},{ns:c},{sog_kn},{unit:c}",
    "PHINF,{status:c}",
    "PHOCT,01,{clock:t},{},{},{heading},{},{roll},{},{pitch_down},{},{},{},{heave},{},{},{},{},{},{rot}",
    "PIXSE,ATITUD,{roll},{pitch_down}",
    "PIXSE,POSITI,{lat},{lon},{}",
    "PIXSE,SPEED_,{ve},{vn},{vu_up}",
    "PIXSE,UTMWGS,{},{},{},{},{}",
    "PIXSE,HEAVE_,{},{},{heave}",
    "PIXSE,TIME__,{clock:t}",
    "PIXSE,STDHRP,{},{},{}",
    "PIXSE,STDPOS,{},{},{}",
    "PIXSE,STDSPD,{},{},{}",
    "PIXSE,ALGSTS,{},{}",
    "PIXSE,STATUS,{},{}",
    "PIXSE,HT_STS,{}",
    "PRDID,{pitch},{roll},{heading}",
    "PFEC,GPatt,{heading},{pitch},{roll}",
    "PTNTHTM,{heading},{},{pitch},{},{roll},{},,",
    "PFEC,GPhve,{heave},{status:c}",
    "PSAT,HPR,{clock:t},{heading},{pitch},{roll},{status:c}",
]

# Lines without a checksum: TSS1, HHRP2 and KVH. Heave in cm, angles in 0.01 deg; KVH in 0.1 deg. The roll of
# TSS1 is the starboard side's angle with the horizon.
NUMBER = r"[ -]\d{4}"
LINES = {
    "TSS1": rf":[0-9A-F]{{6}} (?P<heave_cm>{NUMBER})(?P<status>[UuGgHhFf])(?P<heel_centi>{NUMBER}) "
            rf"(?P<pitch_centi>{NUMBER})",
    "HHRP2": rf":(?P<heading_centi>\d{{5}}) (?P<heave_cm>{NUMBER})(?P<status>[A-Za-z])"
             rf"(?P<roll_centi>{NUMBER}) (?P<pitch_centi>{NUMBER})[A-Za-z]",
    "KVH": r"%(?P<pitch_tenth>-?\d+),(?P<roll_tenth_down>-?\d+),(?P<heading_tenth>\d+)",
}
LINES = {kind: re.compile(pattern) for kind, pattern in LINES.items()}
WITHOUT_CHECKSUM = {"PRDID", "PFEC,GPatt", *LINES}

FIELD = {
    "": r"(?:[+-]?\d+(?:\.\d*)?)?", "c": r"[A-Za-z0-9]*", "t": r"(?:\d{6}(?:\.\d*)?)?",
    "m": r"(?:\d{3,}(?:\.\d*)?)?",
}
SCALE = {"_kn": KNOT, "_kmh": 1 / 3.6, "_down": -1, "_up": -1, "_cm": 0.01, "_centi": 0.01, "_tenth": 0.1}
MARKS = ("quality", "status", "mode", "nav")


def compiled(layout):
    """A layout as a regular expression with named groups."""
    pattern = ""
    for place, text in enumerate(re.split(r"\{([^}]*)\}", layout.removeprefix("--"))):
        name, _, sort = text.partition(":")
        if place % 2 == 0:
            pattern += re.escape(text)
        else:
            pattern += f"(?P<{name}>{FIELD[sort]})" if name else "[^,]*"
    return re.compile(("[A-Z]{2}" if layout.startswith("--") else "") + pattern)


def kind_of(body):
    """GGA of INGGA; a proprietary sentence with its subtype."""
    fields = body.split(",")
    if not fields[0].startswith("P"):
        return fields[0][2:]
    if fields[0] in ("PSXN", "PIXSE", "PFEC", "PINSD") and len(fields) > 1:
        return fields[0] + "," + fields[1]
    return fields[0]


def layouts():
    table = {}
    for layout in LAYOUTS:
        kind = kind_of(layout.replace("--", "XX"))
        table.setdefault(kind, []).append(compiled(layout))
    return table


PATTERNS = layouts()


def step_of(text):
    """Half a unit of the last digit of a number."""
    return 0.5 * 10.0 ** -len(text.partition(".")[2])


def minutes(text, side):
    """Degrees, and half a step, of ddmm.mmm and its letter."""
    whole = text.split(".")[0]
    value = int(whole[:-2] or 0) + float(text[len(whole) - 2:]) / 60
    return (-value if side in ("S", "W") else value), step_of(text) / 60


def clock(text):
    return int(text[:2]) * 3600 + int(text[2:4]) * 60 + float(text[4:]), step_of(text)


def scaled(name, text):
    """(quantity, value, half a step) of a field whose name may end with units and senses."""
    value, step = float(text.replace(" ", "")), step_of(text)
    found = True
    while found:
        found = next((end for end in SCALE if name.endswith(end)), None)
        if found:
            name = name[: -len(found)]
            value, step = value * SCALE[found], step * abs(SCALE[found])
    return ("vd" if name == "vu" else name), value, step


def day_of(year, month, day):
    return (datetime.date(year, month, day) - datetime.date(1970, 1, 1)).days


def sided(fields, value, side, negative):
    """A magnitude and its letter, as (value, half a step), or None."""
    if not fields.get(value) or not fields.get(side):
        return None
    sign = -1 if fields[side] == negative else 1
    return sign * float(fields[value]), step_of(fields[value])


def position(fields):
    pairs = (("lat", "ns"), ("lon", "ew"))
    return {name: minutes(fields[name], fields[side]) for name, side in pairs
            if fields.get(name) and fields.get(side)}


def leaning(fields):
    """Pitch and roll of PHTRO: bow up and port up are positive, by letters."""
    pitch, roll = sided(fields, "tilt", "tilt_side", "P"), sided(fields, "list", "list_side", "B")
    return ({"pitch": pitch} if pitch else {}) | ({"roll": roll} if roll else {})


def calendar(fields):
    out = {"clock": clock(fields["clock"])} if fields.get("clock") else {}
    if fields.get("yyyy"):
        out["day"] = day_of(int(fields["yyyy"]), int(fields["mm"]), int(fields["dd"])), 0
    if fields.get("date"):
        text = fields["date"]
        out["day"] = day_of(2000 + int(text[4:]), int(text[2:4]), int(text[:2])), 0
    return out


def height(fields):
    if not fields.get("msl") or not fields.get("geoid"):
        return {}
    step = step_of(fields["msl"]) + step_of(fields["geoid"])
    return {"height": (float(fields["msl"]) + float(fields["geoid"]), step)}


def compass(fields):
    """Variation, and of HDG the magnetic and the true heading."""
    variation = sided(fields, "variation", "variation_side", "W")
    out = {"variation": variation} if variation else {}
    if fields.get("reading"):
        deviation = sided(fields, "deviation", "deviation_side", "W") or (0.0, 0.0)
        step = step_of(fields["reading"]) + deviation[1]
        out["heading_m"] = float(fields["reading"]) + deviation[0], step
        if variation:
            out["heading"] = out["heading_m"][0] + variation[0], step + variation[1]
    return out


ELSEWHERE = {
    "clock", "dd", "mm", "yyyy", "date", "msl", "geoid", "variation", "reading", "deviation", "ns", "ew",
    "tilt", "list", "unit", *MARKS,
}


def readings_of(fields, heave_is_up):
    """What the fields of a layout say, with the senses of the truth."""
    out = position(fields) | leaning(fields) | calendar(fields) | height(fields) | compass(fields)
    second, skip = {}, ELSEWHERE | ({"lat", "lon"} if "ns" in fields else set())
    for name, text in fields.items():
        if text and name not in skip and not name.endswith("_side"):
            quantity, value, step = scaled(name, text)
            if quantity == "sog2":
                second["sog"] = value, step
            else:
                out[quantity] = value, step
    if heave_is_up and "heave_down" in fields and "heave" in out:
        out["heave"] = -out["heave"][0], out["heave"][1]
    return [out] + ([second] if second else [])


def xdr(body):
    """Roll, pitch and heave of an XDR by the names that are in use; they are not standard."""
    names = {"PITCH": "pitch", "PTCH": "pitch", "ROLL": "roll", "HEAVE": "heave"}
    fields = body.split(",")[1:]
    if len(fields) % 4:
        return None
    out = {}
    for place in range(0, len(fields), 4):
        _, value, _, name = fields[place : place + 4]
        if value and name.upper() in names:
            out[names[name.upper()]] = float(value), step_of(value)
    return [out]


class Layout:
    """By layout alone, and the marks of quality that it finds."""

    name = "layout"

    def __init__(self, heave_up):
        self.heave_up = heave_up

    def fields(self, sentence):
        """The named groups of a sentence, or None."""
        if sentence.kind in LINES:
            match = LINES[sentence.kind].fullmatch(sentence.text)
            return match and match.groupdict()
        matches = (pattern.fullmatch(sentence.body) for pattern in PATTERNS.get(sentence.kind, []))
        return next((match.groupdict() for match in matches if match), None)

    def read(self, sentences):
        return [self.one(sentence) for sentence in sentences]

    def one(self, sentence):
        if not sentence.good:
            return None
        if sentence.kind == "XDR":
            return xdr(sentence.body)
        fields = self.fields(sentence)
        if fields is None:
            return None if sentence.kind in PATTERNS or sentence.kind in LINES else []
        return readings_of(fields, sentence.kind in self.heave_up)

    def marks(self, sentence):
        fields = (self.fields(sentence) if sentence.good else None) or {}
        return [f"{name} {fields[name] or 'empty'}" for name in MARKS if name in fields]
