//! Alerts to the bridge (IEC 62923, bridge alert management): what is wrong, who knows of it, and what
//! was answered.
//!
//! [`Watch`] finds from one epoch after the other which [`Condition`]s hold. [`AlertBoard`] keeps the
//! state of each alert, obeys the bridge's commands (ACN), and says what there is to tell by ALF, ALC
//! and ARC. Both are functions of what they are handed.
//!
//! The states of an alert and what leads from one to the next:
//!
//! ```text
//! normal N          -- raised --------> unacknowledged V, a caution: active A
//! unacknowledged V  -- acknowledged --> acknowledged A
//!                   -- silenced ------> silenced S, for 30 s, then V again
//!                   -- taken over ----> transferred O, while the bridge's HBT is heard, then V again
//!                   -- rectified -----> rectified U
//!                   -- 5 min ---------> V once more, as a warning or as an alarm
//! silenced S        as V
//! acknowledged A    -- rectified -----> N
//! transferred O     -- rectified -----> N
//!                   -- acknowledged --> A
//! rectified U       -- acknowledged --> N
//!                   -- raised --------> V
//! ```
//! A command for which an alert has no arrow here is refused (ARC), and so is one about an alert that is
//! none of ours. A caution needs no answer: it is active or normal.
//!
//! Sources: the states, the 30 s of silence and what a caution is, as makers describe them (Lars Thrane
//! LT-4100, Icom GM600, which also has that responsibility is given away only while a heartbeat is
//! heard); IMO MSC.302(87) 5.2 (one alert for one situation) and 7.3; IMO MSC.252(83) 19.2.1 (a warning
//! that is not acknowledged may become an alarm). Makers repeat such a warning after 60 s (Furuno
//! FAR-3210), 4 min (Cobham SAILOR 6300), or up to 5 min as set (JRC JMR-5400). Which commands are refused in
//! which state, and how long a heartbeat counts, are choices of this code; the standard itself was not
//! seen, and nothing here is verified against a bridge.

mod alert;
mod board;
mod conditions;
mod patience;
mod view;

pub use crate::epoch::AlertText;
pub use board::{AlertBoard, Announcement};
pub use conditions::{Condition, Watch};
pub use patience::{AlertConfig, Escalation};
pub use view::AlertView;
