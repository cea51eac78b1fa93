#!/usr/bin/env python3
"""What `insd convert --to` writes, read by independent readers and held against nav.csv and the truth of the voyage.

    tests/conformance/convert.py INSD

Needs mcap, gpxpy, geojson, fastkml, rosbags and jsonschema from PyPI; foxglove-sdk, where it is installed, says which fields Foxglove's own
messages have. INSD is the program. It simulates a voyage over the antimeridian, makes a fault of some of its rows, and converts it. Ends
with 1 where a reader complains or a value differs by more than half of the last digit of nav.csv.
"""

import csv
import datetime
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import warnings

import fastkml
import geojson
import geojson.geometry
import gpxpy
import jsonschema
from mcap.reader import make_reader
from pygeoif.geometry import Polygon
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

HALF_DEGREE = 0.5000001e-10
HALF_METRE = 0.5000001e-5
START = datetime.datetime(2026, 5, 1, 8, tzinfo=datetime.timezone.utc)
SCENARIO = """
name = "converted"
mode = "underway"
start_utc = "2026-05-01T08:00:00Z"
[start]
lat_deg = 35.0
lon_deg = 179.995
height_m = 20.0
[[route.legs]]
heading_deg = 75.0
speed_kn = 14.0
duration_s = 120.0
[[route.legs]]
heading_deg = 165.0
speed_kn = 14.0
duration_s = 150.0
[sea]
state = 3
from_deg = 290.0
[imu]
grade = "navigation"
[gnss]
"""
# the reader would round to six places
geojson.geometry.DEFAULT_PRECISION = 15
FAULT = (100.0, 110.0)
ALIGNING = ("coarse_alignment", "fine_alignment", "in_motion_alignment")


def is_told(row):
    return row["integrity"] != "fault" and row["mode"] not in ("fault", "standby", "coarse_alignment")


class Case:
    """A solution and what is found wrong with its conversions."""

    def __init__(self, insd, folder):
        self.insd, self.folder, self.complaints = insd, folder, []
        (folder / "voyage.scenario.toml").write_text(SCENARIO)
        self.run("simulate", folder / "voyage.scenario.toml", "--seed", 1, "--out", folder / "voyage")
        self.run("replay", folder / "voyage", "--out", folder / "whole.csv")
        self.nav = folder / "nav.csv"
        rows = list(csv.DictReader((folder / "whole.csv").open()))
        for row in rows:
            if FAULT[0] <= float(row["t_s"]) < FAULT[1]:
                row["integrity"] = "fault"
        with self.nav.open("w", newline="") as file:
            writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
        self.rows = rows
        self.told = [row for row in rows if is_told(row)]

    def run(self, *arguments):
        subprocess.run([self.insd, *map(str, arguments)], check=True, stderr=subprocess.PIPE)

    def convert_voyage(self, kind):
        out = self.folder / f"voyage.{kind}"
        self.run("convert", self.folder / "voyage", "--to", kind, "--imu", "--out", out)
        return out

    def convert(self, kind):
        out = self.folder / f"nav.{kind}"
        self.run("convert", self.nav, "--to", kind, "--start-utc", "2026-05-01T08:00:00Z", "--out", out)
        return out

    def same(self, what, own, expected, half):
        if not math.isfinite(own) or abs(own - expected) > half:
            self.complaints.append(f"{what}: {own} is not {expected}")

    def count(self, what, own, expected):
        if own != expected:
            self.complaints.append(f"{what}: {own}, not {expected}")

    def place(self, what, row, latitude, longitude, height):
        self.same(f"{what} {row['t_s']} latitude", latitude, float(row["lat_deg"]), HALF_DEGREE)
        self.same(f"{what} {row['t_s']} longitude", longitude, float(row["lon_deg"]), HALF_DEGREE)
        self.same(f"{what} {row['t_s']} height", height, float(row["height_m"]), HALF_METRE)

    def time(self, what, row, own):
        expected = START + datetime.timedelta(seconds=float(row["t_s"]))
        if abs((own - expected).total_seconds()) > 1e-3:
            self.complaints.append(f"{what}: {own} is not {expected}")


def gpx(case):
    track = gpxpy.parse(case.convert("gpx").open()).tracks[0]
    points = [point for segment in track.segments for point in segment.points]
    case.count("gpx points", len(points), len(case.told))
    for row, point in zip(case.told, points):
        height = point.elevation + float(point.geoid_height)
        case.place("gpx", row, point.latitude, point.longitude, height)
        case.time("gpx", row, point.time)
    return f"{len(points)} points in {len(track.segments)} segments"


def geo_json(case):
    told = geojson.loads(case.convert("geojson").read_text())
    if not told.is_valid:
        case.complaints.append(f"geojson: {told.errors()}")
    points, lost = [], 0
    for feature in told.features:
        if feature.geometry is None:
            lost += len(feature.properties["t_s"])
            continue
        is_line = feature.geometry.type == "LineString"
        points += feature.geometry.coordinates if is_line else [feature.geometry.coordinates]
    case.count("geojson points", len(points), len(case.told))
    case.count("geojson rows without a place", lost, len(case.rows) - len(case.told))
    for row, (longitude, latitude, height) in zip(case.told, points):
        case.place("geojson", row, latitude, longitude, height)
    return f"{len(points)} points and {lost} rows without a place in {len(told.features)} features"


def kml(case):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        document = fastkml.KML.parse(case.convert("kml")).features[0]
    lines, ellipses = [], 0
    for mark in document.features:
        if isinstance(mark.geometry, Polygon):
            ellipses += 1
        elif mark.geometry is not None:
            lines += list(mark.geometry.coords)
    case.count("kml points", len(lines), len(case.told))
    for row, (longitude, latitude, _) in zip(case.told, lines):
        case.same("kml latitude", latitude, float(row["lat_deg"]), HALF_DEGREE)
        case.same("kml longitude", longitude, float(row["lon_deg"]), HALF_DEGREE)
    return f"{len(lines)} points, {ellipses} ellipses"


def messages(case, path):
    """Messages by topic, each checked against its schema; the summary must count the same."""
    found, validators = {}, {}
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        statistics = reader.get_summary().statistics
        for schema, channel, message in reader.iter_messages():
            own = json.loads(message.data)
            if schema.id not in validators:
                text = json.loads(schema.data)
                validators[schema.id] = jsonschema.validators.validator_for(text)(text)
            validators[schema.id].validate(own)
            stamp = own["timestamp"]["sec"] * 10**9 + own["timestamp"]["nsec"]
            case.count(f"{channel.topic} stamp", stamp, message.log_time)
            found.setdefault(channel.topic, []).append(own)
            check_fields(case, schema.name, own)
    case.count("mcap messages", sum(map(len, found.values())), statistics.message_count)
    return found


FIELDS = {}


def check_fields(case, name, own):
    """Fields of Foxglove's own message of this name; it has none of an IMU."""
    if not name.startswith("foxglove."):
        return
    try:
        import foxglove.messages as theirs
        from google.protobuf import descriptor_pb2
    except ImportError:
        return
    if name not in FIELDS:
        files = descriptor_pb2.FileDescriptorSet()
        files.ParseFromString(getattr(theirs, name.split(".")[1]).get_schema().data)
        all_of = {f"foxglove.{kind.name}": kind for file in files.file for kind in file.message_type}
        FIELDS[name] = {field.name for field in all_of[name].field}
    extra = set(own) - FIELDS[name]
    if extra:
        case.complaints.append(f"{name} has no {extra}")


def angles(turned):
    """Roll, pitch and yaw of a quaternion, rad."""
    x, y, z, w = (turned[axis] for axis in "xyzw")
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    return roll, pitch, math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def mcap(case):
    found = messages(case, case.convert("mcap"))
    case.count("mcap positions", len(found["/position"]), len(case.told))
    for row, own in zip(case.told, found["/position"]):
        case.place("mcap", row, own["latitude"], own["longitude"], own["altitude"])
        sigmas = [float(row[name]) for name in ("std_e_m", "std_n_m", "std_d_m")]
        for axis, sigma in enumerate(sigmas):
            case.same("mcap sigma", math.sqrt(own["position_covariance"][4 * axis]), sigma, HALF_METRE)
    steady = [row for row in case.told if row["mode"] not in ALIGNING]
    case.count("mcap poses", len(found["/pose"]), len(steady))
    worst = 0.0
    for row, own in zip(steady, found["/pose"]):
        # REP 103: forward, left, up in east, north, up
        expected = (float(row["roll_deg"]), -float(row["pitch_deg"]), 90 - float(row["heading_deg"]))
        for found_angle, angle in zip(angles(own["pose"]["orientation"]), expected):
            worst = max(worst, abs((math.degrees(found_angle) - angle + 180) % 360 - 180))
    # the plane of the first place leans and turns against the level of the last: 1.4 km
    case.same("mcap attitude, deg", worst, 0.0, 0.02)
    warned = [own for own in found["/log"] if own["level"] == 3 and "may not be relied on" in own["message"]]
    if not warned:
        case.complaints.append("mcap: no warning where nothing may be relied on")
    axes(case, steady, found["/pose"])
    return f"{len(found['/position'])} positions, {len(found['/pose'])} poses, {len(found['/log'])} lines of the log"


def axes(case, steady, poses):
    """Against the truth, with nothing of ours between: on a straight course she moves where her bow points, and that is forward."""
    first, last = poses[0]["pose"], poses[100]["pose"]
    east, north = (last["position"][axis] - first["position"][axis] for axis in "xy")
    truth = csv.DictReader((case.folder / "voyage/truth.csv").open())
    begin = float(steady[0]["t_s"])
    heading = next(math.radians(float(row["heading_deg"])) for row in truth if float(row["t_s"]) >= begin)
    for what, own in (("course", math.atan2(north, east)), ("yaw", angles(first["orientation"])[2])):
        off = (own - (math.pi / 2 - heading) + math.pi) % (2 * math.pi) - math.pi
        case.same(f"mcap {what} beside the truth, deg", math.degrees(off), 0.0, 3.0)


def ros2bag(case):
    counts, worst = {"/fix": 0, "/odom": 0}, 0.0
    steady = [row for row in case.told if row["mode"] not in ALIGNING]
    places, poses = iter(case.rows), iter(steady)
    with Reader(case.convert("ros2bag")) as reader:
        theirs = get_typestore(Stores.ROS2_HUMBLE)
        for connection, stamp, raw in reader.messages():
            own = theirs.deserialize_cdr(raw, connection.msgtype)
            counts[connection.topic] += 1
            case.count("ros2 stamp", own.header.stamp.sec * 10**9 + own.header.stamp.nanosec, stamp)
            if connection.topic == "/fix":
                navigated(case, next(places), own)
            else:
                worst = max(worst, moved(case, next(poses), own))
        for connection in reader.connections:
            # our words for a message are those of the reader's own store
            ours = get_types_from_msg(connection.msgdef.data, connection.msgtype)
            for name, fields in ours.items():
                case.count(f"ros2 {name}", fields[1], theirs.fielddefs[name][1])
    case.count("ros2 messages", counts, {"/fix": len(case.rows), "/odom": len(steady)})
    # the plane of the first place leans against the level of the last
    case.same("ros2 velocity, m/s", worst, 0.0, 0.002)
    return f"{counts['/fix']} fixes, {counts['/odom']} odometries"


def navigated(case, row, own):
    if not is_told(row):
        unknown = own.status.status == -1 and math.isnan(own.latitude) and own.position_covariance_type == 0
        case.count(f"ros2 {row['t_s']} is told as unknown", unknown, True)
        return
    case.count("ros2 status", own.status.status, 0)
    case.place("ros2", row, own.latitude, own.longitude, own.altitude)
    for axis, name in enumerate(("std_e_m", "std_n_m", "std_d_m")):
        case.same("ros2 sigma", math.sqrt(own.position_covariance[4 * axis]), float(row[name]), HALF_METRE)


def moved(case, row, own):
    """By how much the velocity, turned from the ship's axes to east, north, up by the pose, is off, m/s."""
    turned, ship = own.pose.pose.orientation, own.twist.twist.linear
    x, y, z, w = turned.x, turned.y, turned.z, turned.w
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    found = [a * ship.x + b * ship.y + c * ship.z for a, b, c in rows]
    expected = (float(row["ve_mps"]), float(row["vn_mps"]), -float(row["vd_mps"]))
    # about up alone, as she hardly lists: the sigma of the heading
    case.same("ros2 yaw sigma", math.degrees(math.sqrt(own.pose.covariance[35])), float(row["std_heading_deg"]), 0.02)
    return max(abs(a - b) for a, b in zip(found, expected))


def imu(case):
    """Samples of the IMU, as mcap and rosbags read them: the same, and turning as the truth of the voyage does."""
    found = messages(case, case.convert_voyage("mcap"))["/imu/data_raw"]
    with Reader(case.convert_voyage("ros2bag")) as reader:
        theirs = get_typestore(Stores.ROS2_HUMBLE)
        chosen = [own for own in reader.connections if own.topic == "/imu/data_raw"]
        read = reader.messages(connections=chosen)
        bag = [theirs.deserialize_cdr(raw, connection.msgtype) for connection, _, raw in read]
    case.count("ros2 samples of the IMU", len(bag), len(found))
    for own, other in zip(found, bag):
        case.count("ros2 orientation is unknown", other.orientation_covariance[0], -1.0)
        for name in ("angular_velocity", "linear_acceleration"):
            vector = getattr(other, name)
            case.count(f"ros2 {name}", {axis: getattr(vector, axis) for axis in "xyz"}, own[name])
    stamps = [own["timestamp"]["sec"] + own["timestamp"]["nsec"] * 1e-9 - START.timestamp() for own in found]
    truth = list(csv.DictReader((case.folder / "voyage/truth.csv").open()))
    truth = [row for row in truth if abs(float(row["t_s"]) - round(float(row["t_s"]))) < 1e-6]
    worst, at, step = 0.0, 0, stamps[1] - stamps[0]
    for first, last in zip(truth, truth[1:]):
        turned = [0.0, 0.0, 0.0]
        while at < len(found) and stamps[at] < float(last["t_s"]):
            for axis, name in enumerate("xyz"):
                turned[axis] += found[at]["angular_velocity"][name] * step
            at += 1
        # REP 103: forward, left, up
        for own, (name, sign) in zip(turned, (("roll_deg", 1), ("pitch_deg", -1), ("heading_deg", -1))):
            expected = sign * (float(last[name]) - float(first[name]))
            worst = max(worst, abs((math.degrees(own) - expected + 180) % 360 - 180))
    # roll and pitch of a sea of state 3 couple with the turn
    case.same("turned in a second beside the truth, deg", worst, 0.0, 0.5)
    up = sum(own["linear_acceleration"]["z"] for own in found) / len(found)
    case.same("specific force upwards, m/s^2", up, 9.8, 0.1)
    return f"{len(found)} samples, in both the same; turned within a second as the truth to {worst:.2f} deg"


def whole(case):
    """A voyage and its nav.csv become the same."""
    out = {}
    for source in ("voyage", "whole.csv"):
        out[source] = case.folder / f"{source}.geojson"
        start = ["--start-utc", "2026-05-01T08:00:00Z"] if source != "voyage" else []
        case.run("convert", case.folder / source, "--to", "geojson", *start, "--out", out[source])
    texts = [json.loads(path.read_text())["features"] for path in out.values()]
    if texts[0] != texts[1]:
        case.complaints.append("a voyage becomes something else than its nav.csv")
    return f"{len(texts[0])} features, the same of a voyage as of its nav.csv"


def main():
    with tempfile.TemporaryDirectory() as folder:
        case = Case(sys.argv[1], pathlib.Path(folder))
        for check in (gpx, geo_json, kml, mcap, ros2bag, imu, whole):
            print(f"{check.__name__:8} {check(case)}")
    for complaint in case.complaints[:20]:
        print(complaint, file=sys.stderr)
    print(f"{len(case.rows)} rows of nav.csv, {len(case.complaints)} complaints")
    sys.exit(1 if case.complaints else 0)


if __name__ == "__main__":
    main()
