#!/usr/bin/env python3
"""The dashboard and the alert rules of docs/dashboards.md, by a Prometheus that asks the page of a made-up ship.

    tests/conformance/dashboard.py SHOW

SHOW is the example `show` of insd-web. Every expression of contrib/grafana/insd.json is put to Prometheus as Grafana would,
with its variables filled in, while the ship aligns, is under way and is in fault: all must be understood, and find something in
one of the scenes at least. The rules of contrib/prometheus are checked and tried by promtool, and those that fit the fault must be
pending or fire. Needs Debian's prometheus. Ends with 1 if something does not hold.
"""

import json
import pathlib
import re
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.parse
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[2]
RULES = ROOT / "contrib/prometheus"
SECONDS = 25
CONFIG = """
global: { scrape_interval: 1s, evaluation_interval: 1s }
rule_files: [%s]
scrape_configs:
  - job_name: insd
    static_configs: [{ targets: ["127.0.0.1:%d"], labels: { instance: coaster } }]
"""


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as server:
        return server.getsockname()[1]


def ask(port, path, **what):
    """What Prometheus answers, or its complaint."""
    url = f"http://127.0.0.1:{port}/api/v1/{path}?{urllib.parse.urlencode(what)}"
    try:
        with urllib.request.urlopen(url, timeout=5) as answer:
            return json.load(answer)["data"], None
    except urllib.error.HTTPError as error:
        return None, json.load(error)["error"]


def expressions():
    """Title and expression of everything that is drawn."""
    board = json.loads((ROOT / "contrib/grafana/insd.json").read_text())
    for panel in board["panels"]:
        for target in panel.get("targets", []):
            expression = target["expr"].replace("$ship", ".*").replace("$__rate_interval", "10s")
            left = re.search(r"\$\w+", expression)
            assert left is None, f"{panel['title']}: {left} is no variable"
            yield panel["title"], expression


def scene(show, name):
    """What each expression finds in a scene, the complaints, and the alerts that fit it."""
    page, prometheus = free_port(), free_port()
    with tempfile.TemporaryDirectory() as folder:
        config = pathlib.Path(folder) / "prometheus.yml"
        config.write_text(CONFIG % (RULES / "insd.rules.yml", page))
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        programs = [
            subprocess.Popen([show, name, f"127.0.0.1:{page}"], **quiet),
            subprocess.Popen(
                ["prometheus", f"--config.file={config}", f"--storage.tsdb.path={folder}/data",
                 f"--web.listen-address=127.0.0.1:{prometheus}"], **quiet),
        ]
        try:
            time.sleep(SECONDS)
            found, complaints = {}, []
            for title, expression in expressions():
                data, complaint = ask(prometheus, "query", query=expression)
                found[title, expression] = 0 if data is None else len(data["result"])
                if complaint:
                    complaints.append(f"{title}: {complaint}")
            alerts = ask(prometheus, "alerts")[0]["alerts"]
            return found, complaints, {alert["labels"]["alertname"] for alert in alerts}
        finally:
            for program in programs:
                program.terminate()
                program.wait()


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for command in (["check", "rules", "insd.rules.yml"], ["test", "rules", "insd.test.yml"], ["check", "config", "prometheus.yml"]):
        subprocess.run(["promtool", *command], cwd=RULES, check=True)
    everything, wrong, alerts = {}, [], {}
    for name in ("alignment", "underway", "fault"):
        found, complaints, alerts[name] = scene(sys.argv[1], name)
        wrong += complaints
        for key, count in found.items():
            everything[key] = max(count, everything.get(key, 0))
        print(f"{name}: {sum(count > 0 for count in found.values())} of {len(found)} expressions find something; alerts: {sorted(alerts[name])}")
    wrong += [f"{title}: nothing is found by {expression}" for (title, expression), count in everything.items() if count == 0]
    if "InsdAlertOnBoard" not in alerts["fault"]:
        wrong.append("the rules say nothing of the ship in fault")
    print(*wrong, sep="\n")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
