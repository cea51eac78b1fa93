//! `--without WHAT,WHAT`: what a voyage has and a replay is not to use.

use insd_base::{Received, Source};
use insd_config::BadInput;

use crate::camera_voyage::CameraWay;
use crate::ranges::GnssUse;

/// Something that a replay leaves out, to see what it gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Without {
    /// What is learnt of log and IMU while she is well aided.
    Learning,
    /// Images of a camera and what was made of them.
    Camera,
    /// The folder `raw/`, as if it were not there.
    Raw,
    /// The Doppler log, as if `log.csv` were not there.
    Log,
    /// Fixes and ranges.
    Gnss,
}

impl Without {
    /// What is made of GNSS, after all that the options say of it; `None` if they leave the choice.
    ///
    /// # Errors
    /// One option asks for what another leaves out.
    pub(super) fn gnss(
        without: &[Without],
        asked: Option<GnssUse>,
    ) -> Result<Option<GnssUse>, BadInput> {
        if without.contains(&Without::Gnss) {
            return match asked.filter(|way| *way != GnssUse::None) {
                Some(_) => Err(BadInput("--without gnss leaves nothing for --gnss".to_owned())),
                None => Ok(Some(GnssUse::None)),
            };
        }
        if without.contains(&Without::Raw) {
            return match asked {
                Some(way @ (GnssUse::Tight | GnssUse::PhaseRates)) => {
                    let way = if way == GnssUse::Tight { "tight" } else { "phase-rates" };
                    Err(BadInput(format!("--without raw leaves nothing for --gnss {way}")))
                }
                other => Ok(other.or(Some(GnssUse::Loose))),
            };
        }
        Ok(asked)
    }

    /// What is made of a camera, after all that the options say of it; `None` if nothing is.
    ///
    /// # Errors
    /// One option asks for what another leaves out.
    pub(super) fn camera(
        without: &[Without],
        asked: Option<CameraWay>,
    ) -> Result<Option<CameraWay>, BadInput> {
        if !without.contains(&Without::Camera) {
            return Ok(Some(asked.unwrap_or_default()));
        }
        match asked {
            Some(_) => Err(BadInput("--without camera leaves nothing for --camera".to_owned())),
            None => Ok(None),
        }
    }

    /// Whether a message is of a sensor that is left out for the whole voyage.
    pub(super) fn drops(without: &[Without], received: &Received) -> bool {
        matches!(received.source, Source::Log(_)) && without.contains(&Without::Log)
    }
}
