//! What the atmosphere adds to a range: ionosphere by the broadcast models, troposphere by a standard one.

mod klobuchar;
mod nequick;
mod troposphere;

pub use insd_base::satellites::LookAngles;
pub use klobuchar::klobuchar;
pub use nequick::NeQuickG;
pub use troposphere::{Mapping, Troposphere};
