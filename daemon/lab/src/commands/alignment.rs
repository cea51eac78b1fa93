//! The choice of alignment on the command line.

use clap::builder::PossibleValuesParser;
use clap::builder::TypedValueParser;
use insd_alignment::{AlignmentConfig, InMotion};
use insd_nav::berth::Method;

/// How the ship finds her attitude and heading.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct AlignmentArgs {
    /// How the sea is kept out of the alignment at the berth
    #[arg(long = "alignment", value_name = "METHOD", default_value = Method::default().as_str(),
        value_parser = methods())]
    moored: Method,
    /// How a ship under way finds her heading
    #[arg(long, value_name = "METHOD", default_value = InMotion::default().as_str(),
        value_parser = in_motion_methods())]
    in_motion: InMotion,
    /// The IMU has stayed powered since the state was stored, so that its biases hold too
    #[arg(long)]
    same_power_up: bool,
}

impl AlignmentArgs {
    /// As it is written on the command line.
    pub(super) fn words(&self) -> String {
        let [moored, in_motion] = [self.moored.as_str(), self.in_motion.as_str()];
        let same = if self.same_power_up { " --same-power-up" } else { "" };
        format!("--alignment {moored} --in-motion {in_motion}{same}")
    }

    /// As the engine takes it.
    #[must_use]
    pub fn config(&self) -> AlignmentConfig {
        AlignmentConfig {
            moored: self.moored,
            in_motion: self.in_motion,
            same_power_up: self.same_power_up,
            ..AlignmentConfig::default()
        }
    }
}

fn methods() -> impl TypedValueParser<Value = Method> {
    PossibleValuesParser::new(Method::ALL.map(Method::as_str))
        .map(|word| Method::from_word(&word).unwrap_or_default())
}

fn in_motion_methods() -> impl TypedValueParser<Value = InMotion> {
    PossibleValuesParser::new(InMotion::ALL.map(InMotion::as_str))
        .map(|word| InMotion::from_word(&word).unwrap_or_default())
}
