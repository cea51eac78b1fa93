"""Voyages for the tests: simulated once, and a recording where one is given."""

import os
import subprocess
from pathlib import Path

import insd
import pytest

SCENARIO = """
name = "short"
mode = "underway"
[start]
lat_deg = 35.0
lon_deg = 61.75
height_m = 20.0
[[route.legs]]
heading_deg = 145.0
speed_kn = 12.0
duration_s = 150.0
[sea]
state = 3
from_deg = 290.0
[imu]
grade = "mems"
[gnss]
"""


@pytest.fixture(scope="session")
def voyage() -> insd.Voyage:
    return insd.simulate(SCENARIO, seed=1)


@pytest.fixture(scope="session")
def nav(voyage: insd.Voyage) -> insd.Table:
    return insd.replay(voyage)


@pytest.fixture(scope="session")
def recording() -> Path:
    """A raw recording of `cargo run -p insd-tests --example report -- FOLDER`."""
    folder = os.environ.get("INSD_RECORDING")
    if folder is None:
        pytest.skip("INSD_RECORDING names no raw recording")
    return Path(folder)


@pytest.fixture(scope="session")
def command():
    """Runs the program beside which the package is held."""
    program = os.environ.get("INSD_PROGRAM")
    if program is None:
        pytest.skip("INSD_PROGRAM names no program")

    def run(*arguments: object) -> str:
        done = subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, text=True)
        return done.stdout

    return run
