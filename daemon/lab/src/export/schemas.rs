//! The messages of Foxglove that are written, as JSON Schema: <https://docs.foxglove.dev/docs/sdk/schemas>.

/// A kind of message: its name and its schema.
pub(super) struct Schema {
    pub(super) name: &'static str,
    pub(super) text: &'static str,
}

/// Where something is, WGS 84, with the covariance of its place east, north, up.
pub(super) const LOCATION_FIX: Schema = Schema {
    name: "foxglove.LocationFix",
    text: r#"{"title":"foxglove.LocationFix","type":"object","properties":{
"timestamp":{"type":"object","title":"time","properties":{"sec":{"type":"integer","minimum":0},"nsec":{"type":"integer","minimum":0,"maximum":999999999}}},
"frame_id":{"type":"string"},"latitude":{"type":"number"},"longitude":{"type":"number"},"altitude":{"type":"number"},
"position_covariance":{"type":"array","items":{"type":"number"},"minItems":9,"maxItems":9},
"position_covariance_type":{"title":"foxglove.PositionCovarianceType","oneOf":[{"title":"UNKNOWN","const":0},{"title":"APPROXIMATED","const":1},{"title":"DIAGONAL_KNOWN","const":2},{"title":"KNOWN","const":3}]}}}"#,
};

/// How something stands in a frame.
pub(super) const POSE_IN_FRAME: Schema = Schema {
    name: "foxglove.PoseInFrame",
    text: r#"{"title":"foxglove.PoseInFrame","type":"object","properties":{
"timestamp":{"type":"object","title":"time","properties":{"sec":{"type":"integer","minimum":0},"nsec":{"type":"integer","minimum":0,"maximum":999999999}}},
"frame_id":{"type":"string"},
"pose":{"title":"foxglove.Pose","type":"object","properties":{
"position":{"title":"foxglove.Vector3","type":"object","properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"}}},
"orientation":{"title":"foxglove.Quaternion","type":"object","properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"},"w":{"type":"number"}}}}}}}"#,
};

/// A line of a journal.
pub(super) const LOG: Schema = Schema {
    name: "foxglove.Log",
    text: r#"{"title":"foxglove.Log","type":"object","properties":{
"timestamp":{"type":"object","title":"time","properties":{"sec":{"type":"integer","minimum":0},"nsec":{"type":"integer","minimum":0,"maximum":999999999}}},
"level":{"title":"foxglove.LogLevel","oneOf":[{"title":"UNKNOWN","const":0},{"title":"DEBUG","const":1},{"title":"INFO","const":2},{"title":"WARNING","const":3},{"title":"ERROR","const":4},{"title":"FATAL","const":5}]},
"message":{"type":"string"},"name":{"type":"string"},"file":{"type":"string"},"line":{"type":"integer","minimum":0}}}"#,
};

/// What an IMU measured. Foxglove has no message of its own for it; it draws any whose schema it knows.
pub(super) const IMU: Schema = Schema {
    name: "insd.Imu",
    text: r#"{"title":"insd.Imu","type":"object","properties":{
"timestamp":{"type":"object","title":"time","properties":{"sec":{"type":"integer","minimum":0},"nsec":{"type":"integer","minimum":0,"maximum":999999999}}},
"frame_id":{"type":"string"},
"angular_velocity":{"title":"foxglove.Vector3","type":"object","properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"}}},
"linear_acceleration":{"title":"foxglove.Vector3","type":"object","properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"}}}}}"#,
};
