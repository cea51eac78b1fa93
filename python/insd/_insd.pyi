"""The compiled part of the package, in words for people and type checkers."""

from collections.abc import Iterator, Mapping, Sequence
from os import PathLike
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

VERSION: str

_Path = str | PathLike[str]
_Outage = str | tuple[str, float, float]

@final
class Table:
    """Columns by name: a mapping of names to arrays, and a stream of Arrow.

    ``table["lat_deg"]`` is an array of float64, NaN where unknown, or of objects: words, ``None`` where unknown. It is the same array
    each time and cannot be written to. ``dict(table)``, ``pandas.DataFrame(dict(table))``, ``polars.DataFrame(table)``,
    ``pyarrow.table(table)`` and DuckDB take it as it is; a field of Arrow has its unit in its metadata.
    """

    @property
    def columns(self) -> list[str]:
        """Names of the columns in their order."""

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column, empty where it has none."""

    @property
    def summary(self) -> str | None:
        """What a replay says of itself: what was used, rejected, bridged and skipped."""

    def keys(self) -> list[str]:
        """Names of the columns in their order."""

    def to_dict(self) -> dict[str, NDArray[Any]]:
        """All columns as arrays."""

    def __len__(self) -> int:
        """Number of rows."""

    def __iter__(self) -> Iterator[str]: ...
    def __contains__(self, name: object, /) -> bool: ...
    def __getitem__(self, name: str, /) -> NDArray[Any]: ...
    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """The Arrow PyCapsule interface; the columns are copied."""

@final
class Voyage:
    """A voyage directory: what the sensors of a ship measured, and where she was, if that is known."""

    @property
    def path(self) -> PathLike[str]:
        """Its directory. Where none was named it is a temporary one, which goes with this object."""

    @property
    def start_utc(self) -> str:
        """UTC of ``t_s = 0``, RFC 3339."""

    @property
    def is_moored(self) -> bool:
        """Whether the ship lies at her berth at the start."""

    @property
    def imu_rate_hz(self) -> float:
        """Samples of the IMU per second, Hz."""

    def sensors(self) -> dict[str, Table]:
        """What the sensors measured, a table for each that was there.

        ``imu``: increments of angle (``dtheta_x_rad`` ...) and of velocity (``dvel_x_mps`` ...) of the interval that ends at ``t_s``,
        body axes forward, starboard, down. ``gnss``: position and velocity of the antenna with the receiver's sigmas, ``quality`` as in
        GGA. ``log``: velocity forward, starboard and down (``u_mps``, ``v_mps``, ``w_mps``) and what it is measured against.
        ``reference``: other instruments. ``ranging``: docking aids. ``receipt_s`` is when a message came.
        """

    def truth(self) -> Table:
        """Where she was: position, velocity and attitude of the IMU. An InputError where nobody knows."""

@final
class Recording:
    """What the sensors said in one run of the daemon, decoded."""

    @property
    def program(self) -> str | None:
        """Name and version of the program that wrote it."""

    @property
    def config(self) -> str | None:
        """The configuration with which it ran, TOML."""

    @property
    def start_utc_s(self) -> float | None:
        """UTC of ``t_s = 0``, seconds since 1970, as far as it was known at the end."""

    @property
    def others(self) -> dict[str, int]:
        """How many messages there were of kinds that have no table: ``ranges`` of satellites, ``camera``, ..."""

    def sensors(self) -> dict[str, Table]:
        """As ``Voyage.sensors``; axes are the ship's."""

def scenarios() -> str:
    """The shipped scenarios, a line for each: number, name and what it is for."""

def simulate(
    scenario: int | _Path,
    seed: int = 1,
    *,
    sets: Mapping[str, object] | None = None,
    out: _Path | None = None,
    compress: bool = False,
) -> Voyage:
    """Makes a voyage with truth of a scenario, as ``insd simulate`` does.

    Args:
        scenario: a file, the name or the number of a shipped scenario, or the text of one (TOML, several lines).
        seed: of all random streams; the same seed gives the same voyage to the bit.
        sets: keys of the scenario with other values, as ``{"sea.state": 5}``.
        out: directory to write; a temporary one if absent, which goes with the voyage.
        compress: write the long files compressed.

    Raises:
        InputError: the scenario is faulty.
    """

def read_voyage(path: _Path) -> Voyage:
    """A voyage directory that is there already. Raises InputError with file and line."""

def read_recording(path: _Path, *, config: _Path | None = None, run: int = 1) -> Recording:
    """Decodes a raw recording (``.insdraw``): one of its files, or its folder.

    Args:
        config: another configuration than the one it was made with.
        run: of a recording that spans restarts of the program: which run, from 1.
    """

def convert(recording: _Path, out: _Path | None = None, *, config: _Path | None = None, run: int = 1) -> Voyage:
    """Makes a voyage directory of a raw recording, as ``insd convert`` does: so that sensors can be taken away in its replay.

    Args:
        recording: one of its files, or its folder.
        out: directory to write; a temporary one if absent, which goes with the voyage.
        config: another configuration than the one it was made with.
        run: of a recording that spans restarts of the program: which run, from 1.
    """

def replay(
    voyage: Voyage | _Path,
    *,
    rate: float | None = None,
    outages: Sequence[_Outage] = (),
    without: Sequence[str] = (),
    gnss: str | None = None,
    camera: str | None = None,
    masks: Sequence[str] = (),
    config: _Path | None = None,
    run: int | None = None,
    alignment: str | None = None,
    in_motion: str | None = None,
    stored_state: _Path | None = None,
    log_model: _Path | None = None,
) -> Table:
    """Runs a voyage or a raw recording through the engine of the daemon: the solution, as ``insd replay`` writes it to ``nav.csv``.

    The numbers are those before they are rounded to the digits of the file. The interpreter is free meanwhile, so that threads
    replay several voyages at once.

    Args:
        voyage: a voyage, its directory, or a raw recording.
        rate: solutions per second, Hz; 10 of a voyage, of a recording what its configuration says.
        outages: sensors (imu, gnss, log, reference, camera) taken away while FROM <= t_s < TO: ``("gnss", 600, 900)`` or
            ``"gnss:600..900"``. For voyages.
        without: what is left out: learning, camera, raw, log, gnss. For voyages.
        gnss: what raw GNSS is made of: loose, tight, phase-rates, none.
        camera: what is made of a camera.
        masks: satellites that are left: ``"300..360:3"``.
        config: of a recording: another configuration than its own.
        run: of a recording that spans restarts: which run, from 1.
        alignment: how the sea is kept out of the alignment at the berth.
        in_motion: how a ship under way finds her heading.
        stored_state: the state that was stored at the last shutdown.
        log_model: what was learnt of log and gyros on earlier voyages.

    Returns:
        t_s, lat_deg, lon_deg, height_m (over the ellipsoid), vn_mps, ve_mps, vd_mps, roll_deg, pitch_deg, heading_deg, 1-sigma of each
        (std_n_m, ..., std_heading_deg), mode, protection levels hpl_m and vpl_m, integrity, excluded, satellites, source.

    Raises:
        InputError: the recording or an option is faulty.
    """

def read_nav(path: _Path) -> Table:
    """The solution in a file ``nav.csv``, plain or compressed; columns as of ``replay``. Raises InputError with file and line."""

def read_truth(path: _Path) -> Table:
    """Where a ship was, out of a file ``truth.csv``, plain or compressed. Raises InputError with file and line."""

def evaluate(nav: Table | _Path, truth: Table | Voyage | _Path, *, start: float | None = None) -> dict[str, Any]:
    """Errors of a solution (solution minus truth) and what its claims are worth, as ``insd evaluate --json`` prints them.

    Args:
        nav: a table of ``replay`` or ``read_nav``, or a file.
        truth: a voyage, a table of ``read_truth``, or a file.
        start: leave out what is before this time, s.
    """

def integrity(
    nav: Table | _Path,
    truth: Table | Voyage | _Path,
    *,
    alert_limit: float | str | None = None,
    vertical_alert_limit: float | str | None = None,
    start: float | None = None,
) -> dict[str, Any]:
    """Errors against the protection levels that were told with them, as ``insd integrity --json`` prints them.

    Args:
        alert_limit: of the horizontal error, m, or its name (ocean, coastal, harbour, port, docking); harbour if absent.
        vertical_alert_limit: of the error of the height; that of the horizontal one if absent.
        start: leave out what is before this time, s.
    """

def campaign(
    scenario: int | _Path,
    seeds: range | tuple[int, int],
    *,
    sets: Mapping[str, object] | None = None,
    outages: Sequence[_Outage] = (),
    at: Sequence[float] = (),
    start: float | None = None,
    rate: float | None = None,
    jobs: int | None = None,
) -> dict[str, Any]:
    """A scenario with many seeds, in parallel: errors, NEES and coverage with 95 % intervals over seeds, as ``insd campaign --json``.

    Args:
        scenario: a file, or the name or number of a shipped scenario.
        seeds: ``range(1, 41)`` or ``(1, 41)``.
        at: score roll, pitch and heading at these instants, s, beside the limit of the optimal filter.
        rate: solutions per second that are compared, Hz; 1 if absent.
        jobs: voyages at once; what the system grants if absent.
    """
