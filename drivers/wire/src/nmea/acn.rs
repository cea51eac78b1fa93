//! ACN: what a bridge asks of a device about an alert.

use super::alert::{Alert, AlertCommand, AlertId};
use super::civil::TimeOfDay;
use super::kinds::{Clock, Needed, Then, letter};
use super::table::sentence;

sentence! {
    /// A command about an alert; one without the letter C is none. Sources as in `alert.rs`.
    approved Acn "ACN", longest 44;
    /// UTC of the command; may be empty.
    1 time: Option<TimeOfDay> = Clock(2);
    /// Which alert.
    2 alert: AlertId = Alert;
    /// What is to be done.
    5 command: AlertCommand = Then(Needed(letter()), b'C');
}
