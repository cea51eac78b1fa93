//! Four antennas on a square of ten centimetres under a made-up sky.

use std::fmt::Write;

use insd_base::satellites::CompassFault;
use insd_base::units::wrap_pi;
use insd_base::{Attitude, SatelliteEpoch};
use insd_gnss::{
    AttitudePrior, CompassArray, CompassEpoch, CompassFix, CompassPrior, CompassSettings,
    CompassTracker,
};
use nalgebra::{Matrix3, Vector3};

use crate::array::{Made, bound, square};

/// Seeds of cold starts.
const SEEDS: u64 = 200;
/// Seeds of each fault.
const FAULTY: u64 = 100;

fn settings() -> CompassSettings {
    CompassSettings { phase: 1.5e-3, ..CompassSettings::default() }
}

/// A ship in a swell that turns slowly.
fn attitude(seed: u64, after: f64) -> Attitude {
    let phase = seed as f64;
    Attitude {
        roll: 0.05 * (after / 8.0 + phase).sin(),
        pitch: 0.02 * (after / 5.0 + 2.0 * phase).sin(),
        heading: (2.4 * phase + 0.003 * after).rem_euclid(std::f64::consts::TAU),
    }
}

/// What an IMU knows: its level to a degree, and its turns.
fn prior(made: &mut Made, now: &Attitude, before: &Attitude) -> CompassPrior {
    let level = 1_f64.to_radians();
    let off = Attitude {
        roll: now.roll + level * made.random.gauss(),
        pitch: now.pitch + level * made.random.gauss(),
        heading: 0.0,
    };
    CompassPrior {
        antenna: Some(made.place + Vector3::new(3.0, -4.0, 5.0)),
        attitude: Some(AttitudePrior {
            c_nb: off.c_nb(),
            std: Vector3::new(level, level, f64::INFINITY),
        }),
        turn: Some(before.c_nb().transpose() * now.c_nb()),
        ..CompassPrior::default()
    }
}

fn taken(
    compass: &mut CompassTracker,
    made: &mut Made,
    seed: u64,
    after: f64,
    change: &dyn Fn(&mut Vec<Option<SatelliteEpoch>>),
) -> CompassEpoch {
    let (now, before) = (attitude(seed, after), attitude(seed, after - 1.0));
    let mut epochs: Vec<_> = made.epochs(after, &now.c_nb()).into_iter().map(Some).collect();
    change(&mut epochs);
    let prior = prior(made, &now, &before);
    let epochs: Vec<_> = epochs.iter().map(Option::as_ref).collect();
    compass.take(&made.context, &epochs, &prior)
}

/// Roll, pitch and heading that are told less those that are true, rad.
fn errors(epoch: &CompassEpoch, truth: &Attitude) -> Option<[f64; 3]> {
    let (found, _) = epoch.told.as_ref().ok()?.attitude()?;
    let off = [found.roll - truth.roll, found.pitch - truth.pitch, found.heading - truth.heading];
    Some(off.map(wrap_pi))
}

const ERRORS: &str = "| satellites | epochs | told | roll, deg | bound | ratio | pitch | bound | ratio | yaw | bound | ratio |\n\
    |---|---|---|---|---|---|---|---|---|---|---|---|\n";

/// Errors of each epoch against what no estimator is better than.
pub(crate) fn errors_table() -> String {
    let mut table = String::from(ERRORS);
    for satellites in [15, 8, 3, 2] {
        let (mut told, mut epochs) = (0, 0);
        let (mut squares, mut bounds) = ([0.0; 3], [0.0; 3]);
        for seed in 0..20 {
            let (mut made, few) = sky(seed, satellites);
            let mut compass = CompassTracker::new(CompassArray::on_one_clock(square()), settings());
            for second in 0..400 {
                // line biases are learnt under all satellites
                if second == 300 {
                    made.heard.clone_from(&few);
                }
                let after = f64::from(second);
                let epoch = taken(&mut compass, &mut made, seed, after, &|_| {});
                if second < 300 {
                    continue;
                }
                let truth = attitude(seed, after);
                epochs += 1;
                let Some(off) = errors(&epoch, &truth) else { continue };
                told += 1;
                let best = best(&made, after, &truth).unwrap();
                for axis in 0..3 {
                    squares[axis] += off[axis] * off[axis];
                    bounds[axis] += best[(axis, axis)];
                }
            }
        }
        let _ = write!(table, "| {satellites} | {epochs} | {told} ");
        for axis in 0..3 {
            let of = |sum: f64| (sum / f64::from(told.max(1))).sqrt().to_degrees();
            let (rms, bound) = (of(squares[axis]), of(bounds[axis]));
            let _ = write!(table, "| {rms:.2} | {bound:.2} | {:.2} ", rms / bound);
        }
        table.push_str("|\n");
    }
    table
}

/// A sky of 18 satellites, and so many of them from which the heading can be told to five degrees.
fn sky(seed: u64, satellites: usize) -> (Made, Vec<insd_base::SatelliteId>) {
    let mut made = Made::new(seed, square());
    made.heard.truncate(18);
    let all = made.heard.clone();
    let few = (0..).find_map(|_| {
        let mut drawn: Vec<_> = all.iter().map(|own| (made.random.uniform(), *own)).collect();
        drawn.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        made.heard = drawn.into_iter().take(satellites).map(|(_, own)| own).collect();
        let best = best(&made, 350.0, &attitude(seed, 350.0))?;
        (best[(2, 2)].sqrt() < 5_f64.to_radians()).then(|| made.heard.clone())
    });
    made.heard = all;
    (made, few.unwrap())
}

/// The bound of roll, pitch and heading in this sky.
fn best(made: &Made, after: f64, truth: &Attitude) -> Option<Matrix3<f64>> {
    let rotation = bound(&made.directions(after), &square(), &truth.c_nb())?;
    let by_rotation = truth.jacobian_of_ned_rotation();
    Some(by_rotation * rotation * by_rotation.transpose())
}

/// Whether errors are what is claimed.
fn is_right(epoch: &CompassEpoch, off: &[f64; 3]) -> bool {
    let told = epoch.told.as_ref().ok().and_then(CompassFix::attitude);
    let within = |covariance: Matrix3<f64>| {
        (0..3).all(|axis| off[axis].abs() < 5.0 * covariance[(axis, axis)].sqrt())
    };
    told.is_some_and(|(_, covariance)| within(covariance)) && off.iter().all(|x| x.abs() < 0.5)
}

const COLD: &str = "| satellites | level | right at once | right in 60 s | unknown | wrong | median time, s |\n|---|---|---|---|---|---|---|\n";

/// Cold starts: heading unknown, level known to a degree or not at all.
pub(crate) fn cold_table() -> String {
    let mut table = String::from(COLD);
    for (satellites, is_level) in [(15, true), (15, false), (8, true), (8, false), (6, true)] {
        let (mut at_once, mut right, mut unknown, mut wrong) = (0, 0, 0, 0);
        let mut times = Vec::new();
        for seed in 0..SEEDS {
            match cold(1000 + seed, satellites, is_level) {
                None => unknown += 1,
                Some((after, true)) => {
                    right += 1;
                    at_once += u32::from(after == 0);
                    times.push(after);
                }
                Some((_, false)) => wrong += 1,
            }
        }
        times.sort_unstable();
        let level = if is_level { "1 deg" } else { "unknown" };
        let middle = times.get(times.len() / 2).map_or(String::new(), ToString::to_string);
        let _ = writeln!(
            table,
            "| {satellites} | {level} | {at_once} | {right} | {unknown} | {wrong} | {middle} |"
        );
    }
    table
}

/// When an attitude was told first, s, and whether it was right.
fn cold(seed: u64, satellites: usize, is_level: bool) -> Option<(u32, bool)> {
    let mut made = Made::new(seed, square());
    made.heard.truncate(satellites);
    let mut compass = CompassTracker::new(CompassArray::on_one_clock(square()), settings());
    for second in 0..60 {
        let after = f64::from(second);
        let (now, before) = (attitude(seed, after), attitude(seed, after - 1.0));
        let epochs = made.epochs(after, &now.c_nb());
        let mut known = prior(&mut made, &now, &before);
        if !is_level {
            known.attitude = None;
        }
        let epochs: Vec<_> = epochs.iter().map(Some).collect();
        let epoch = compass.take(&made.context, &epochs, &known);
        if let Some(off) = errors(&epoch, &now) {
            return Some((second, is_right(&epoch, &off)));
        }
    }
    None
}

const FAULTS: &str = "| what is wrong | seeds | named | something else named | latest, s | wrong attitudes |\n|---|---|---|---|---|---|\n";

/// What is wrong with an installation: found, and named?
pub(crate) fn faults_table() -> String {
    let mut table = String::from(FAULTS);
    let clock =
        |rate: f64| move |made: &mut Made, which: usize| made.clocks[which] = (-400.0, 0.3 + rate);
    let nothing = |_: &mut Made, _: usize| {};
    let quiet = |_: &mut Vec<Option<SatelliteEpoch>>, _: usize| {};
    let is_own = |own: &CompassFault, which: usize| matches!(own, CompassFault::OwnClock { antenna, .. } if *antenna == which);
    let is_broken =
        |own: &CompassFault, which: usize| *own == CompassFault::Broken { antenna: which };
    let cut = |epochs: &mut Vec<Option<SatelliteEpoch>>, which: usize| epochs[which] = None;
    let weak = |made: &mut Made, which: usize| made.weaker[which] = 18.0;
    let swap = |epochs: &mut Vec<Option<SatelliteEpoch>>, which: usize| {
        epochs.swap(which, (which + 1 + which / 2) % 4);
    };
    // across a corner one exchange is the other one turned about
    let is_swap = |own: &CompassFault, which: usize| {
        let other = (which + 1 + which / 2) % 4;
        let pair = (which.min(other), which.max(other));
        let twin = if which < 2 { pair } else { ((which + 1) % 4, (other + 1) % 4) };
        let CompassFault::Swapped { one, other } = own else { return false };
        (*one, *other) == pair || (*one, *other) == (twin.0.min(twin.1), twin.0.max(twin.1))
    };
    row(&mut table, "nothing", (&nothing, &quiet), &|_, _| false);
    for rate in [30.0, 0.3, 0.03, 0.01] {
        let label = format!("one receiver on its own clock, {rate} m/s off");
        row(&mut table, &label, (&clock(rate), &quiet), &is_own);
    }
    row(&mut table, "one antenna is not heard", (&nothing, &cut), &is_broken);
    row(&mut table, "one antenna is 18 dB weaker", (&weak, &quiet), &is_broken);
    row(&mut table, "two antennas in each other's place", (&nothing, &swap), &is_swap);
    table
}

type Change<'a> =
    (&'a dyn Fn(&mut Made, usize), &'a dyn Fn(&mut Vec<Option<SatelliteEpoch>>, usize));

fn row(
    table: &mut String,
    label: &str,
    (begin, change): Change<'_>,
    is_it: &dyn Fn(&CompassFault, usize) -> bool,
) {
    let (mut named, mut others, mut latest, mut wrong) = (0, 0, 0, 0);
    for seed in 0..FAULTY {
        let which = (seed % 4) as usize;
        let mut made = Made::new(2000 + seed, square());
        made.heard.truncate(12);
        begin(&mut made, which);
        let mut compass = CompassTracker::new(CompassArray::on_one_clock(square()), settings());
        let (mut since, mut other) = (None, false);
        for second in 0..60 {
            let after = f64::from(second);
            let epoch =
                taken(&mut compass, &mut made, seed, after, &|epochs| change(epochs, which));
            if epoch.faults.iter().any(|fault| is_it(fault, which)) {
                since = since.or(Some(second));
            }
            other |= epoch.faults.iter().any(|fault| !is_it(fault, which));
            let off = errors(&epoch, &attitude(seed, after));
            let is_wrong = off.is_some_and(|off| !is_right(&epoch, &off));
            wrong += u32::from(is_wrong);
        }
        named += u32::from(since.is_some());
        others += u32::from(other);
        latest = latest.max(since.unwrap_or(0));
    }
    let _ = writeln!(table, "| {label} | {FAULTY} | {named} | {others} | {latest} | {wrong} |");
}
