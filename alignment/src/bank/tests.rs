use super::*;
use insd_base::units::{DEG_PER_HOUR, DEG_PER_SQRT_HOUR, MICRO_G, MPS_PER_SQRT_HOUR};
use insd_base::{Geodetic, ImuSpec, LeverArms, Triad, earth};

/// Samples a second.
const RATE: f64 = 10.0;

fn tactical() -> ImuSpec {
    ImuSpec {
        rate: RATE,
        gyro: Triad {
            bias_std: 0.5 * DEG_PER_HOUR,
            instability_std: 0.1 * DEG_PER_HOUR,
            instability_time: 1000.0,
            random_walk: 0.05 * DEG_PER_SQRT_HOUR,
            scale_std: 1e-4,
        },
        accel: Triad {
            bias_std: 500.0 * MICRO_G,
            instability_std: 50.0 * MICRO_G,
            instability_time: 1000.0,
            random_walk: 0.029_42 * MPS_PER_SQRT_HOUR,
            scale_std: 2e-4,
        },
    }
}

fn place() -> Geodetic {
    Geodetic::from_degrees(35.0, 139.0, 20.0)
}

/// What ideal sensors of a ship say that heads north and surges by decimetres.
fn increment(step: usize) -> Increment {
    let at = |step: usize| Time::START + Span::from_seconds(step as f64 / RATE);
    let surge = 0.02 * (0.07 * step as f64 / RATE).cos();
    let gravity = earth::normal_gravity(place().latitude, place().height);
    let rate = earth::rate_n(place().latitude);
    Increment {
        from: at(step),
        to: at(step + 1),
        rotation: rate / RATE,
        velocity: Vector3::new(surge, 0.0, -gravity) / RATE,
        end_rate: rate,
        end_rate_variance: 0.0,
        angular_acceleration: Vector3::zeros(),
        rate_noise: Vector3::zeros(),
        force_noise: Vector3::zeros(),
        bridged: None,
        celsius: None,
    }
}

fn sailed(seconds: usize) -> Bank {
    let config = NavConfig::new(tactical(), LeverArms::default());
    let level = Level {
        time: Time::START,
        force: -Vector3::z() * earth::normal_gravity(place().latitude, place().height),
        rate: earth::rate_n(place().latitude),
    };
    let kinematics = Kinematics {
        position: place(),
        position_std: 1.0,
        velocity: Vector3::zeros(),
        velocity_std: 0.5,
        acceleration: Vector3::zeros(),
        moored: true,
        gnss_position: false,
        gnss_velocity: false,
    };
    let mut bank = Bank::new(&config, &level, &kinematics, Method::Moorings);
    (0..seconds * RATE as usize).for_each(|step| bank.advance(&increment(step)));
    bank
}

#[test]
fn all_headings_are_judged_by_the_sea_that_the_likeliest_has_learnt() {
    let bank = sailed(60);
    let waves = |member: &Member| member.navigator.moorings().expect("moored").waves_std();
    let likeliest = waves(&bank.members[bank.index_of_likeliest().expect("a member")]);
    assert!(bank.members.len() > 3, "{} are left", bank.members.len());
    for member in &bank.members {
        assert!((waves(member) - likeliest).abs() < 1e-12, "{} for {likeliest}", waves(member));
    }
}
