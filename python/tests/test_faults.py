"""Faults are exceptions that name the place."""

import insd
import pytest


def test_a_row_that_is_damaged_is_named_with_file_and_line(nav, voyage, tmp_path):
    path = tmp_path / "nav.csv"
    head = ",".join(nav.columns)
    row = "1,35,61,0,0,0,0,0,0,0,1,1,1,1,1,1,1,1,1,aided,2,2,perhaps,,,"
    path.write_text(f"{head}\n{row}\n")
    with pytest.raises(insd.InputError, match="nav.csv:2:integrity: unknown word") as fault:
        insd.read_nav(path)
    assert fault.value.file == path and fault.value.line == 2
    assert isinstance(fault.value, ValueError)


def test_a_scenario_that_is_faulty_is_named_with_its_line():
    with pytest.raises(insd.InputError, match="line 2"):
        insd.simulate('name = "x"\nmode = \n')


def test_a_key_that_is_not_there_is_named():
    with pytest.raises(insd.InputError, match="start.lat: unknown field"):
        insd.simulate(7, sets={"start.lat": 60})


def test_an_unknown_scenario_tells_what_there_is():
    with pytest.raises(insd.InputError, match="06-berthing"):
        insd.simulate("nowhere")
    assert "berthing" in insd.scenarios()


def test_what_is_no_voyage_is_named(tmp_path):
    with pytest.raises(insd.InputError, match="voyage.toml") as fault:
        insd.read_voyage(tmp_path)
    assert fault.value.file == tmp_path / "voyage.toml"


def test_an_option_that_cannot_be_is_told_as_the_program_tells_it(voyage):
    with pytest.raises(insd.InputError, match="expected SENSOR:FROM..TO"):
        insd.replay(voyage, outages=["radar:1..2"])
    with pytest.raises(insd.InputError, match="expected a number from 0.01 to 1000 Hz"):
        insd.replay(voyage, rate=-1)


def test_a_temporary_voyage_goes_with_its_object(voyage):
    own = insd.simulate(voyage_text(), seed=2)
    path = own.path
    assert path.exists()
    del own
    assert not path.exists() and voyage.path.exists()


def voyage_text() -> str:
    from conftest import SCENARIO

    return SCENARIO
