//! The last lines that were logged.

use std::collections::VecDeque;
use std::fmt::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use insd_config::calendar;
use insd_web::snapshot::{MAX_EVENTS, ShownEvent as Line, ShownSeverity};
use tracing::field::{Field, Visit};
use tracing::{Event, Level, Subscriber};
use tracing_subscriber::Layer;
use tracing_subscriber::layer::Context;

use crate::clock::HostClock;

/// Longest line that is kept, bytes.
const LONGEST: usize = 500;

/// Keeps the last lines.
#[derive(Clone, Debug)]
pub(super) struct Recent {
    lines: Arc<Mutex<VecDeque<Line>>>,
    clock: HostClock,
}

impl Default for Recent {
    fn default() -> Self {
        Recent { lines: Arc::default(), clock: HostClock::start() }
    }
}

impl Recent {
    pub(super) fn lines(&self) -> Vec<Line> {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).iter().cloned().collect()
    }
}

impl<S: Subscriber> Layer<S> for Recent {
    fn on_event(&self, event: &Event<'_>, _: Context<'_, S>) {
        let severity = match *event.metadata().level() {
            Level::ERROR => ShownSeverity::Error,
            Level::WARN => ShownSeverity::Warn,
            Level::INFO => ShownSeverity::Info,
            Level::DEBUG | Level::TRACE => return,
        };
        let mut words = Words::default();
        event.record(&mut words);
        let stamp = self.clock.now();
        let line = Line {
            at_s: stamp.monotonic.as_seconds(),
            utc: Some(calendar::rfc3339_millis(stamp.system)),
            severity,
            text: words.text(),
        };
        let mut lines = self.lines.lock().unwrap_or_else(PoisonError::into_inner);
        if lines.len() >= MAX_EVENTS {
            lines.pop_front();
        }
        lines.push_back(line);
    }
}

/// A line in the making: what is said, and the fields beside it.
#[derive(Debug, Default)]
struct Words {
    message: String,
    fields: String,
}

impl Words {
    fn text(self) -> String {
        let mut text = self.message + &self.fields;
        if text.len() > LONGEST {
            text.truncate(text.floor_char_boundary(LONGEST));
        }
        text
    }
}

impl Visit for Words {
    fn record_str(&mut self, field: &Field, value: &str) {
        self.record_debug(field, &format_args!("{value}"));
    }

    fn record_debug(&mut self, field: &Field, value: &dyn fmt::Debug) {
        // a text takes all that is written to it
        let _ = match field.name() {
            "message" => write!(self.message, "{value:?}"),
            "at" => Ok(()),
            name => write!(self.fields, " {name}={value:?}"),
        };
    }
}
