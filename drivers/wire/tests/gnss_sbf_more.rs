//! PVTCartesian and BaseVectorGeod: what is written is read back, and what they say of an epoch.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{FixQuality, Geodetic, GpsTime, earth};
use insd_wire::gnss::EpochTime;
use insd_wire::gnss::sbf::{
    BaseVector, BaseVectorGeod, PvtAccuracy, PvtCartesian, SbfMode, SbfSolution, SbfStamp,
};

fn stamp() -> SbfStamp {
    SbfStamp { time_of_week: Some(302_400_250_000_000), week: Some(2445) }
}

fn cartesian() -> PvtCartesian {
    let place = Geodetic::from_degrees(-35.5, 139.25, 12.5);
    let velocity = earth::c_ne(&place).transpose() * insd_base::Ned::new(3.0, -4.0, 0.5).0;
    PvtCartesian {
        stamp: stamp(),
        mode: SbfMode::of(FixQuality::RtkFixed),
        position: Some(earth::ecef(&place).0.into()),
        undulation: Some(-4.25),
        velocity: Some([velocity.x as f32, velocity.y as f32, velocity.z as f32]),
        satellites: Some(14),
        extra: Some(PvtAccuracy {
            bases: 1,
            latency: Some(0.02),
            horizontal: Some(2.0),
            vertical: Some(5.0),
        }),
    }
}

fn vector(solution: SbfSolution) -> BaseVector {
    BaseVector {
        satellites: 9,
        mode: SbfMode { solution, determining: false, two_dimensional: false, error: 0 },
        misc: 1,
        relative: [Some(-1.0), Some(-1.0), Some(0.25)],
        velocity: [Some(0.5), None, Some(-0.25)],
        direction: (4500, -10),
        reference: 3,
        correction_age: Some(0.25),
        signals: 0x0101,
    }
}

#[test]
fn a_place_along_the_axes_of_the_earth_is_told_in_latitude_and_longitude() {
    let told = PvtCartesian::read(&cartesian().write()).unwrap();
    assert_eq!(told, cartesian());
    let part = told.part();
    let place = part.position.unwrap();
    assert!((place.latitude.to_degrees() + 35.5).abs() < 1e-12);
    assert!((place.longitude.to_degrees() - 139.25).abs() < 1e-12);
    assert!((place.height - 12.5).abs() < 1e-6);
    for (own, expected) in part.velocity.into_iter().zip([3.0, -4.0, 0.5]) {
        assert!((own.unwrap() - expected).abs() < 1e-5);
    }
    assert_eq!(part.position_std[2], Some(2.5));
    assert_eq!((part.quality, part.satellites), (Some(FixQuality::RtkFixed), Some(14)));
    assert_eq!(part.epoch, Some(EpochTime::Gps(GpsTime::from_week(2445, 302_400_250_000_000))));
}

#[test]
fn a_receiver_without_a_solution_tells_no_place() {
    let none = PvtCartesian { mode: SbfMode::of(FixQuality::Invalid), extra: None, ..cartesian() };
    let part = PvtCartesian::read(&none.write()).unwrap().part();
    assert_eq!((part.position, part.velocity, part.invalid), (None, [None; 3], true));
    let missing = PvtCartesian { position: None, velocity: None, ..cartesian() };
    let back = PvtCartesian::read(&missing.write()).unwrap();
    assert_eq!((back, back.part().position), (missing, None));
}

#[test]
fn only_one_fixed_line_from_a_base_that_moves_is_a_heading() {
    let moving = vector(SbfSolution::MovingBaseFixed);
    let told = |vectors: Vec<BaseVector>| {
        let block = BaseVectorGeod { stamp: stamp(), vectors };
        let back = BaseVectorGeod::read(&block.write()).unwrap();
        assert_eq!(back, block);
        back.part().heading
    };
    let heading = told(vec![vector(SbfSolution::RtkFixed), moving]).unwrap();
    assert!((heading.to_degrees() - 225.0).abs() < 1e-9, "from the base to the receiver");
    for vectors in [
        vec![],
        vec![vector(SbfSolution::RtkFixed)],
        vec![vector(SbfSolution::MovingBaseFloat)],
        vec![moving, moving],
        vec![BaseVector { mode: SbfMode { error: 3, ..moving.mode }, ..moving }],
        vec![BaseVector { relative: [Some(0.0), Some(0.01), None], ..moving }],
    ] {
        assert_eq!(told(vectors), None);
    }
}
