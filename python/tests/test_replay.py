"""Replays are those of the program, to the last digit that it writes."""

import threading
import time

import insd
import numpy as np
import pytest

PLACES = {"lat_deg": 10, "lon_deg": 10, "height_m": 5, "vn_mps": 5, "ve_mps": 5, "vd_mps": 5}


def equal_to_the_last_digit(own: insd.Table, file: insd.Table) -> None:
    assert own.columns == file.columns and len(own) == len(file)
    for name in own:
        mine, theirs = own[name], file[name]
        if mine.dtype == object:
            assert list(mine) == list(theirs), name
            continue
        places = PLACES.get(name, 5 if name.endswith("_m") else 6)
        off = np.abs(mine - theirs)
        if name == "heading_deg":
            off = np.minimum(off, 360 - off)
        known = ~(np.isnan(mine) & np.isnan(theirs))
        # a claim smaller than the last digit is written as one of it; degrees out of radians are good to 2e-13
        least = (1 if name.startswith("std") else 0.5) * 10.0**-places + 2e-13
        assert (off[known] <= least).all(), name


def test_the_numbers_are_those_of_the_program(voyage, nav, command, tmp_path):
    command("replay", voyage.path, "--out", tmp_path / "nav.csv")
    equal_to_the_last_digit(nav, insd.read_nav(tmp_path / "nav.csv"))


def test_a_recording_gives_the_numbers_of_the_program(recording, command, tmp_path):
    command("replay", recording, "--out", tmp_path / "nav.csv")
    equal_to_the_last_digit(insd.replay(recording), insd.read_nav(tmp_path / "nav.csv"))


def test_the_same_voyage_gives_the_same_bits(voyage, nav):
    again = insd.replay(voyage)
    assert all(np.array_equal(nav[name], again[name], equal_nan=nav[name].dtype != object) for name in nav)


def test_without_gnss_she_is_less_sure_of_her_place(voyage, nav):
    outage = insd.replay(voyage, outages=[("gnss", 100, 140)])
    text = insd.replay(voyage, outages=["gnss:100..140"])
    at = np.searchsorted(nav["t_s"], 139.0)
    assert outage["std_n_m"][at] > 2 * nav["std_n_m"][at]
    assert outage["mode"][at] != "aided" and np.array_equal(outage["lat_deg"], text["lat_deg"])
    assert "dropped by --outage" in outage.summary


def test_as_many_solutions_come_as_are_asked_for(voyage):
    nav = insd.replay(voyage, rate=1)
    assert np.allclose(np.diff(nav["t_s"]), 1.0)


def test_the_interpreter_is_free_meanwhile(voyage):
    done = threading.Event()

    def work() -> None:
        insd.replay(voyage)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    steps = 0
    while not done.is_set():
        steps += 1
        time.sleep(0.001)
    thread.join()
    assert steps > 10


def test_a_recording_is_decoded(recording):
    record = insd.read_recording(recording)
    assert record.program.startswith("insd ") and "[imu]" in record.config
    assert record.start_utc_s > 1.5e9
    assert {"imu", "gnss", "log"} <= set(record.sensors())


def test_a_recording_becomes_a_voyage_without_gnss(recording):
    voyage = insd.convert(recording)
    nav = insd.replay(voyage, outages=[("gnss", 1300, 1400)], rate=1)
    assert nav["mode"][np.searchsorted(nav["t_s"], 1350)] == "dead_reckoning"
    with pytest.raises(insd.InputError, match="insd convert"):
        insd.replay(recording, outages=[("gnss", 1300, 1400)])
