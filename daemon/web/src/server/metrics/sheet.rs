//! A registry for one snapshot: it is filled, written and thrown away.

use std::sync::atomic::AtomicU64;

use prometheus_client::encoding::text::encode_registry;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::registry::Registry;

type Labels = Vec<(String, String)>;

/// All metrics of one kind of reading.
#[derive(Debug)]
pub(super) struct Sheet(Registry);

/// Values of one name that go up and down.
#[derive(Debug)]
pub(super) struct Gauges<const N: usize>(Family<Labels, Gauge<f64, AtomicU64>>, [&'static str; N]);

/// Counts of one name.
#[derive(Debug)]
pub(super) struct Counters<const N: usize>(Family<Labels, Counter>, [&'static str; N]);

impl Default for Sheet {
    fn default() -> Self {
        Sheet(Registry::with_prefix("insd"))
    }
}

impl Sheet {
    /// Values of a name, told apart by labels.
    pub(super) fn gauge<const N: usize>(
        &mut self,
        name: &str,
        help: &str,
        labels: [&'static str; N],
    ) -> Gauges<N> {
        let family = Family::default();
        self.0.register(name, help, family.clone());
        Gauges(family, labels)
    }

    /// Counts of a name; `_total` is added to it.
    pub(super) fn counter<const N: usize>(
        &mut self,
        name: &str,
        help: &str,
        labels: [&'static str; N],
    ) -> Counters<N> {
        let family = Family::default();
        self.0.register(name, help, family.clone());
        Counters(family, labels)
    }

    /// One value of a name; nothing if it is unknown.
    pub(super) fn value(&mut self, name: &str, help: &str, value: impl Into<Option<f64>>) {
        if let Some(value) = value.into().filter(|value| value.is_finite()) {
            let gauge = Gauge::<f64, AtomicU64>::default();
            gauge.set(value);
            self.0.register(name, help, gauge);
        }
    }

    /// One count of a name; `_total` is added to it.
    pub(super) fn count(&mut self, name: &str, help: &str, count: u64) {
        let counter = Counter::<u64>::default();
        counter.inc_by(count);
        self.0.register(name, help, counter);
    }

    /// All of it as text.
    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        // writing to a String cannot fail
        let _ = encode_registry(&mut text, &self.0);
        text
    }
}

impl<const N: usize> Gauges<N> {
    /// One value; nothing if it is unknown.
    pub(super) fn set(&self, values: &[&str; N], value: impl Into<Option<f64>>) {
        if let Some(value) = value.into().filter(|value| value.is_finite()) {
            self.0.get_or_create(&labelled(&self.1, values)).set(value);
        }
    }
}

impl<const N: usize> Counters<N> {
    /// One count.
    pub(super) fn set(&self, values: &[&str; N], count: u64) {
        self.0.get_or_create(&labelled(&self.1, values)).inc_by(count);
    }
}

fn labelled(names: &[&str], values: &[&str]) -> Labels {
    let pairs = names.iter().zip(values);
    pairs.map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect()
}
