"""Scores are those of the program."""

import json

import insd
import pytest


def test_errors_are_those_of_the_program(voyage, command, tmp_path):
    nav, truth = tmp_path / "nav.csv", voyage.path / "truth.csv"
    command("replay", voyage.path, "--out", nav)
    told = json.loads(command("evaluate", nav, truth, "--from", 60, "--json"))
    assert insd.evaluate(nav, truth, start=60) == told


def test_a_table_is_scored_as_its_file_is(voyage, nav):
    report = insd.evaluate(nav, voyage, start=60)
    assert report["components"]["heading"]["rms"] < 5
    assert insd.evaluate(nav, voyage.truth(), start=60)["components"] == report["components"]


def test_levels_are_judged_at_a_limit_with_a_name_or_a_number(voyage, nav):
    named = insd.integrity(nav, voyage, alert_limit="harbour")
    assert named["horizontal"]["epochs"] == insd.integrity(nav, voyage, alert_limit=10)["horizontal"]["epochs"]
    with pytest.raises(ValueError, match="docking"):
        insd.integrity(nav, voyage, alert_limit="harbor")


def test_a_campaign_is_that_of_the_program(command):
    told = json.loads(command("campaign", "berthing", "--seeds", "1..3", "--rate", 0.2, "--json"))
    own = insd.campaign("berthing", range(1, 3), rate=0.2)
    assert own["components"] == told["components"]


def test_truth_is_no_solution(voyage, nav):
    with pytest.raises(TypeError, match="expected a solution"):
        insd.evaluate(voyage.truth(), voyage)
    with pytest.raises(TypeError, match="expected truth"):
        insd.evaluate(nav, nav)
