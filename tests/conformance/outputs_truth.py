"""The truth of a voyage at the epochs of its output ports, for outputs.py."""

import bisect
import csv
import math

import outputs_layouts as layouts

DEG = math.pi / 180
DAY = 86400.0
NAMES = {
    "lat": "lat_deg", "lon": "lon_deg", "height": "height_m", "heading": "heading_deg",
    "course": "cog_deg", "roll": "roll_deg", "pitch": "pitch_deg", "heave": "heave_m",
    "sog": "sog_mps", "rot": "rot_deg_min", "vn": "vn", "ve": "ve", "vd": "vd",
}
TURNS = {"heading", "heading_m", "course", "course_m"}


class Truth:
    """The epochs of the truth table."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            table = [row for row in csv.DictReader(file) if row["utc_s"]]  # none before UTC is known
        self.step_of = {name: min(layouts.step_of(row[name]) for row in table) for name in table[0]}
        self.rows = [{name: float(text) for name, text in row.items() if text} for row in table]
        self.times = [row["utc_s"] for row in self.rows]
        self.undamped = [row.get("rot_deg_min") for row in self.rows]
        gaps = sorted(b - a for a, b in zip(self.times, self.times[1:]))
        self.period = gaps[len(gaps) // 2] if gaps else 1.0

    def damp(self, constant, start):
        """Puts the rate of turn through a low pass of first order, from an epoch on; 0 s for none."""
        last = None
        for place, (row, time, rate) in enumerate(zip(self.rows, self.times, self.undamped)):
            if rate is None or place < start:
                last = None
            elif last is None or not constant:
                last = time, rate
            else:
                last = time, last[1] + (rate - last[1]) * -math.expm1((last[0] - time) / constant)
            if rate is not None:
                row["rot_deg_min"] = last[1] if last else rate

    def is_unknown(self, quantity, place):
        """Whether the table has a column for a quantity, and nothing in it at this epoch."""
        name = NAMES.get(quantity)
        return name in self.step_of and name not in self.rows[place]

    def nearest(self, time):
        place = bisect.bisect_left(self.times, time)
        near = [p for p in (place - 1, place) if 0 <= p < len(self.times)]
        return min(near, key=lambda p: abs(self.times[p] - time))

    def value(self, quantity, place, variation=None):
        """(value, half a step) of a quantity, or None if the table does not know it."""
        row, step = self.rows[place], self.step_of
        if quantity in NAMES:
            name = NAMES[quantity]
            if quantity == "course" and row.get("sog_mps", 1.0) < 0.1:
                return None
            return (row[name], step[name]) if name in row else None
        if quantity in ("heading_m", "course_m") and variation:
            true = self.value("heading" if quantity == "heading_m" else "course", place)
            return true and (true[0] - variation[0], true[1] + variation[1])
        if quantity == "heel" and {"roll_deg", "pitch_deg"} <= row.keys():
            rise = math.sin(row["roll_deg"] * DEG) * math.cos(row["pitch_deg"] * DEG)
            return math.asin(rise) / DEG, step["roll_deg"]
        if quantity == "heave_rate":
            return self.of_heave(place)
        if quantity in ("ahead", "starboard"):
            return self.of_hull(quantity, row)
        return self.of_time(quantity, row["utc_s"])

    def of_heave(self, place):
        """Rate of the heave, from its changes before and behind; not where a correction has shifted it."""
        heave = [row.get("heave_m") for row in self.rows[max(0, place - 2) : place + 3]]
        if len(heave) < 5 or None in heave:
            return None
        before = (3 * heave[2] - 4 * heave[1] + heave[0]) / (2 * self.period)
        behind = (4 * heave[3] - 3 * heave[2] - heave[4]) / (2 * self.period)
        return ((before + behind) / 2, 0.003) if abs(before - behind) < 0.005 else None

    def of_hull(self, quantity, row):
        if not {"vn", "ve", "heading_deg"} <= row.keys():
            return None
        cos, sin = math.cos(row["heading_deg"] * DEG), math.sin(row["heading_deg"] * DEG)
        ahead = row["vn"] * cos + row["ve"] * sin
        starboard = row["ve"] * cos - row["vn"] * sin
        turn = math.hypot(ahead, starboard) * self.step_of["heading_deg"] * DEG
        step = self.step_of["vn"] + self.step_of["ve"] + turn
        return (ahead if quantity == "ahead" else starboard), step

    def of_time(self, quantity, utc):
        if quantity == "clock":
            return utc % DAY, self.step_of["utc_s"]
        if quantity == "day":
            return math.floor((utc + 1e-6) / DAY), 0
        return None


def difference(quantity, theirs, true, latitude):
    """How far apart, in the unit of the table."""
    apart = theirs - true
    if quantity in TURNS or quantity == "lon":
        apart = (apart + 180) % 360 - 180
    if quantity == "clock":
        apart = (apart + DAY / 2) % DAY - DAY / 2
    return apart * metres(quantity, latitude)


def metres(quantity, latitude):
    """Metres of a degree; 1 for all that are no positions."""
    if quantity not in ("lat", "lon"):
        return 1.0
    sine = math.sin(latitude * DEG)
    across = 6378137.0 / math.sqrt(1 - 6.69437999014e-3 * sine * sine)
    if quantity == "lon":
        return across * math.cos(latitude * DEG) * DEG
    return across * (1 - 6.69437999014e-3) / (1 - 6.69437999014e-3 * sine * sine) * DEG
