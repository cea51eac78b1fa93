//! The ports that are written to.

use insd_base::{Arrival, Input, PortId, Solution, UtcTime};
use insd_drivers::ports::{self, OutputPort, Surroundings};
use insd_output::{CivilTime, Port};

use crate::config::Config;

/// All ports that are written to.
pub(super) struct Outputs {
    first: u16,
    ports: Vec<Output>,
}

struct Output {
    name: String,
    maker: Port,
    carrier: OutputPort,
}

impl Outputs {
    /// Opens them; they are numbered from `first`. To be called inside the runtime.
    pub(super) fn open(config: &Config, first: u16, surroundings: &Surroundings) -> Self {
        let numbered = config.outputs.iter().zip(first..);
        let ports = numbered.map(|(output, number)| Output {
            name: output.name.clone(),
            maker: Port::new(output.port()),
            carrier: ports::spawn_output(PortId(number), output.carrier(), surroundings.clone()),
        });
        Outputs { first, ports: ports.collect() }
    }

    /// How many there are.
    pub(super) fn count(&self) -> u16 {
        u16::try_from(self.ports.len()).unwrap_or(u16::MAX)
    }

    /// Sends the sentences of a solution that are due; never waits.
    pub(super) fn send(&mut self, solution: &Solution, utc: Option<UtcTime>) {
        let civil = utc.and_then(CivilTime::from_utc);
        for output in &mut self.ports {
            let sentences = output.maker.sentences(solution, civil);
            if !sentences.is_empty() {
                output.carrier.send(sentences.to_vec());
            }
        }
    }

    /// Takes note of what became of one of them.
    pub(super) fn note(&self, arrival: &Arrival) {
        let index = usize::from(arrival.port.0.saturating_sub(self.first));
        if let (Some(output), Input::State(state)) = (self.ports.get(index), &arrival.input) {
            tracing::info!(output = output.name, dropped = output.carrier.dropped(), "{state}");
        }
    }
}
