//! `insd fleet sink`: from the broker to a database, and to a page.

use std::net::SocketAddr;

use insd_config::calendar;
use insd_fleet::sink::board::FleetBoard;
use insd_fleet::sink::{self, SinkPlan, SinkTarget};
use insd_web::{FleetBoardText, Listen, WebConfig};

use super::broker::BrokerArgs;
use crate::clock::HostClock;

/// Options of `insd fleet sink`.
#[derive(Clone, Debug, clap::Args)]
pub struct SinkArgs {
    #[command(flatten)]
    broker: BrokerArgs,
    /// Name of the client, for which the broker keeps what comes while the sink is away
    #[arg(long, value_name = "NAME", default_value = "insd-sink")]
    client_id: String,
    /// Write to a database of PostgreSQL: its name, a connection string or a URI, as psql takes it
    #[arg(long, value_name = "DATABASE", conflicts_with = "lines")]
    postgres: Option<String>,
    /// Write line protocol of InfluxDB to standard output
    #[arg(long)]
    lines: bool,
    /// Show all ships on a page at this address
    #[arg(long, value_name = "ADDRESS")]
    page: Option<SocketAddr>,
    /// Names by which browsers reach that page, beside localhost and addresses
    #[arg(long, value_name = "NAME")]
    host: Vec<String>,
}

/// Runs the command for ever.
pub(super) fn run(args: &SinkArgs) -> anyhow::Result<()> {
    let board = FleetBoard::default();
    let _page = args.page.map(|address| show(address, &args.host, &board)).transpose()?;
    let target = match &args.postgres {
        Some(database) => SinkTarget::Postgres(database.clone()),
        None if args.lines => SinkTarget::Lines,
        None => SinkTarget::Nowhere,
    };
    let broker = args.broker.plan(&args.client_id)?;
    let plan = SinkPlan { broker, prefix: args.broker.topic.clone(), target };
    let runtime =
        tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build()?;
    Ok(runtime.block_on(sink::run(plan, board))?)
}

fn show(
    address: SocketAddr,
    hosts: &[String],
    board: &FleetBoard,
) -> anyhow::Result<insd_web::WebHandle> {
    let (board, clock) = (board.clone(), HostClock::start());
    let tell = move || board.json(&calendar::rfc3339_millis(clock.now().system));
    let config = WebConfig {
        listen: Listen::Address(address),
        allowed_hosts: hosts.to_vec(),
        ..WebConfig::default()
    };
    let handle = insd_web::start_fleet(config, FleetBoardText::new(tell))?;
    tracing::info!(address = %handle.address(), "page of the fleet");
    Ok(handle)
}
