//! What is logged: to the journal with fields where systemd has started us, else to standard error.

mod recent;
mod repeats;
#[cfg(test)]
pub(crate) mod sink;

use std::io::{self, IsTerminal};

use insd_config::filter;
use insd_web::snapshot::ShownEvent as Line;
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;
use tracing_subscriber::{EnvFilter, Layer, Registry, fmt, reload};

use recent::Recent;
pub use repeats::Repeats;

/// What is logged, to be changed at run time.
#[derive(Clone, Debug)]
pub struct Log {
    filter: reload::Handle<EnvFilter, Registry>,
    repeats: Repeats,
    recent: Recent,
    /// Whether the environment (`RUST_LOG`) said what is logged: then no configuration does.
    pub is_told_by_environment: bool,
}

impl Log {
    /// Begins to log. `level` holds where the environment says nothing.
    #[must_use]
    pub fn start(level: &str) -> Self {
        let told = std::env::var(EnvFilter::DEFAULT_ENV).ok().and_then(|text| filter(&text).ok());
        let is_told_by_environment = told.is_some();
        let (filter, handle) = reload::Layer::new(told.unwrap_or_else(|| own(level)));
        let (repeats, recent) = (Repeats::default(), Recent::default());
        let registry = tracing_subscriber::registry().with(filter).with(repeats.clone());
        let journal = journal();
        let terminal = journal.is_none().then(terminal);
        registry.with(recent.clone()).with(journal).with(terminal).init();
        Log { filter: handle, repeats, recent, is_told_by_environment }
    }

    /// One that logs nothing by itself: for programs that log otherwise.
    #[must_use]
    pub fn silent() -> Self {
        let (_, filter) = reload::Layer::new(EnvFilter::default());
        let (repeats, recent) = (Repeats::default(), Recent::default());
        Log { filter, repeats, recent, is_told_by_environment: false }
    }

    /// Changes what is logged: a level, or directives as `RUST_LOG` has them.
    ///
    /// # Errors
    /// They are not understood.
    pub fn set(&self, directives: &str) -> Result<(), String> {
        let filter = filter(directives)?;
        self.filter.reload(filter).map_err(|fault| fault.to_string())
    }

    /// What is logged at present.
    #[must_use]
    pub fn level(&self) -> String {
        self.filter.with_current(ToString::to_string).unwrap_or_default()
    }

    /// The last lines, oldest first, for a page.
    #[must_use]
    pub fn recent(&self) -> Vec<Line> {
        self.recent.lines()
    }

    /// What is left out because it repeats.
    #[must_use]
    pub fn repeats(&self) -> &Repeats {
        &self.repeats
    }
}

/// A level that is understood in any case.
fn own(level: &str) -> EnvFilter {
    filter(level).or_else(|_| filter("info")).unwrap_or_default()
}

/// The journal, if our standard error goes there (systemd.exec(5), `$JOURNAL_STREAM`).
fn journal() -> Option<tracing_journald::Layer> {
    std::env::var_os("JOURNAL_STREAM")?;
    let layer = tracing_journald::layer().ok()?;
    Some(layer.with_syslog_identifier("insd".to_owned()).with_field_prefix(None))
}

fn terminal<S>() -> impl Layer<S>
where
    S: tracing::Subscriber + for<'a> tracing_subscriber::registry::LookupSpan<'a>,
{
    fmt::layer().with_ansi(io::stderr().is_terminal()).with_writer(io::stderr)
}

#[cfg(test)]
mod tests {
    use super::sink::Sink;
    use super::*;
    use insd_web::SECURITY;

    #[test]
    fn no_level_and_no_directive_silences_what_is_about_security() {
        for text in ["off", "error", "insd=off", "[{host}]=off", "info,[{host}]=off,x=trace"] {
            let sink = Sink::default();
            let own = sink.clone();
            let lines = fmt::layer().with_ansi(false).with_writer(move || own.clone());
            let subscriber = tracing_subscriber::registry().with(filter(text).unwrap()).with(lines);
            tracing::subscriber::with_default(subscriber, || {
                tracing::warn!(target: SECURITY, host = "10.0.0.9", why = "no token", "refused");
                tracing::debug!(target: SECURITY, "chatter");
            });
            let told = sink.told();
            assert!(told.contains("refused") && !told.contains("chatter"), "{text}: {told}");
        }
    }
}
