#!/usr/bin/env python3
"""The recipes of docs/connect.md, run with the real consumers.

    tests/conformance/connect.py INSD [--gpsd PROGRAM] [--signalk FOLDER] [--seconds 30] [--keep FOLDER]
        [--here]

INSD is the program. It simulates a voyage and replays it with the ports of the page, so that each port's bytes
are those that the daemon would send it; they are then played to the consumer through the very destinations of
the page, and what it says is held against `epochs.csv`, which the replay wrote beside them: the state that every
port was told.

- gpsd: PROGRAM, or that of the PATH, started by the page's command.
- Signal K: `node_modules` of FOLDER has signalk-server; left out without FOLDER.
- chrony: `chronyd -p` reads the page's lines, if it is installed.

All of it runs in a network of its own, so the page's numbers of ports are free and nothing is asked of the
outside; that needs root or user namespaces, and `--here` does without. Ends with 1 if a value is missing or differs, and with 2 if a
consumer that was asked for is not there.
"""

import argparse
import bisect
import csv
import ctypes
import datetime
import fcntl
import json
import math
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/connect.md"
SHIP = pathlib.Path(__file__).resolve().parent / "connect.toml"
KNOT = 1852 / 3600
# half a step of the last digit of the sentences, and of gpsd's and our own text
HALF = {
    "lat": 1.3e-7, "lon": 1.3e-7, "height": 0.0111, "heading": 0.0056, "roll": 0.0056,
    "pitch": 0.0056, "speed": 0.0051 * KNOT + 0.0006, "track": 0.0056,
}


# The page.


def blocks():
    """(heading, language, text) of each fenced block, in the order of the page."""
    heading, found = None, []
    for part in re.split(r"^(## .*)$", PAGE.read_text(), flags=re.M):
        if part.startswith("## "):
            heading = part[3:]
        found += [(heading, *own) for own in re.findall(r"^```(\w+)\n(.*?)^```$", part, re.M | re.S)]
    return found


def block(heading, language):
    own = [text for at, kind, text in blocks() if (at, kind) == (heading, language)]
    assert len(own) == 1, f"docs/connect.md, {heading}: expected one block of {language}"
    return own[0]


def destination(heading):
    """Kind and address of a port of the page."""
    line = re.search(r"destination = \{ kind = \"([a-z-]+)\", \w+ = \"([^\"]+)\"", block(heading, "toml"))
    host, port = line.group(2).rsplit(":", 1)
    return line.group(1), (host, int(port))


# Our side.


class Truth:
    """What each port was told, by time."""

    def __init__(self, path):
        with open(path) as file:
            rows = [row for row in csv.DictReader(file) if row["lat_deg"] and row["heading_deg"]]
        self.times = [round(float(row["utc_s"]), 3) for row in rows]
        self.rows = rows

    def at(self, utc):
        index = bisect.bisect_left(self.times, utc - 0.002)
        good = index < len(self.times) and abs(self.times[index] - utc) < 0.01
        return self.number(index) if good else None

    def of_day(self, utc):
        """The same of a time whose date is that of the reader's own clock."""
        return self.at(self.times[0] // 86400 * 86400 + utc % 86400)

    def number(self, index):
        names = {"lat": "lat_deg", "lon": "lon_deg", "height": "height_m", "heading": "heading_deg",
                 "roll": "roll_deg", "pitch": "pitch_deg", "speed": "sog_mps", "track": "cog_deg"}
        row = self.rows[index]
        return {own: float(row[name]) for own, name in names.items() if row[name]}


def sail(insd, folder):
    """Makes what each port of the page is sent."""
    config = folder / "insd.toml"
    ours = [text for _, kind, text in blocks() if kind == "toml"]
    # a table must stand before the arrays of tables, and [chrony] is one
    ours.sort(key=lambda text: not text.startswith("[chrony]"))
    config.write_text("\n".join([SHIP.read_text(), *ours]))
    run = lambda *words: subprocess.run([insd, *map(str, words)], check=True, stdout=subprocess.DEVNULL)
    run("check-config", config)
    run("simulate", "2", "--seed", "1", "--out", folder / "voyage")
    run("replay", folder / "voyage", "--config", config, "--out", folder / "nav.csv", "--sent", folder / "sent")
    return Truth(folder / "sent/epochs.csv")


def epochs(path, seconds, first):
    """The last seconds of a port, cut before each line that begins with `first`."""
    lines = path.read_bytes().splitlines(keepends=True)
    out = []
    for line in lines:
        if first in line[:60] or not out:
            out.append([])
        out[-1].append(line)
    return out[-seconds - 1 : -1]


class Player(threading.Thread):
    """Plays a port to its consumer, each second of the voyage in a part of one."""

    def __init__(self, heading, chunks, pace):
        super().__init__(daemon=True)
        (self.kind, self.address), self.chunks, self.pace = destination(heading), chunks, pace
        if self.kind == "udp":
            self.line = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        else:
            self.line = socket.create_server(self.address)

    def run(self):
        if self.kind == "udp":
            send = lambda line: self.line.sendto(line, self.address)
        else:
            send = self.line.accept()[0].sendall
            time.sleep(0.5)
        for chunk in self.chunks:
            for line in chunk:
                send(line)
                time.sleep(self.pace / len(chunk))


class Findings:
    """Differences, counted."""

    def __init__(self, name):
        self.name, self.compared, self.worst, self.faults = name, {}, {}, []

    def hold(self, quantity, theirs, ours, where):
        if theirs is None or ours is None:
            self.faults.append(f"{where}: {quantity} is {theirs}, ours {ours}")
            return
        apart = theirs - ours
        if quantity in ("heading", "track", "lon"):
            apart = (apart + 180) % 360 - 180
        self.compared[quantity] = self.compared.get(quantity, 0) + 1
        self.worst[quantity] = max(self.worst.get(quantity, 0), abs(apart))
        if abs(apart) > HALF[quantity]:
            self.faults.append(f"{where}: {quantity} {theirs}, ours {ours}")

    def expect(self, least, *quantities):
        for quantity in quantities:
            count = self.compared.get(quantity, 0)
            if count < least:
                self.faults.append(f"{quantity} came {count} times, expected at least {least}")

    def tell(self):
        print(f"{self.name}")
        for quantity, count in self.compared.items():
            print(f"  {quantity:8} {count:5} compared, at most {self.worst[quantity]:.2g} apart")
        for fault in self.faults[:10]:
            print(f"  ! {fault}")
        if len(self.faults) > 10:
            print(f"  ! and {len(self.faults) - 10} more")
        return not self.faults


class Near:
    """Finds the epoch of attitudes that come in order and without a time."""

    def __init__(self, truth):
        self.truth, self.index = truth, None

    def find(self, reported, utc):
        if self.index is None:
            self.index = bisect.bisect_left(self.truth.times, utc - 0.3)
        for index in range(self.index, min(self.index + 60, len(self.truth.times))):
            ours = self.truth.number(index)
            close = lambda name: abs((reported[name] - ours[name] + 180) % 360 - 180) <= HALF[name]
            if all(close(name) for name in reported):
                self.index = index
                return ours
        return None


def utc(text):
    return datetime.datetime.fromisoformat(text.replace("Z", "+00:00")).timestamp()


# gpsd.


def gpsd(program, truth, folder, seconds):
    version = subprocess.run([program, "-V"], capture_output=True, text=True).stdout.strip()
    findings = Findings(f"gpsd: {version}")
    player = Player("gpsd", epochs(folder / "sent/gpsd.sent", seconds, b"ZDA,"), 0.25)
    words = block("gpsd", "sh").split()
    assert words[0] == "gpsd", "the recipe starts gpsd"
    daemon = subprocess.Popen([program, "-N", *words[1:]], stderr=subprocess.DEVNULL)
    try:
        line = calling(("127.0.0.1", 2947))
        line.sendall(b'?WATCH={"enable":true,"json":true};\n')
        player.start()
        reports = listened(line, player)
    finally:
        daemon.terminate()
        daemon.wait()
    near, now, fixes, attitudes = Near(truth), None, 0, 0
    for text in reports:
        try:
            report = json.loads(text)
        except ValueError:
            findings.faults.append(f"no JSON: {text}")
            continue
        if report["class"] == "TPV" and report.get("mode", 0) >= 2 and "speed" in report:
            now = utc(report["time"])
            ours = truth.at(now)
            if ours is None:
                findings.faults.append(f"{report['time']}: no such epoch")
                continue
            fixes += 1
            findings.hold("lat", report.get("lat"), ours["lat"], report["time"])
            findings.hold("lon", report.get("lon"), ours["lon"], report["time"])
            findings.hold("height", report.get("altHAE"), ours["height"], report["time"])
            findings.hold("speed", report.get("speed"), ours["speed"], report["time"])
            findings.hold("track", report.get("track"), ours.get("track"), report["time"])
        elif report["class"] == "ATT" and "roll" in report and now is not None:
            theirs = {name: report[name] for name in ("heading", "roll", "pitch") if name in report}
            ours = near.find(theirs, now)
            attitudes += 1
            for name in ("heading", "roll", "pitch"):
                findings.hold(name, theirs.get(name), ours and ours[name], f"ATT after {now}")
    findings.expect(seconds - 3, "lat", "lon", "height", "speed", "track")
    findings.expect(9 * (seconds - 3), "heading", "roll", "pitch")
    return findings.tell()


def calling(address, patience=20):
    end = time.monotonic() + patience
    while True:
        try:
            return socket.create_connection(address)
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.1)


def listened(line, player):
    """The lines that come until a second after the player has ended."""
    line.settimeout(1.0)
    bytes_, end = b"", None
    while end is None or time.monotonic() < end:
        try:
            bytes_ += line.recv(65536)
        except TimeoutError:
            pass
        if end is None and not player.is_alive():
            end = time.monotonic() + 1.0
    return [text for text in bytes_.decode().splitlines() if text.strip()]


# Signal K.


def signalk(modules, truth, folder, seconds):
    home = folder / "signalk"
    home.mkdir()
    providers = []
    for heading in ("Signal K", "Signal K by NMEA 0183"):
        providers += json.loads(block(heading, "json"))["pipedProviders"]
    settings = {"interfaces": {}, "mdns": False, "pipedProviders": providers}
    (home / "settings.json").write_text(json.dumps(settings))
    deltas = epochs(folder / "sent/signalk.sent", 5 * seconds, b"updates")
    grouped = [sum(deltas[at : at + 5], []) for at in range(0, len(deltas), 5)]
    sentences = epochs(folder / "sent/signalk-nmea.sent", seconds, b"ZDA,")
    players = [Player("Signal K", grouped, 0.5), Player("Signal K by NMEA 0183", sentences, 0.5)]
    environment = dict(os.environ, SIGNALK_NODE_CONFIG_DIR=str(home), PORT="3000", HOME=str(home))
    program = modules / "node_modules/signalk-server/bin/signalk-server"
    with open(folder / "signalk.log", "w") as log:
        server = subprocess.Popen(["node", program], env=environment, stdout=log, stderr=log, cwd=home)
        try:
            line = calling(("127.0.0.1", 8375), 60)
            subscription = [{"path": "*", "policy": "instant"}]
            line.sendall(json.dumps({"context": "vessels.self", "subscribe": subscription}).encode() + b"\n")
            for player in players:
                player.start()
            updates = listened(line, players[1])
        finally:
            server.send_signal(signal.SIGTERM)
            server.wait()
    return all([by_delta(updates, truth, seconds), by_nmea(updates, truth, seconds)])


def updates_of(reports, provider):
    """(time, values) of a provider's updates, in the order in which they came: the server tells each path by itself."""
    for text in reports:
        for update in json.loads(text).get("updates", []):
            if update.get("$source", "").split(".")[0] == provider:
                values = {value["path"]: value["value"] for value in update.get("values", [])}
                yield update.get("timestamp"), values


def by_time(reports, provider, truth):
    """(time, values, ours) for each time that is one of our epochs."""
    all_values = {}
    for stamp, values in updates_of(reports, provider):
        all_values.setdefault(stamp, {}).update(values)
    for stamp, values in all_values.items():
        # of a GGA, which has no date, the server makes a time of today
        undated = provider == "insd-nmea" and "navigation.gnss.antennaAltitude" in values
        ours = truth.of_day(utc(stamp)) if undated else truth.at(utc(stamp))
        if ours:
            yield stamp, values, ours


def hold_track(findings, values, ours, stamp, altitude):
    place, geoid = values.get("navigation.position"), values.get("navigation.gnss.geoidalSeparation")
    if place:
        findings.hold("lat", place["latitude"], ours["lat"], stamp)
        findings.hold("lon", place["longitude"], ours["lon"], stamp)
    if altitude is not None and geoid is not None:
        findings.hold("height", altitude + geoid, ours["height"], stamp)
    if "navigation.speedOverGround" in values:
        findings.hold("speed", values["navigation.speedOverGround"], ours["speed"], stamp)
    if "navigation.courseOverGroundTrue" in values:
        track = math.degrees(values["navigation.courseOverGroundTrue"])
        findings.hold("track", track, ours["track"], stamp)


def by_delta(reports, truth, seconds):
    findings = Findings("Signal K, deltas")
    for stamp, values, ours in by_time(reports, "insd", truth):
        hold_track(findings, values, ours, stamp, (values.get("navigation.position") or {}).get("altitude"))
        told = dict(values.get("navigation.attitude") or {})
        told["heading"] = values.get("navigation.headingTrue")
        for name in ("heading", "roll", "pitch"):
            theirs = told.get(name)
            findings.hold(name, theirs and math.degrees(theirs), ours[name], stamp)
    least = 5 * (seconds - 3)
    findings.expect(least, "lat", "lon", "height", "heading", "track", "speed", "roll", "pitch")
    return findings.tell()


def by_nmea(reports, truth, seconds):
    findings = Findings("Signal K, NMEA 0183")
    for stamp, values, ours in by_time(reports, "insd-nmea", truth):
        hold_track(findings, values, ours, stamp, values.get("navigation.gnss.antennaAltitude"))
    near, now = Near(truth), None
    for stamp, values in updates_of(reports, "insd-nmea"):
        if truth.at(utc(stamp)):
            now = utc(stamp)
        if "navigation.headingTrue" in values and now is not None:
            theirs = {"heading": math.degrees(values["navigation.headingTrue"])}
            found = near.find(theirs, now)
            findings.hold("heading", theirs["heading"], found and found["heading"], f"after {now}")
    findings.expect(seconds - 3, "lat", "lon", "height", "speed", "track")
    findings.expect(9 * (seconds - 3), "heading")
    return findings.tell()


# chrony.


def chrony(folder):
    program = shutil.which("chronyd") or "/usr/sbin/chronyd"
    if not os.path.exists(program):
        print("chrony is not installed: left out")
        return True
    path = folder / "chrony.conf"
    path.write_text(block("chrony", "conf"))
    done = subprocess.run([program, "-p", "-f", path], capture_output=True, text=True)
    ours = re.search(r'socket = "(.*)"', block("chrony", "toml")).group(1)
    good = done.returncode == 0 and f"refclock SOCK {ours} " in done.stdout
    print("chrony: reads its lines, and the socket is ours" if good else f"chrony: ! {done.stdout}{done.stderr}")
    return good


# The network of its own.


def alone():
    """Leaves the network for an empty one with a loopback."""
    libc = ctypes.CDLL(None, use_errno=True)
    new_network, new_user = 0x40000000, 0x10000000
    flags = new_network if os.geteuid() == 0 else new_network | new_user
    if libc.unshare(flags) != 0:
        sys.exit(f"no network of its own: {os.strerror(ctypes.get_errno())}")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        request = struct.pack("16sh14x", b"lo", 1)  # IFF_UP
        fcntl.ioctl(any_socket, 0x8914, request)  # SIOCSIFFLAGS


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("insd", type=pathlib.Path)
    parser.add_argument("--gpsd", default=shutil.which("gpsd") or "/usr/sbin/gpsd")
    parser.add_argument("--signalk", type=pathlib.Path)
    parser.add_argument("--seconds", type=int, default=30)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--here", action="store_true")
    options = parser.parse_args()
    if not os.path.exists(options.gpsd):
        print(f"no gpsd at {options.gpsd}", file=sys.stderr)
        sys.exit(2)
    if not options.here:
        alone()
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        truth = sail(options.insd.resolve(), folder)
        good = [chrony(folder), gpsd(options.gpsd, truth, folder, options.seconds)]
        if options.signalk:
            good.append(signalk(options.signalk.resolve(), truth, folder, options.seconds))
    sys.exit(0 if all(good) else 1)


if __name__ == "__main__":
    main()
