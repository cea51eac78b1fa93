//! ARC: a command about an alert is refused.

use super::alert::{Alert, AlertCommand, AlertId};
use super::civil::TimeOfDay;
use super::kinds::{Clock, Needed, letter};
use super::table::sentence;

sentence! {
    /// A refusal. Sources as in `alert.rs`.
    approved Arc "ARC", longest 42;
    /// UTC of the refusal; may be empty.
    1 time: Option<TimeOfDay> = Clock(2);
    /// Which alert.
    2 alert: AlertId = Alert;
    /// What is refused.
    5 command: AlertCommand = Needed(letter());
}
