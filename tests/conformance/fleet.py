#!/usr/bin/env python3
"""A ship that reports ashore by docs/fleet.md, through everything that goes wrong: mosquitto, PostgreSQL, `insd fleet sink`.

    tests/conformance/fleet.py INSD [--tls] [--keep FOLDER]

INSD is the program. It is the ship (`insd feed` and `insd run`) and the shore; between them are Debian's mosquitto and
a link that this script makes slow and cuts. In turn: the broker goes away; the daemon is killed while it is away and
started again; what it knew of acknowledgements is taken from it, so that all it has is sent twice; the broker comes
back behind 2 kB/s; the link is cut twice in the middle of a message; the sink is killed and started again. Then every record that the ship wrote down, by its key, must be in the database or still on her
disk, and none twice. What stands in the spool is read here by the table of docs/fleet.md, not by insd.

With --tls ship, sink and broker speak TLS with certificates that openssl has just made, through the same link, and a ship that believes another
authority must be refused; INSD must have been built with `--features tls`.

Needs root, as PostgreSQL must not run as root and is given to its own user. Ends with 1 if something is lost.
"""

import argparse
import glob
import json
import os
import pathlib
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHIP = ROOT / "systemd/examples/simulated.toml"
POSTGRES = sorted(glob.glob("/usr/lib/postgresql/*/bin"))


class Link:
    """A TCP link to the broker of so many bytes a second, which can be cut."""

    def __init__(self, port):
        self.port, self.rate, self.pairs = port, None, []
        self.server = socket.create_server(("127.0.0.1", 0))
        self.address = self.server.getsockname()[1]
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            ship = self.server.accept()[0]
            ship.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            try:
                shore = socket.create_connection(("127.0.0.1", self.port), timeout=2)
                shore.settimeout(None)
            except OSError:
                ship.close()
                continue
            self.pairs.append((ship, shore))
            for one, other in ((ship, shore), (shore, ship)):
                threading.Thread(target=self.carry, args=(one, other), daemon=True).start()

    def carry(self, one, other):
        try:
            while data := one.recv(256):
                if self.rate:
                    time.sleep(len(data) / self.rate)
                other.sendall(data)
        except OSError:
            pass
        for end in (one, other):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def cut(self):
        """Resets all connections: what is on its way is gone."""
        for pair in self.pairs:
            for end in pair:
                try:
                    end.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                    end.shutdown(socket.SHUT_RDWR)
                except OSError:
                    pass
        self.pairs.clear()


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as own:
        return own.getsockname()[1]


def spooled(folder):
    """Keys (run, sequence) of the records on the ship's disk, acknowledged or not."""
    keys = set()
    for path in sorted(folder.glob("*/*.spool")):
        data, at = path.read_bytes(), 0
        while at + 8 <= len(data):
            length, crc = struct.unpack_from("<II", data, at)
            body = data[at + 8 : at + 8 + length]
            if len(body) < length or zlib.crc32(body) != crc:
                break
            run, sequence = struct.unpack_from("<QQ", body)
            keys.add((f"{run:016x}", sequence))
            at += 8 + length
    return keys


def authority(folder, name):
    """A certificate that signs others, and its key."""
    key, certificate = folder / f"{name}.key", folder / f"{name}.pem"
    words = ["-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", f"/CN={name}", "-keyout", key, "-out", certificate]
    openssl("req", "-x509", *words)
    return certificate, key


def openssl(*words):
    subprocess.run(["openssl", *map(str, words)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def certificates(folder):
    """Files of a broker at 127.0.0.1, signed by an authority of ours; and an authority that has signed nothing."""
    certificate, key = authority(folder, "authority")
    authority(folder, "stranger")
    request, extensions = folder / "broker.csr", folder / "broker.ext"
    extensions.write_text("subjectAltName=IP:127.0.0.1,DNS:localhost\n")
    openssl("req", "-newkey", "rsa:2048", "-nodes", "-subj", "/CN=broker", "-keyout", folder / "broker.key", "-out", request)
    signed = ["-CA", certificate, "-CAkey", key, "-CAcreateserial", "-days", "2", "-extfile", extensions]
    openssl("x509", "-req", "-in", request, *signed, "-out", folder / "broker.pem")


class Shore:
    """Database, broker and sink."""

    def __init__(self, insd, folder, tls):
        self.insd, self.folder, self.tls = insd, folder, tls
        self.port, self.page = free_port(), free_port()
        self.database = f"host={folder} dbname=postgres user=postgres"
        self.processes = {}
        data = folder / "database"
        os.chmod(folder, 0o755)
        (folder / "broker").mkdir()
        data.mkdir()
        shutil.chown(data, "postgres")
        shutil.chown(folder, "postgres")
        self.as_postgres("initdb", "-D", str(data), "-A", "trust", "-N")
        options = f"-c listen_addresses='' -c unix_socket_directories={folder}"
        log = str(data / "log")
        self.as_postgres("pg_ctl", "-D", str(data), "-w", "-l", log, "-o", options, "start")
        (folder / "mosquitto.conf").write_text(
            f"listener {self.port} 127.0.0.1\nallow_anonymous true\nuser root\npersistence true\n"
            f"persistence_location {folder}/broker/\nmax_inflight_messages 1000\nmax_queued_messages 100000\n"
            + (f"cafile {folder}/authority.pem\ncertfile {folder}/broker.pem\nkeyfile {folder}/broker.key\n" if tls else "")
        )
        if tls:
            certificates(folder)

    def as_postgres(self, program, *words):
        command = ["runuser", "-u", "postgres", "--", f"{POSTGRES[-1]}/{program}", *words]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, cwd=self.folder)

    def begin(self, name, *command):
        log = open(self.folder / f"{name}.log", "ab")
        self.processes[name] = subprocess.Popen(command, stdout=log, stderr=log, cwd=self.folder)

    def end(self, name, how=signal.SIGTERM):
        process = self.processes.pop(name)
        process.send_signal(how)
        process.wait(20)

    def broker(self):
        self.begin("mosquitto", "/usr/sbin/mosquitto", "-c", str(self.folder / "mosquitto.conf"))

    def sink(self):
        words = ["--broker", f"127.0.0.1:{self.port}", "--postgres", self.database]
        if self.tls:
            words += ["--tls", "--tls-ca-file", str(self.folder / "authority.pem")]
        self.begin("sink", self.insd, "fleet", "sink", *words, "--page", f"127.0.0.1:{self.page}")

    def query(self, text):
        command = ["psql", "-X", "-A", "-t", "-F", " ", "-d", self.database, "-c", text]
        done = subprocess.run(command, check=True, capture_output=True, text=True)
        return [line.split(" ") for line in done.stdout.splitlines()]

    def keys(self):
        text = "select run, seq from insd_history where ship='imo1' union all select run, seq from insd_alert where ship='imo1'"
        return [(run, int(seq)) for run, seq in self.query(text)]

    def board(self):
        with urllib.request.urlopen(f"http://127.0.0.1:{self.page}/api/v1/fleet", timeout=5) as answer:
            return {own["ship"]: own for own in json.load(answer)["ships"]}

    def close(self):
        for name in list(self.processes):
            self.end(name, signal.SIGKILL)
        self.as_postgres("pg_ctl", "-D", str(self.folder / "database"), "-m", "immediate", "stop")


def configuration(folder, link, page, tls):
    text = SHIP.read_text().replace("/run/insd-sensors", str(folder / "sensors"))
    text = text.replace("127.0.0.1:10120", f"127.0.0.1:{free_port()}")
    believed = lambda name: f'tls = true\ntls_ca_file = "{folder}/{name}.pem"\n' if tls else ""
    broker = f'host = "127.0.0.1"\nport = {link}\n'
    fleet = broker + believed("authority")
    stranger = f"""
[[fleet]]
name = "stranger"
ship = "imo3"
{broker}{believed("stranger")}state_s = 1.0
"""
    return text + (stranger if tls else "") + f"""
[state]
folder = "{folder}/state"

[web]
listen = "127.0.0.1:{page}"

[[fleet]]
name = "log"
ship = "imo1"
ship_name = "Ada"
{fleet}client_id = "imo1-log"
state_s = 0.0
history_s = 0.2
gather_s = 2.0
compress = false

[[fleet]]
name = "live"
ship = "imo2"
{fleet}history_s = 0.0
alerts = false
state_s = 1.0
"""


def wait(what, seconds, is_there):
    """Seconds until something is so."""
    start = time.monotonic()
    while not is_there():
        if time.monotonic() - start > seconds:
            sys.exit(f"FAILED: {what}: not within {seconds} s")
        time.sleep(0.3)
    print(f"{what}: after {time.monotonic() - start:.1f} s", flush=True)


def voyage(shore, insd, folder):
    """Goes through it all; gives the keys that must have come ashore."""
    page = free_port()
    shore.broker()
    shore.sink()
    link = Link(shore.port)
    (folder / "insd.toml").write_text(configuration(folder, link.address, page, shore.tls))
    ship = lambda: shore.begin("ship", insd, "run", "--config", str(folder / "insd.toml"))
    spool = folder / "state/fleet/log"
    shore.begin("feed", insd, "feed", "--folder", str(folder / "sensors"))
    wait("sensors", 30, (folder / "sensors/imu").exists)
    wait("the sink has its session", 20, lambda: b"the broker answers" in (folder / "sink.log").read_bytes())
    ship()
    wait("records in the database", 40, lambda: shore.query("select to_regclass('insd_history')") != [[""]] and len(shore.keys()) > 20)
    wait("the ship on the sheet", 20, lambda: shore.board().get("imo2", {}).get("state"))

    if shore.tls and "imo3" in shore.board():
        sys.exit("FAILED: a ship has spoken to a broker whose certificate she does not believe")
    shore.end("mosquitto")
    time.sleep(10)
    print("the broker is away, and the daemon killed", flush=True)
    shore.end("ship", signal.SIGKILL)
    written = spooled(spool)
    (spool / "log/acknowledged").unlink()
    again = len(written & set(shore.keys()))
    print(f"of {len(written)} records on the ship's disk {again} are ashore, and will be sent twice", flush=True)
    ship()
    time.sleep(6)
    link.rate = 2000.0
    shore.broker()
    print("the broker is back behind 2 kB/s", flush=True)
    for _ in range(2):
        time.sleep(5)
        link.cut()
    shore.end("sink", signal.SIGKILL)
    time.sleep(2)
    shore.sink()
    wait("what was written before the kill is ashore", 90, lambda: written <= set(shore.keys()))
    link.rate = None
    latest = max(spooled(spool))
    wait("so is what was written since", 60, lambda: latest in set(shore.keys()))
    with urllib.request.urlopen(f"http://127.0.0.1:{page}/api/v1/status", timeout=5) as answer:
        schedule = json.load(answer)["schedule"]
    print(f"punctuality of the ship's outputs: {schedule}", flush=True)
    shore.end("ship")
    return written | spooled(spool)


def judge(shore, folder, written):
    keys = shore.keys()
    ashore, aboard = set(keys), spooled(folder / "state/fleet/log")
    if len(keys) != len(ashore):
        sys.exit(f"FAILED: {len(keys) - len(ashore)} records are in the database twice")
    runs = {run for run, _ in ashore}
    lost = []
    for run in runs:
        # every number from the first to the last that was drawn in a run
        last = max(seq for own, seq in ashore | aboard if own == run)
        lost += [(run, seq) for seq in range(1, last + 1) if (run, seq) not in ashore | aboard]
    lost += [key for key in written if key not in ashore | aboard]
    came = shore.board().get("imo1", {}).get("records", 0)
    print(f"{len(runs)} runs, {len(ashore)} records ashore, {len(aboard - ashore)} still aboard, {came} came since the sink was started again")
    if len(runs) != 2 or lost:
        sys.exit(f"FAILED: {len(lost)} records are lost: {lost[:10]}")
    print("nothing is lost, and nothing is there twice")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("insd")
    parser.add_argument("--keep", type=pathlib.Path, help="leave logs there")
    parser.add_argument("--tls", action="store_true", help="over TLS")
    options = parser.parse_args()
    insd = str(pathlib.Path(options.insd).resolve())
    if not (shutil.which("mosquitto", path="/usr/sbin:/usr/bin") and POSTGRES):
        sys.exit("mosquitto and postgresql are needed")
    folder = pathlib.Path(tempfile.mkdtemp(prefix="insd-fleet-"))
    shore = Shore(insd, folder, options.tls)
    try:
        judge(shore, folder, voyage(shore, insd, folder))
    finally:
        shore.close()
        if options.keep:
            shutil.copytree(folder, options.keep, dirs_exist_ok=True, ignore=shutil.ignore_patterns("database", "sensors"))
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
