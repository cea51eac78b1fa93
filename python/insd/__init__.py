"""Inertial navigation of ships: voyages simulated, replayed and scored by the engine of the daemon `insd`.

Units stand at the end of names: ``lat_deg``, ``vn_mps``, ``std_e_m``; ``Table.units`` says them in full. Positions are geodetic,
WGS 84, of the IMU. Velocities are over the Earth, north, east and down. Roll is positive with starboard down, pitch with the bow up,
headings are true, clockwise from north. ``t_s`` counts from the start of the voyage. What is unknown is NaN, ``None`` or null, never zero.

    >>> import insd
    >>> voyage = insd.simulate("berthing", seed=1)
    >>> nav = insd.replay(voyage, outages=[("gnss", 300, 360)])
    >>> nav["heading_deg"][-1], nav.units["heading_deg"]
    >>> insd.evaluate(nav, voyage)["components"]["heading"]["rms"]
"""

from ._insd import (
    VERSION as __version__,
    Recording,
    Table,
    Voyage,
    campaign,
    convert,
    evaluate,
    integrity,
    read_nav,
    read_recording,
    read_truth,
    read_voyage,
    replay,
    scenarios,
    simulate,
)
from .errors import Error, InputError

__all__ = [
    "Error",
    "InputError",
    "Recording",
    "Table",
    "Voyage",
    "__version__",
    "campaign",
    "convert",
    "evaluate",
    "integrity",
    "read_nav",
    "read_recording",
    "read_truth",
    "read_voyage",
    "replay",
    "scenarios",
    "simulate",
]
