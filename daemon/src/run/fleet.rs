//! Fleets that are told: from the configuration to couriers on threads of their own.

use std::path::Path;
use std::sync::Arc;

use insd_base::Span;
use insd_config::{Config, FleetSection, PayloadKind};
use insd_drivers::ports::read_password;
use insd_fleet::{BrokerPlan, FleetHandle, FleetPayload, FleetPlan, FleetStatus};
use insd_web::Viewer;

use crate::clock::HostClock;

/// Bytes of a megabyte of a quota.
const MEGABYTE: u64 = 1 << 20;

/// Those who tell the fleets. They end when this is dropped.
#[derive(Debug, Default)]
pub(super) struct Fleets(Vec<(String, FleetHandle)>);

impl Fleets {
    /// Starts one for each fleet. A ship sails without them, too: what is wrong is told.
    pub(super) fn start(config: &Config, viewer: Option<&Viewer>, clock: HostClock) -> Self {
        let Some(viewer) = viewer else { return Fleets::default() };
        let state = config.state.folder();
        let start = |section: &FleetSection| {
            let plan = plan(section, state.as_deref());
            let begun = plan.and_then(|plan| {
                let now = Arc::new(move || clock.now());
                insd_fleet::start(plan, viewer.clone(), now).map_err(|fault| fault.to_string())
            });
            let begun =
                begun.map_err(|fault| tracing::error!(fleet = section.name, fault, "not told"));
            Some((section.name.clone(), begun.ok()?))
        };
        Fleets(config.fleets.iter().filter_map(start).collect())
    }

    /// Whether what waits for one of them cannot be put away.
    pub(super) fn is_failing(&self) -> bool {
        self.0.iter().any(|(_, own)| own.status().disk_fault.is_some())
    }

    /// How each of them is told, by its name.
    pub(super) fn status(&self) -> Vec<(String, FleetStatus)> {
        self.0.iter().map(|(name, own)| (name.clone(), own.status())).collect()
    }
}

fn plan(section: &FleetSection, state: Option<&Path>) -> Result<FleetPlan, String> {
    let folder =
        section.spool(state).ok_or("no folder for what waits: `folder` of [[fleet]] or [state]")?;
    let client = || format!("insd-{}", section.ship);
    let some = |seconds: f64| (seconds > 0.0).then(|| Span::from_seconds(seconds));
    Ok(FleetPlan {
        name: section.name.clone(),
        broker: BrokerPlan {
            host: section.host.clone(),
            port: section.port(),
            client: section.client_id.clone().unwrap_or_else(client),
            login: login(section.user.as_deref(), section.password_file.as_deref())?,
            tls: section.tls.then(|| section.tls_ca_file.clone()),
        },
        prefix: section.topic.clone(),
        ship: section.ship.clone(),
        ship_name: section.ship_name.clone(),
        folder,
        quota: section.quota_mb.saturating_mul(MEGABYTE),
        budget: section.budget_bytes_h,
        state: some(section.state_s),
        history: some(section.history_s),
        gather: Span::from_seconds(section.gather_s),
        alerts: section.alerts,
        payload: match section.payload {
            PayloadKind::Json => FleetPayload::Json,
            PayloadKind::SignalK => FleetPayload::SignalK,
            PayloadKind::Iso19848 => FleetPayload::Iso19848,
        },
        compress: section.compress,
        expiry: some(section.expiry_s),
    })
}

/// User and password for a broker.
///
/// # Errors
/// The file of the password cannot be read, others can read it, or there is none in it.
pub(crate) fn login(
    user: Option<&str>,
    file: Option<&Path>,
) -> Result<Option<(String, String)>, String> {
    let Some(user) = user else { return Ok(None) };
    let read =
        |file: &Path| read_password(file).map_err(|fault| format!("{}: {fault}", file.display()));
    Ok(Some((user.to_owned(), file.map_or(Ok(String::new()), read)?)))
}
