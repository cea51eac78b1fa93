//! `insd fleet simulate`: a load for a broker and a sink.

use std::sync::Arc;

use insd_config::BadInput;
use insd_fleet::simulate::{FleetLoad, simulate};
use insd_lab::terminal::print;

use super::broker::BrokerArgs;
use crate::clock::HostClock;

/// Options of `insd fleet simulate`.
#[derive(Clone, Debug, clap::Args)]
pub struct SimulateFleetArgs {
    #[command(flatten)]
    broker: BrokerArgs,
    /// Ships
    #[arg(long, value_name = "N", default_value_t = 100)]
    ships: u32,
    /// Messages of each ship a second
    #[arg(long, value_name = "HZ", default_value_t = 1.0)]
    rate: f64,
    /// For so long
    #[arg(long, value_name = "S", default_value_t = 60.0)]
    seconds: f64,
}

/// Runs the command.
pub(super) fn run(args: &SimulateFleetArgs) -> anyhow::Result<()> {
    if args.ships == 0 || !(args.rate > 0.0 && args.seconds > 0.0) {
        return Err(
            BadInput("--ships, --rate and --seconds: expected more than 0".to_owned()).into()
        );
    }
    let load = FleetLoad {
        broker: args.broker.plan("insd-simulated")?,
        prefix: args.broker.topic.clone(),
        ships: args.ships,
        rate: args.rate,
        seconds: args.seconds,
    };
    let clock = HostClock::start();
    let runtime =
        tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build()?;
    let sent = runtime.block_on(simulate(load, Arc::new(move || clock.now())));
    let sent = sent.map_err(anyhow::Error::msg)?;
    let each = sent.bytes as f64 / sent.sent.max(1) as f64;
    let rate = sent.acknowledged as f64 / sent.seconds;
    Ok(print(&format!(
        "{} messages, {} acknowledged by the broker, {:.1} s, {rate:.0} a second, {each:.0} bytes each\n",
        sent.sent, sent.acknowledged, sent.seconds
    ))?)
}
