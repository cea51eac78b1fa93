//! A camera, and what the navigator makes of it.

use insd_base::CameraSight;
use insd_base::units::DEG;
use insd_config::Config;
use insd_intake::status::SensorStatus;
use insd_web::snapshot::{CameraState, ShownCamera};

use super::super::report::Slow;
use super::engines::{estimate, triad};

/// The camera, if one is configured.
pub(super) fn camera(config: &Config, slow: &Slow) -> Option<ShownCamera> {
    let section = config.camera.as_ref()?;
    let status = slow.intake.sensors.iter().find(|own| own.name == section.sensor);
    let shown = slow.camera.as_ref().map(sight).unwrap_or_default();
    Some(ShownCamera {
        sensor: section.sensor.clone(),
        state: state(slow.camera.as_ref(), status),
        has_picture: section.picture.is_some(),
        ..shown
    })
}

fn state(sight: Option<&CameraSight>, status: Option<&SensorStatus>) -> CameraState {
    let is_heard = status.is_some_and(|own| own.heard.is_some() && !own.silent);
    match sight {
        _ if !is_heard => CameraState::Silent,
        None => CameraState::Waiting,
        Some(sight) if sight.is_doubted => CameraState::Doubtful,
        Some(_) => CameraState::Used,
    }
}

fn sight(own: &CameraSight) -> ShownCamera {
    let count = |count: usize| u32::try_from(count).ok();
    ShownCamera {
        valid_at_s: Some(own.time.as_seconds()),
        points: own.points.and_then(count),
        poses: count(own.poses),
        landmarks: count(own.landmarks),
        turned: triad(&own.turned, &own.turned_sigma, DEG),
        delay: Some(estimate(&own.delay, 1.0)),
        ..ShownCamera::default()
    }
}

#[cfg(test)]
mod tests {
    use insd_base::{Body, Estimate, Time};
    use nalgebra::Vector3;

    use super::*;

    fn sight_of(is_doubted: bool) -> CameraSight {
        CameraSight {
            time: Time::from_seconds(3.0),
            points: Some(60),
            poses: 7,
            landmarks: 4,
            is_doubted,
            turned: Body(Vector3::new(0.0, 0.5 * DEG, 0.0)),
            turned_sigma: Body(Vector3::repeat(0.1 * DEG)),
            delay: Estimate { value: 0.01, sigma: 0.005 },
        }
    }

    #[test]
    fn a_camera_that_is_not_heard_is_silent_whatever_was_made_of_it() {
        assert_eq!(state(Some(&sight_of(false)), None), CameraState::Silent);
    }

    #[test]
    fn what_is_held_of_it_is_told_in_degrees_and_seconds() {
        let shown = sight(&sight_of(true));
        assert_eq!((shown.points, shown.poses, shown.landmarks), (Some(60), Some(7), Some(4)));
        assert!((shown.turned[1].value.unwrap() - 0.5).abs() < 1e-12);
        assert_eq!(shown.delay.unwrap().sigma, Some(0.005));
    }
}
