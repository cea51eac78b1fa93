#!/usr/bin/env python3
"""Heave as a port sends it, beside the truth of the voyage.

    tests/conformance/heave.py VOYAGE PORT.sent FORWARD STARBOARD DOWN [FROM_S]

- VOYAGE: a voyage directory with truth.csv (not compressed).
- PORT.sent: KMB telegrams of a port at a monitoring point, as `insd replay --sent` writes them.
- FORWARD, STARBOARD, DOWN: that point from the IMU, m.

The true heave is the height of the point less its mean over five minutes around the instant. KMB is read
here by its published layout, independent of our own code. Prints the root mean square, 95 % and greatest
error of the real-time and of the delayed heave, the share of the heave itself, and how often the
real-time error is within twice the sigma that the telegram claims.
"""

import bisect
import csv
import datetime
import math
import struct
import sys
import tomllib

WINDOW = 150.0
TELEGRAM = 132
HEAVE_INVALID, DELAYED_INVALID = 1 << 3, 1 << 5


class Truth:
    """Heave of a point of the ship."""

    def __init__(self, voyage, lever):
        with open(f"{voyage}/voyage.toml", "rb") as file:
            utc = tomllib.load(file)["start_utc"]
        self.start = datetime.datetime.fromisoformat(utc.replace("Z", "+00:00")).timestamp()
        self.times, self.heights, self.sums = [], [], [0.0]
        with open(f"{voyage}/truth.csv", newline="") as file:
            for row in csv.DictReader(file):
                roll, pitch = (math.radians(float(row[key])) for key in ("roll_deg", "pitch_deg"))
                down = (-math.sin(pitch), math.cos(pitch) * math.sin(roll), math.cos(pitch) * math.cos(roll))
                drop = sum(part * arm for part, arm in zip(down, lever))
                self.times.append(float(row["t_s"]))
                self.heights.append(float(row["height_m"]) - drop)
                self.sums.append(self.sums[-1] + self.heights[-1])

    def heave(self, utc):
        """Height less its mean; None too near to an end of the voyage."""
        at = utc - self.start
        if not self.times[0] + WINDOW < at < self.times[-1] - WINDOW:
            return None
        left = bisect.bisect_right(self.times, at) - 1
        share = (at - self.times[left]) / (self.times[left + 1] - self.times[left])
        height = self.heights[left] + share * (self.heights[left + 1] - self.heights[left])
        first = bisect.bisect_left(self.times, at - WINDOW)
        last = bisect.bisect_right(self.times, at + WINDOW)
        return height - (self.sums[last] - self.sums[first]) / (last - first)


def told(data, start, begin):
    """(real-time or delayed, UTC, heave up, claimed sigma) of each telegram."""
    for at in range(0, len(data) - TELEGRAM + 1, TELEGRAM):
        telegram = data[at : at + TELEGRAM]
        if telegram[:4] != b"#KMB":
            sys.exit(f"byte {at}: no KMB telegram")
        second, nano, status = struct.unpack_from("<III", telegram, 8)
        if second + nano * 1e-9 < start + begin:
            continue
        if not status & HEAVE_INVALID:
            (down,), (sigma,) = struct.unpack_from("<f", telegram, 52), struct.unpack_from("<f", telegram, 104)
            yield "real time", second + nano * 1e-9, -down, sigma
        if not status & DELAYED_INVALID:
            second, nano, down = struct.unpack_from("<IIf", telegram, 120)
            yield "delayed", second + nano * 1e-9, -down, None


def rms(values):
    return math.sqrt(sum(value * value for value in values) / max(1, len(values)))


def main():
    voyage, port, *rest = sys.argv[1:]
    truth = Truth(voyage, [float(text) for text in rest[:3]])
    begin = float(rest[3]) if len(rest) > 3 else 300.0
    with open(port, "rb") as file:
        data = file.read()
    errors, heaves, covered = {}, {}, []
    for kind, utc, heave, sigma in told(data, truth.start, begin):
        true = truth.heave(utc)
        if true is None:
            continue
        errors.setdefault(kind, []).append(heave - true)
        heaves.setdefault(kind, []).append(true)
        if sigma is not None:
            covered.append(abs(heave - true) <= 2 * sigma)
    for kind, found in errors.items():
        sizes = sorted(abs(error) for error in found)
        share = 100 * rms(found) / max(rms(heaves[kind]), 1e-9)
        print(
            f"{kind:9}  rms {100 * rms(found):.2f} cm ({share:.1f} % of {rms(heaves[kind]):.2f} m), "
            f"95 % {100 * sizes[int(0.95 * len(sizes))]:.1f}, greatest {100 * sizes[-1]:.1f}, "
            f"{len(sizes)} epochs"
        )
    print(f"2 sigma    {100 * sum(covered) / max(1, len(covered)):.0f} % of the real-time errors")


if __name__ == "__main__":
    main()
