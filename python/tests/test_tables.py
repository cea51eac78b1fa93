"""Tables: arrays with names and units, and a stream of Arrow."""

import insd
import numpy as np
import pytest


def test_every_column_has_as_many_values_as_the_table_has_rows(nav):
    assert len(nav) > 1000
    assert all(array.shape == (len(nav),) for array in nav.to_dict().values())
    assert list(nav) == nav.columns == nav.keys()


def test_units_stand_beside_the_names(nav):
    assert nav.units["lat_deg"] == "deg" and nav.units["vn_mps"] == "m/s" and nav.units["mode"] == ""
    ends = {"deg": "_deg", "m": "_m", "m/s": "_mps", "s": "_s"}
    assert all(name.endswith(ends[unit]) for name, unit in nav.units.items() if unit)


def test_an_array_is_the_same_each_time_and_cannot_be_written_to(nav):
    assert nav["lat_deg"] is nav["lat_deg"]
    for name in ("lat_deg", "mode"):
        with pytest.raises(ValueError):
            nav[name][0] = 0


def test_a_column_that_is_not_there_is_named_with_those_that_are(nav):
    with pytest.raises(KeyError, match="latitude: no such column, but t_s, lat_deg"):
        nav["latitude"]
    assert "lat_deg" in nav and "latitude" not in nav


def test_arrow_has_the_same_values_and_the_units(nav):
    pyarrow = pytest.importorskip("pyarrow")
    table = pyarrow.table(nav)
    assert table.column_names == nav.columns
    assert table.schema.field("heading_deg").metadata == {b"unit": b"deg"}
    assert np.array_equal(table["heading_deg"].to_numpy(), nav["heading_deg"])
    assert table["mode"].to_pylist() == list(nav["mode"])


def test_what_is_unknown_is_nan_in_numpy_and_null_in_arrow(nav):
    pyarrow = pytest.importorskip("pyarrow")
    # fixes of a receiver: nobody counts satellites whose ranges are in use
    assert np.isnan(nav["satellites"]).all()
    assert pyarrow.table(nav)["satellites"].null_count == len(nav)


def test_words_of_sensors_are_told_in_ships_axes_and_with_their_receipt(voyage):
    sensors = voyage.sensors()
    assert set(sensors) == {"imu", "gnss"}
    imu, gnss = sensors["imu"], sensors["gnss"]
    rate = 1 / np.median(np.diff(imu["t_s"]))
    assert rate == pytest.approx(voyage.imu_rate_hz, rel=1e-6)
    # a hull that floats: gravity pushes it up, and down is positive
    assert np.sum(imu["dvel_z_mps"]) / np.ptp(imu["t_s"]) == pytest.approx(-9.8, abs=0.05)
    assert (gnss["receipt_s"] >= gnss["t_s"]).all()
    assert np.allclose(gnss["lat_deg"], 35.0, atol=0.02)
