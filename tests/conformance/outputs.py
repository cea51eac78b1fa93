#!/usr/bin/env python3
"""What independent readers find in the bytes of output ports, beside the truth of the voyage.

    tests/conformance/outputs.py TRUTH.csv PORT... [--gpsdecode PROGRAM]... [--gpsd-log LOG]...
        [--first NAME=KIND]... [--rot-damping NAME=SECONDS]... [--full]

- TRUTH: a row for each epoch, with the columns utc_s (Unix time), lat_deg, lon_deg, height_m
  (ellipsoid), heading_deg, roll_deg (+ starboard down), pitch_deg (+ bow up), heave_m (+ up), sog_mps,
  cog_deg, rot_deg_min (+ to starboard), vn, ve, vd (m/s), all for the point that the ports speak of.
  What is not known is empty, and a reader that finds a value then has found a difference.
- PORT: the bytes that a port has sent, as they left; UDP datagrams one behind the other. Its NAME is that of
  the file without its ending.
- PROGRAM: gpsd's `gpsdecode`; LOG: what `gpspipe -r -w` has printed of a live gpsd on the only port.

Readers: pynmeagps and pynmea2 (PyPI), Signal K's parser (npm; NODE_PATH names its folder), gpsd, and
layouts written by themselves (outputs_layouts.py). Those that are not installed are left out and named.

A sentence with a time of day belongs to that epoch. One without is counted between the epochs of its
neighbours that have one. In which order the sentences of an epoch leave is known from the one that leaves
first: that of `--first`, else the first of the file. Where the count does not fit, because a
sentence was dropped, the likeliest epoch within one period is taken, and counted as "near". A port
without any time is counted from the epoch that fits the whole file best, so that a constant delay of it
would not be seen.

A difference may be half a step of the last digit, on the wire, in the reader's text and in the truth,
plus 1e-6 of the value for constants such as that of the knot; `--allow QUANTITY=VALUE` adds to it. Ends
with 1 if a byte is in no sentence, if a reader refuses a sentence, or if a difference is greater and has
no reason.
"""

import argparse
import bisect
import collections
import os
import re
import sys

import outputs_layouts as layouts
import outputs_readers as readers
import outputs_report as reporting
from outputs_truth import DAY, NAMES, Truth, difference, metres

SENTENCE = re.compile(r"\$([ -#%-)+-~]*)\*([0-9A-Fa-f]{2})")
ENVELOPE = re.compile(r"(?:UdPbC\0)?(?:\\[^\\]*\\)*")


class Sentence:
    """One sentence, and the epoch that it belongs to."""

    def __init__(self, text, body, good):
        self.text, self.body, self.good = text, body, good
        self.kind = layouts.kind_of(body)
        self.clock = self.row = self.how = self.variation = None
        self.steps = {}


# Cutting.


def checksum(body):
    total = 0
    for byte in body.encode("latin-1"):
        total ^= byte
    return total


def cut(raw):
    """The sentences, and the bytes that are in none."""
    sentences, rest = [], []
    for line in raw.decode("latin-1").split("\n"):
        line = line.removesuffix("\r")
        end = 0
        for match in SENTENCE.finditer(line):
            rest.append(ENVELOPE.sub("", line[end : match.start()]))
            good = checksum(match.group(1)) == int(match.group(2), 16)
            sentences.append(Sentence(match.group(0), match.group(1), good))
            end = match.end()
        if end:
            rest.append(line[end:])
        elif line:
            found = without_checksum(line)
            sentences += [found] if found else []
            rest += [] if found else [line]
    return sentences, [text for text in rest if text]


def without_checksum(line):
    for kind, pattern in layouts.LINES.items():
        if pattern.fullmatch(line):
            found = Sentence(line, line, True)
            found.kind = kind
            return found
    if line.startswith("$") and layouts.kind_of(line[1:]) in layouts.WITHOUT_CHECKSUM:
        return Sentence(line, line[1:], True)
    return None


# Which epoch a sentence belongs to.


class Epochs:
    """Gives each sentence its row of the truth, by its layout alone."""

    def __init__(self, sentences, layout, truth, first):
        self.truth, self.sentences, self.notes = truth, sentences, []
        self.first = first or next((each.kind for each in sentences), None)
        self.readings = layout.read(sentences)
        variation = None
        for sentence, found in zip(sentences, self.readings):
            for reading in found or []:
                variation = reading.get("variation", variation)
                for quantity, (_, step) in reading.items():
                    sentence.steps[quantity] = max(step, sentence.steps.get(quantity, 0))
                sentence.clock = reading.get("clock", sentence.clock)
            sentence.variation = variation
        self.by_time()
        self.by_order()

    def by_time(self):
        last = self.truth.times[0]
        for sentence in self.sentences:
            if sentence.clock is None:
                continue
            clock, step = sentence.clock
            time = clock + DAY * round((last - clock) / DAY)
            row = self.truth.nearest(time)
            if abs(self.truth.times[row] - time) <= 2 * step + 1e-6:
                sentence.row, sentence.how, last = row, "time", time

    def first_of(self, kind, quantity):
        """The epoch of the first sentence of a kind that tells a quantity."""
        pairs = zip(self.sentences, self.readings)
        return next((sentence.row for sentence, found in pairs if sentence.kind == kind
                     and sentence.row is not None and any(quantity in reading for reading in found or [])), 0)

    def by_order(self):
        anchors = []
        for place, sentence in enumerate(self.sentences):
            if sentence.row is not None and (not anchors or sentence.row > anchors[-1][1]):
                anchors.append((place, sentence.row))
        kinds = collections.defaultdict(list)
        for place, sentence in enumerate(self.sentences):
            if sentence.clock is None and sentence.good:
                kinds[sentence.kind].append(place)
        early = self.before_the_time(anchors)
        for kind, places in kinds.items():
            if len(anchors) > 1:
                self.between(kind, places, anchors, kind in early)
            else:
                self.from_the_start(kind, places)

    def before_the_time(self, anchors):
        """The kinds that leave before the first sentence with a time, in most epochs that have one."""
        votes = collections.Counter()
        for (last, _), (place, _) in zip([(-1, 0), *anchors], anchors):
            kinds = [sentence.kind for sentence in self.sentences[last + 1 : place + 1]]
            if self.first in kinds[:-1]:
                begin = len(kinds) - 1 - kinds[::-1].index(self.first, 1)
                votes.update(set(kinds[begin:-1]))
        return {kind for kind, count in votes.items() if 2 * count > len(anchors)}

    def distance(self, place, row):
        """How badly a sentence fits an epoch: the worst difference in allowed ones."""
        worst, sentence = 0.0, self.sentences[place]
        for reading in self.readings[place] or []:
            for quantity, (value, step) in reading.items():
                true = self.truth.value(quantity, row, sentence.variation)
                if true is not None and quantity not in ("clock", "day"):
                    unit = (step + true[1]) * metres(quantity, 0) + 1e-9
                    worst = max(worst, abs(difference(quantity, value, true[0], 0)) / unit)
        return worst

    def between(self, kind, places, anchors, early):
        """Counts the sentences of a kind between the epochs with a time."""
        ends = [anchors[max(0, bisect.bisect(anchors, (place,)) - 1)][1] for place in (places[0], places[-1])]
        period = max(1, round((ends[1] - ends[0]) / max(1, len(places) - 1)))
        plans = {choice: self.plan(places, anchors, period, choice) for choice in (early, not early)}
        cost, other = (sum(min(self.distance(place, row), 1e3) for place, row, _ in plan[:2000])
                       for plan in plans.values())
        where = "before" if early else "behind"
        self.notes.append(f"{kind} {where} the time, every {period * self.truth.period:.3g} s"
                          + (" (THE OTHER WAY FITS BETTER)" if other < cost else ""))
        for place, row, how in plans[early]:
            self.sentences[place].row, self.sentences[place].how = row, how

    def plan(self, places, anchors, period, early):
        """(place, row, how) of the sentences; `early` if they leave before the time of their epoch."""
        out, rows, ends = [], len(self.truth.rows), len(self.sentences)
        edges = [(-1, anchors[0][1]), *anchors, (ends, anchors[-1][1])]
        for (start, first), (end, after) in zip(edges, edges[1:]):
            group = places[bisect.bisect_left(places, start) : bisect.bisect_left(places, end)]
            fits = len(group) == 1 and after - first <= period or len(group) * period == after - first
            for number, place in enumerate(group):
                back = after - (len(group) - number - early) * period
                ahead = first + (number + early) * period
                row = back if start < 0 else ahead if end == ends or len(group) > 1 else (first, after)[early]
                if not fits and start >= 0 and end != ends:
                    near = range(max(0, first - period), min(rows, after + period + 1))
                    row = min(near, key=lambda row: self.distance(place, row))
                    out.append((place, row, "near"))
                elif 0 <= row < rows:
                    out.append((place, row, "order"))
        return out

    def from_the_start(self, kind, places):
        """A port without any time: one epoch for the first sentence, the others follow."""
        rows = len(self.truth.rows)
        period = max(1, round(rows / len(places)))
        most = rows - (len(places) - 1) * period
        sample = range(0, len(places), max(1, len(places) // 200))

        def cost(first):
            rows_of = ((n, first + n * period) for n in sample)
            return sum(min(self.distance(places[n], row), 1e3) for n, row in rows_of if row < rows)

        first = min(range(max(1, most)), key=cost)
        self.notes.append(f"{kind} from epoch {first}, every {period * self.truth.period:.3g} s")
        for number, place in enumerate(places):
            if first + number * period < rows:
                self.sentences[place].row = first + number * period
                self.sentences[place].how = "order"


# Comparison.


class Line:
    """What a reader found in one kind of sentence."""

    def __init__(self):
        self.count = collections.Counter()
        self.worst = {}
        self.signs = collections.Counter()


def why(reader, sentence, quantity, value, truth):
    """The known reason of a difference, if it explains the value; or None."""
    if not reader.startswith("gpsd") or quantity != "course_m":
        return None
    if sentence.kind == "RMC":
        wrong = truth.value("course", sentence.row)[0] + sentence.variation[0]
        reason = "gpsd adds the variation to the course where it should take it off"
    elif sentence.kind == "HDG":
        wrong = truth.value("heading_m", sentence.row, sentence.variation)[0]
        reason = "gpsd puts the magnetic heading in the place of the magnetic course"
    else:
        return None
    return reason if abs(difference("course", value, wrong, 0)) < 0.1 else None


def why_refused(reader, sentence):
    """The known reason of a refusal, or None."""
    if reader.startswith("pynmea2") and sentence.kind == "ZDA" and ",," in sentence.body:
        return "pynmea2 wants a number in every field of ZDA"
    if reader.startswith("pynmeagps") and sentence.body.startswith("PASHR,,"):
        return "pynmeagps looks for a digit in the time of PASHR, and fails without one"
    return None


class Comparison:
    """Counts and differences of all ports."""

    def __init__(self, truth, allow):
        self.truth, self.allow = truth, allow
        self.table = collections.defaultdict(Line)
        self.sent = collections.Counter()
        self.reasons = collections.Counter()
        self.beyond, self.refused = [], []

    def add(self, reader, sentences, found, own):
        """`own`: the reader's text has digits of its own, beside those on the wire."""
        for sentence, readings in zip(sentences, found):
            if readings is readers.ABSENT:
                continue
            line = self.table[sentence.kind, reader]
            line.count["shown"] += 1
            if readings is None:
                line.count["refused"] += 1
                reason = why_refused(reader, sentence)
                self.reasons[reader, sentence.kind, "refused", reason] += 1
                self.refused += [] if reason else [(reader, sentence)]
                continue
            line.count["read" if readings else "nothing"] += 1
            if sentence.row is None:
                line.count["no epoch"] += bool(readings)
                continue
            for reading in readings:
                for quantity, (value, step) in reading.items():
                    self.compare(line, reader, sentence, quantity, value, step * own)

    def compare(self, line, reader, sentence, quantity, value, step):
        true = self.truth.value(quantity, sentence.row, sentence.variation)
        if true is None:
            if self.truth.is_unknown(quantity, sentence.row):
                self.differ(line, reader, sentence, quantity, value, (None, 0), 0.0)
            return
        latitude = self.truth.rows[sentence.row].get("lat_deg", 0.0)
        apart = abs(difference(quantity, value, true[0], latitude))
        grain = sentence.steps.get(quantity, 0.0) + true[1]
        limit = (step + grain) * metres(quantity, latitude) + 1e-9
        limit += self.allow.get(quantity, 0.0)
        limit += 1e-6 * abs(value) if quantity not in ("lat", "lon", "clock", "day") else 1e-6
        line.count["fields"] += 1
        if abs(true[0]) > 2 * grain:
            sign = (value > 0) != (quantity == "lon" and value > 180)  # east up to 360 is west
            line.signs[quantity, true[0] > 0, sign == (true[0] > 0)] += 1
        explained = apart > limit and self.differ(line, reader, sentence, quantity, value, true, limit)
        if not explained:
            line.worst[quantity] = max(apart, line.worst.get(quantity, 0.0))

    def differ(self, line, reader, sentence, quantity, value, true, limit):
        """Notes a difference; gives its known reason."""
        line.count["beyond"] += 1
        reason = true[0] is not None and why(reader, sentence, quantity, value, self.truth) or None
        self.reasons[reader, sentence.kind, quantity, reason] += 1
        if reason is None:
            self.beyond.append((reader, sentence, quantity, value, true[0], limit))
        return reason


def available(arguments):
    """The readers that are here, and the names of those that are not."""
    found, missing, up = [layouts.Layout(set(arguments.heave_up))], [], set(arguments.heave_up)
    for package, reader in ((readers.pynmeagps, readers.Pynmeagps), (readers.pynmea2, readers.Pynmea2)):
        if package:
            found.append(reader(up))
        else:
            missing.append(reader.__name__)
    try:
        found.append(readers.SignalK())
    except (OSError, readers.subprocess.CalledProcessError):
        missing.append("nmea0183-signalk")
    found += [readers.Gpsd(program=program) for program in arguments.gpsdecode]
    found += [readers.Gpsd(log=log) for log in arguments.gpsd_log]
    return found, missing + ([] if arguments.gpsdecode else ["gpsd"])


def arguments_of():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("truth")
    parser.add_argument("ports", nargs="+", metavar="port")
    parser.add_argument("--gpsdecode", action="append", default=[])
    parser.add_argument("--gpsd-log", action="append", default=[])
    parser.add_argument("--heave-up", action="append", default=[], metavar="KIND",
                        help="PASHR or PSXN,23 of a dialect whose heave is positive upward")
    parser.add_argument("--first", action="append", default=[], metavar="NAME=KIND",
                        help="the sentence of a port that leaves first in an epoch")
    parser.add_argument("--rot-damping", action="append", default=[], metavar="NAME=SECONDS",
                        help="time constant of a port's rate of turn")
    parser.add_argument("--allow", action="append", default=[], metavar="QUANTITY=VALUE")
    parser.add_argument("--full", action="store_true", help="a line for each reader of each sentence")
    return parser.parse_args()


def pairs(options):
    return dict(option.split("=", 1) for option in options)


def main():
    arguments = arguments_of()
    truth = Truth(arguments.truth)
    found, missing = available(arguments)
    result = Comparison(truth, {name: float(value) for name, value in pairs(arguments.allow).items()})
    first, damping = pairs(arguments.first), pairs(arguments.rot_damping)
    leftover, marks = [], collections.Counter()
    for path in arguments.ports:
        name = os.path.splitext(os.path.basename(path))[0]
        with open(path, "rb") as file:
            raw = file.read()
        sentences, rest = cut(raw)
        truth.damp(0.0, 0)
        epochs = Epochs(sentences, found[0], truth, first.get(name))
        truth.damp(float(damping.get(name, 0)), epochs.first_of("ROT", "rot"))
        reporting.port(name, epochs, rest)
        leftover += rest
        result.sent.update(sentence.kind for sentence in sentences)
        for reader in found:
            more = {"raw": raw} if isinstance(reader, readers.Gpsd) else {}
            own = not isinstance(reader, layouts.Layout)
            result.add(reader.name, sentences, reader.read(sentences, **more), own)
        marks.update((sentence.kind, mark) for sentence in sentences for mark in found[0].marks(sentence))
    reporting.report(result, [reader.name for reader in found], leftover, marks, arguments.full)
    print("Not installed: " + (", ".join(missing) or "none"))
    sys.exit(1 if result.beyond or result.refused or leftover else 0)


main()
