//! A camera on the hull: how it sits, what it sees of a quay, and what goes wrong with it.

use serde::Deserialize;

use super::fault::Faults;

/// The quay that the camera sees: an upright wall along the line of the berth, and what stands behind it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct CameraQuay {
    /// The water is so far below the IMU at the start.
    pub(crate) water_below_imu_m: f64,
    /// The edge of the quay is so far above the water.
    pub(crate) edge_m: f64,
    /// Points that can be told from others on 100 m of the wall; as many are on what lies about behind it.
    pub(crate) points_per_100_m: f64,
    /// Buildings on 100 m.
    pub(crate) buildings_per_100_m: f64,
    /// How far behind the edge the nearest and the farthest stand.
    pub(crate) depth_m: [f64; 2],
    /// How high the lowest and the highest are.
    pub(crate) height_m: [f64; 2],
    /// Points on each.
    pub(crate) points_per_building: u32,
    /// Points that are farther from the camera cannot be told from others.
    pub(crate) range_m: f64,
}

impl Default for CameraQuay {
    fn default() -> Self {
        CameraQuay {
            water_below_imu_m: 4.0,
            edge_m: 3.0,
            points_per_100_m: 60.0,
            buildings_per_100_m: 6.0,
            depth_m: [30.0, 200.0],
            height_m: [6.0, 25.0],
            points_per_building: 20,
            range_m: 500.0,
        }
    }
}

/// What goes wrong with the camera: exactly one of the kinds is given.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct CameraFault {
    /// Beginning; the start unless given.
    pub(crate) t0_s: f64,
    /// End, excluded; never unless given.
    pub(crate) t1_s: Option<f64>,
    /// Nothing is seen.
    pub(crate) blinded: bool,
    /// This share of the points are drops on the lens; the others are blurred.
    pub(crate) wet_lens: Option<f64>,
    /// Nothing but water is seen.
    pub(crate) water: bool,
    /// This share of the points are on a ship that passes.
    pub(crate) ship_passing: Option<f64>,
    /// The last image comes again and again.
    pub(crate) frozen: bool,
    /// The camera is turned, about forward, starboard and down.
    pub(crate) mounting_knocked_deg: Option<[f64; 3]>,
    /// Points are anywhere.
    pub(crate) noise: bool,
}

/// A camera. Its voyage has a table `[camera]`, and the tracks of its points and what a visual odometry makes of it in files.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Camera {
    /// From the IMU, body axes.
    pub(crate) lever_arm_m: [f64; 3],
    /// Where it looks: from the bow, clockwise.
    pub(crate) bearing_deg: f64,
    /// How far below the horizon.
    pub(crate) down_deg: f64,
    /// Turned about its optical axis, clockwise.
    pub(crate) roll_deg: f64,
    /// Focal length.
    pub(crate) focal_px: f64,
    /// Width and height of the image, whose middle is on the optical axis.
    pub(crate) size_px: [u32; 2],
    /// Rate of images.
    pub(crate) rate_hz: f64,
    /// White noise of a point, 1-sigma of each axis.
    pub(crate) pixel_std: f64,
    /// Most points that are tracked at a time.
    pub(crate) tracks: u32,
    /// How often a point that is in view is lost: chance per second.
    pub(crate) lost_per_s: f64,
    /// Share of the rows that are mismatches.
    pub(crate) mismatched: f64,
    /// How the camera is turned from where it is said to look, about forward, starboard and down.
    pub(crate) mounting_error_deg: [f64; 3],
    /// How well it was turned there besides: 1-sigma of each axis, one draw.
    pub(crate) mounting_std_deg: f64,
    /// An image was taken so much later than is said.
    pub(crate) time_offset_s: f64,
    /// How well that is known besides: 1-sigma, one draw.
    pub(crate) time_offset_std_s: f64,
    /// Interval of the visual odometry's keyframes.
    pub(crate) keyframe_s: f64,
    /// Error of its rotation from keyframe to keyframe, 1-sigma of each axis.
    pub(crate) vo_rotation_std_rad: f64,
    /// Error of its translation, 1-sigma of each axis.
    pub(crate) vo_translation_std_m: f64,
    /// What is added to that, as a share of the way.
    pub(crate) vo_translation_std_share: f64,
    /// Logarithm of the scale of a map, 1-sigma.
    pub(crate) log_scale_std: f64,
    /// Its random walk.
    pub(crate) log_scale_walk_sqrt_s: f64,
    /// How often the visual odometry begins a new map.
    pub(crate) maps_per_hour: f64,
    /// What it sees.
    pub(crate) quay: CameraQuay,
    /// Faults.
    pub(crate) fault: Vec<CameraFault>,
}

impl Default for Camera {
    fn default() -> Self {
        Camera {
            lever_arm_m: [25.0, -5.0, -8.0],
            bearing_deg: -60.0,
            down_deg: 12.0,
            roll_deg: 0.0,
            focal_px: 800.0,
            size_px: [1280, 720],
            rate_hz: 10.0,
            pixel_std: 0.5,
            tracks: 80,
            lost_per_s: 0.01,
            mismatched: 0.01,
            mounting_error_deg: [0.0; 3],
            mounting_std_deg: 0.0,
            time_offset_s: 0.0,
            time_offset_std_s: 0.0,
            keyframe_s: 0.5,
            vo_rotation_std_rad: 3e-4,
            vo_translation_std_m: 0.01,
            vo_translation_std_share: 0.02,
            log_scale_std: 0.3,
            log_scale_walk_sqrt_s: 1e-3,
            maps_per_hour: 10.0,
            quay: CameraQuay::default(),
            fault: Vec::new(),
        }
    }
}

impl Camera {
    pub(super) fn check(&self, faults: &mut Faults) {
        faults.lever_arm("camera.lever_arm_m", self.lever_arm_m);
        faults.range("camera.bearing_deg", self.bearing_deg, -360.0, 360.0);
        faults.range("camera.down_deg", self.down_deg, -80.0, 80.0);
        faults.range("camera.roll_deg", self.roll_deg, -180.0, 180.0);
        faults.range("camera.focal_px", self.focal_px, 10.0, 1e5);
        for (axis, size) in self.size_px.into_iter().enumerate() {
            faults.range(format!("camera.size_px[{axis}]"), f64::from(size), 16.0, 1e4);
        }
        faults.range("camera.rate_hz", self.rate_hz, 0.1, 60.0);
        faults.range("camera.tracks", f64::from(self.tracks), 1.0, 1000.0);
        faults.range("camera.mismatched", self.mismatched, 0.0, 1.0);
        turns("camera.mounting_error_deg", self.mounting_error_deg, faults);
        faults.range("camera.time_offset_s", self.time_offset_s, -10.0, 10.0);
        faults.positive("camera.keyframe_s", self.keyframe_s);
        for (key, value) in [
            ("pixel_std", self.pixel_std),
            ("mounting_std_deg", self.mounting_std_deg),
            ("time_offset_std_s", self.time_offset_std_s),
            ("lost_per_s", self.lost_per_s),
            ("vo_rotation_std_rad", self.vo_rotation_std_rad),
            ("vo_translation_std_m", self.vo_translation_std_m),
            ("vo_translation_std_share", self.vo_translation_std_share),
            ("log_scale_std", self.log_scale_std),
            ("log_scale_walk_sqrt_s", self.log_scale_walk_sqrt_s),
            ("maps_per_hour", self.maps_per_hour),
        ] {
            faults.not_negative(format!("camera.{key}"), value);
        }
        self.quay.check(faults);
        for (index, fault) in self.fault.iter().enumerate() {
            fault.check(&format!("camera.fault[{index}]"), faults);
        }
    }
}

impl CameraQuay {
    fn check(&self, faults: &mut Faults) {
        faults.range("camera.quay.water_below_imu_m", self.water_below_imu_m, -50.0, 50.0);
        faults.range("camera.quay.edge_m", self.edge_m, 0.5, 20.0);
        faults.range("camera.quay.points_per_100_m", self.points_per_100_m, 0.0, 1000.0);
        faults.range("camera.quay.buildings_per_100_m", self.buildings_per_100_m, 0.0, 100.0);
        let points = f64::from(self.points_per_building);
        faults.range("camera.quay.points_per_building", points, 0.0, 1000.0);
        faults.range("camera.quay.range_m", self.range_m, 10.0, 5000.0);
        for (key, [low, high]) in [("depth_m", self.depth_m), ("height_m", self.height_m)] {
            faults.range(format!("camera.quay.{key}[0]"), low, 1.0, 2000.0);
            faults.range(format!("camera.quay.{key}[1]"), high, low, 2000.0);
        }
    }
}

impl CameraFault {
    /// Key of its kind, which is that of its size too.
    pub(crate) fn kind(&self) -> &'static str {
        self.kinds().next().map_or("", |(kind, _)| kind)
    }

    /// Its size, in the unit of its key; one without a size has none.
    pub(crate) fn size(&self) -> Option<f64> {
        let turn = |turn: [f64; 3]| turn.iter().map(|angle| angle * angle).sum::<f64>().sqrt();
        self.wet_lens.or(self.ship_passing).or(self.mounting_knocked_deg.map(turn))
    }

    /// Whether it holds at time `t`, s.
    pub(crate) fn holds(&self, t: f64) -> bool {
        t >= self.t0_s && self.t1_s.is_none_or(|end| t < end)
    }

    fn kinds(&self) -> impl Iterator<Item = (&'static str, bool)> {
        let all = [
            ("blinded", self.blinded),
            ("wet_lens", self.wet_lens.is_some()),
            ("water", self.water),
            ("ship_passing", self.ship_passing.is_some()),
            ("frozen", self.frozen),
            ("mounting_knocked_deg", self.mounting_knocked_deg.is_some()),
            ("noise", self.noise),
        ];
        all.into_iter().filter(|(_, is_given)| *is_given)
    }

    fn check(&self, key: &str, faults: &mut Faults) {
        faults.not_negative(format!("{key}.t0_s"), self.t0_s);
        if self.t1_s.is_some_and(|t1| !(t1.is_finite() && t1 > self.t0_s)) {
            faults.add(format!("{key}.t1_s"), "expected a time after t0_s");
        }
        if self.kinds().count() != 1 {
            let kinds =
                "blinded, wet_lens, water, ship_passing, frozen, mounting_knocked_deg and noise";
            faults.add(key, format!("expected one of {kinds}"));
        }
        for (own, share) in [("wet_lens", self.wet_lens), ("ship_passing", self.ship_passing)] {
            share.into_iter().for_each(|it| faults.range(format!("{key}.{own}"), it, 0.0, 1.0));
        }
        if let Some(turn) = self.mounting_knocked_deg {
            turns(&format!("{key}.mounting_knocked_deg"), turn, faults);
        }
    }
}

fn turns(key: &str, degrees: [f64; 3], faults: &mut Faults) {
    for (axis, angle) in degrees.into_iter().enumerate() {
        faults.range(format!("{key}[{axis}]"), angle, -90.0, 90.0);
    }
}
