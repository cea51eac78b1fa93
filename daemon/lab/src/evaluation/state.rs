//! Error states of the filter as a file: `t_s,state,component,unit,axes,value,sigma`.

use insd_base::Time;
use insd_nav::filter::state_estimates::StateEstimate;
use serde::{Deserialize, Serialize};

/// One component of one error state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StateRow {
    /// Time of validity, s.
    pub t_s: f64,
    /// Which block: `gyro_bias`, `log_scale`, ...
    pub state: String,
    /// Which of its components, from 0.
    pub component: usize,
    /// Unit of value and sigma.
    pub unit: String,
    /// Its axes: `ecef`, `body`, `ned`, `computed_ned`, `scalar`.
    pub axes: String,
    /// What is estimated; empty of the attitude.
    pub value: Option<f64>,
    /// 1-sigma of its error.
    pub sigma: f64,
}

impl StateRow {
    /// That of a component at a time.
    #[must_use]
    pub fn of(time: Time, own: &StateEstimate) -> Self {
        StateRow {
            t_s: time.as_seconds(),
            state: own.name.to_owned(),
            component: own.component,
            unit: own.unit.to_owned(),
            axes: own.axes.as_str().to_owned(),
            value: own.value,
            sigma: own.sigma,
        }
    }
}
