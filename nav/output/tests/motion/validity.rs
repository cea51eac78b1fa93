//! When a telegram says that something is unknown or not to be relied on, and when it is not sent.

use insd_base::{Attitude, Body, Geodetic, Heave, HeaveQuality, Mode, Ned};
use insd_output::{Manner, OutputEpoch, Policy};
use insd_wire::motion::Rated;
use insd_wire::motion::em::{EmAttitude, EmStatus};
use insd_wire::motion::seapath::Seapath23;
use insd_wire::motion::tss1::Tss1Aiding;
use proptest::prelude::*;

use crate::ship::*;

const KINDS: [&str; 6] = ["TSS1", "EM1000", "EM3000", "KMB", "SEAPATH.23", "SEAPATH.26"];

const MODES: [Mode; 7] = [
    Mode::CoarseAlignment,
    Mode::FineAlignment,
    Mode::InMotionAlignment,
    Mode::Aided,
    Mode::DeadReckoning,
    Mode::Inertial,
    Mode::Fault,
];

fn of_quality(quality: HeaveQuality) -> OutputEpoch {
    heaving(|heave| heave.quality = quality)
}

/// The mark of a group: whether it is reduced, `None` if it is not valid.
fn mark<T: Copy>(group: Option<Rated<T>>) -> Option<bool> {
    group.map(|group| group.reduced)
}

#[test]
fn tss1_is_not_sent_unless_all_of_it_is_known() {
    assert!(tss1(&epoch()).is_some());
    for silent in [
        not_level(),
        in_mode(Mode::Fault),
        heaving(|heave| heave.heave = f64::NAN),
        heaving(|heave| heave.heave = 120.0),
        OutputEpoch { heave: None, ..epoch() },
        OutputEpoch { acceleration: None, ..epoch() },
        OutputEpoch { solution: None, ..epoch() },
    ] {
        assert_eq!(tss1(&silent), None, "{silent:?}");
    }
}

#[test]
fn the_letter_of_tss1_follows_from_the_mode_and_the_heave() {
    use Tss1Aiding::{Full, Heading, Speed, Unaided};
    let letters = [Unaided, Unaided, Speed, Full, Full, Heading];
    for (mode, aiding) in MODES.into_iter().zip(letters) {
        assert_eq!(tss1(&in_mode(mode)).unwrap().aiding, aiding, "{mode:?}");
    }
    assert_eq!(tss1(&bad_heading()).unwrap().aiding, Speed);
    for (quality, letter) in [
        (HeaveQuality::Unsettled, b'f'),
        (HeaveQuality::Reduced, b'F'),
        (HeaveQuality::Settled, b'F'),
    ] {
        assert_eq!(said("TSS1", &of_quality(quality)).unwrap()[13], letter);
    }
    near(tss1(&of_quality(HeaveQuality::Unsettled)).unwrap().heave, 1.25, CENTI);
}

#[test]
fn the_status_of_em3000_follows_from_mode_heave_and_heading() {
    use EmStatus::{Error, Normal, Reduced, Unsettled};
    let by_mode = [Unsettled, Unsettled, Unsettled, Normal, Reduced, Reduced, Error];
    for (mode, status) in MODES.into_iter().zip(by_mode) {
        assert_eq!(em3000(&in_mode(mode)).status, Some(status), "{mode:?}");
    }
    for (epoch, status) in [
        (of_quality(HeaveQuality::Unsettled), Unsettled),
        (of_quality(HeaveQuality::Reduced), Reduced),
        (OutputEpoch { heave: None, ..epoch() }, Unsettled),
        (not_level(), Unsettled),
        (estimated_heading(), Reduced),
        (bad_heading(), Reduced),
        (OutputEpoch { solution: None, ..epoch() }, Error),
    ] {
        assert_eq!(em3000(&epoch).status, Some(status), "{epoch:?}");
    }
    assert_eq!(said("EM3000", &epoch()).unwrap()[..2], [0x90, 0x90]);
    assert_eq!(said("EM3000", &not_level()).unwrap()[0], 0x9A);
}

#[test]
fn em3000_says_of_each_value_whether_it_is_known() {
    let told = em3000(&not_level());
    assert_eq!((told.roll, told.pitch), (None, None));
    assert!(told.heave.is_some() && told.heading.is_some());
    assert_eq!(em3000(&bad_heading()).heading, None);
    assert_eq!(em3000(&OutputEpoch { heave: None, ..epoch() }).heave, None);
    assert!(em3000(&of_quality(HeaveQuality::Unsettled)).heave.is_some());
    assert_eq!(em3000(&heaving(|heave| heave.heave = 12.0)).heave, None);
    for lost in [in_mode(Mode::Fault), OutputEpoch { solution: None, ..epoch() }] {
        let EmAttitude { roll, pitch, heave, heading, .. } = em3000(&lost);
        assert_eq!([roll, pitch, heave, heading], [None; 4]);
    }
}

#[test]
fn em1000_tells_nothing_that_would_need_a_status_and_is_silent_if_nothing_is_known() {
    let told = em("EM1000", &of_quality(HeaveQuality::Unsettled)).unwrap();
    assert_eq!((told.status, told.heave), (None, None));
    assert!(told.roll.is_some() && told.heading.is_some());
    assert!(em("EM1000", &of_quality(HeaveQuality::Reduced)).unwrap().heave.is_some());
    assert_eq!(em("EM1000", &bad_heading()).unwrap().heading, None);
    assert_eq!(em("EM1000", &not_level()).unwrap().roll, None);
    assert_eq!(em("EM1000", &in_mode(Mode::Fault)), None);
    assert_eq!(em("EM1000", &OutputEpoch { solution: None, heave: None, ..epoch() }), None);
}

#[test]
fn each_group_of_the_status_formats_is_marked_by_the_policy() {
    let good = Some(false);
    let all = [good; 4];
    let marks = |told: Seapath23| {
        [mark(told.place), mark(told.tilt), mark(told.heading), mark(told.vertical)]
    };
    for (epoch, expected) in [
        (epoch(), all),
        (in_mode(Mode::DeadReckoning), [Some(true), good, good, good]),
        (in_mode(Mode::FineAlignment), [Some(true), good, None, good]),
        (with(|ship| ship.sigma.position = Ned::new(90.0, 90.0, 1.0)), [None, good, good, good]),
        (with(|ship| ship.sigma.velocity = Ned::new(2.0, 0.0, 0.0)), [None, good, good, good]),
        (not_level(), [good, None, good, good]),
        (estimated_heading(), [good, good, Some(true), good]),
        (bad_heading(), [good, good, None, good]),
        (of_quality(HeaveQuality::Reduced), [good, good, good, Some(true)]),
        (of_quality(HeaveQuality::Unsettled), [good, good, good, None]),
        (OutputEpoch { heave: None, ..epoch() }, [good, good, good, None]),
    ] {
        for told in status_formats(&epoch) {
            assert_eq!(marks(told), expected, "{epoch:?}");
        }
    }
}

#[test]
fn an_acceleration_to_the_north_needs_a_heading() {
    let marked = |epoch: &OutputEpoch| mark(kmb(epoch).unwrap().acceleration);
    assert_eq!(marked(&epoch()), Some(false));
    assert_eq!(marked(&estimated_heading()), Some(true));
    assert_eq!(marked(&bad_heading()), None);
    assert_eq!(marked(&not_level()), None);
    assert_eq!(marked(&OutputEpoch { acceleration: None, ..epoch() }), None);
}

#[test]
fn an_error_is_told_only_of_what_is_told() {
    let sigma = |epoch: &OutputEpoch| kmb(epoch).unwrap().sigma;
    assert_eq!(sigma(&bad_heading()).heading, None);
    assert_eq!(sigma(&not_level()).roll, None);
    assert_eq!(sigma(&of_quality(HeaveQuality::Unsettled)).heave, None);
    let lost = sigma(&with(|ship| ship.sigma.position = Ned::new(90.0, 90.0, 1.0)));
    assert_eq!([lost.north, lost.east, lost.height], [None; 3]);
}

#[test]
fn the_delayed_heave_has_a_quality_of_its_own() {
    let delayed = |quality: HeaveQuality| {
        let epoch = heaving(|heave| {
            heave.quality = HeaveQuality::Unsettled;
            heave.delayed.as_mut().unwrap().quality = quality;
        });
        let by_seapath = seapath_26(&epoch).unwrap().delayed_heave;
        (mark(kmb(&epoch).unwrap().delayed_heave), by_seapath.is_some())
    };
    assert_eq!(delayed(HeaveQuality::Settled), (Some(false), true));
    assert_eq!(delayed(HeaveQuality::Reduced), (Some(true), true));
    assert_eq!(delayed(HeaveQuality::Unsettled), (None, false));
    let none = heaving(|heave| heave.delayed = None);
    assert_eq!(kmb(&none).unwrap().delayed_heave, None);
    assert_eq!(seapath_26(&none).unwrap().delayed_heave, None);
}

#[test]
fn a_telegram_with_a_time_is_not_sent_without_utc_and_none_with_a_fault() {
    let timed = ["KMB", "SEAPATH.23", "SEAPATH.26"];
    for name in timed {
        assert_eq!(said(name, &OutputEpoch { utc: None, ..epoch() }), None, "{name}");
        assert_eq!(said(name, &in_mode(Mode::Fault)), None, "{name}");
        assert_eq!(said(name, &OutputEpoch { solution: None, ..epoch() }), None, "{name}");
        let lost = with(|solution| solution.rate = Body::new(f64::NAN, 0.0, 0.0));
        assert_eq!(said(name, &lost), None, "{name}: its rates cannot be marked");
    }
    for name in KINDS.iter().filter(|name| !timed.contains(*name)) {
        assert!(said(name, &OutputEpoch { utc: None, ..epoch() }).is_some(), "{name}");
    }
}

#[test]
fn nothing_comes_from_a_simulator_unless_it_is_asked_for() {
    for name in KINDS {
        for mode in MODES {
            let manner = Manner { simulated: true, ..Manner::default() };
            assert_eq!(said_by(&manner, name, &in_mode(mode)), None, "{name}");
        }
        for epoch in [epoch(), estimated_heading()] {
            let manner = Manner {
                simulated: true,
                unmarked_when_simulated: true,
                policy: Policy::default(),
            };
            assert_eq!(said_by(&manner, name, &epoch), said(name, &epoch), "{name}");
        }
    }
}

proptest! {
    #[test]
    fn whatever_is_known_every_telegram_that_is_sent_is_readable(
        values in prop::array::uniform16(prop_oneof![4 => -4.0..4.0, 1 => any::<f64>()]),
        mode in 0..7_usize, good: bool,
    ) {
        let [lat, lon, height, vn, ve, vd, roll, pitch, heading, wx, wy, wz, a, b, c, d] = values;
        let mut told = with(|ship| {
            ship.position = Geodetic { latitude: lat, longitude: lon, height };
            ship.velocity = Ned::new(vn, ve, vd);
            ship.attitude = Attitude { roll, pitch, heading };
            ship.mode = MODES[mode];
            if !good {
                ship.rate = Body::new(wx, wy, wz);
                ship.sigma.heading = d;
                ship.sigma.position = Ned::new(d, c, b);
            }
        });
        told.acceleration = Some(Ned::new(a, b, c));
        told.heave = Some(Heave { heave: a, rate: b, sigma: c, ..heave() });
        tss1(&told);
        em("EM1000", &told);
        em("EM3000", &told);
        kmb(&told);
        seapath_23(&told);
        seapath_26(&told);
    }
}
