//! Addresses: two that want the same one, ports that are not ours, words that hear themselves.

use std::net::SocketAddr;

use insd_drivers::ports::{Destination, Transport};

use super::found::Found;
use crate::Config;
use crate::check::finding::ConfigPlace;
use crate::check::uses::{self, Listener};

/// Ports below this are for root.
const PRIVILEGED: u16 = 1024;

pub(super) fn look(config: &Config, found: &mut Found) {
    let listeners = uses::listeners(config);
    for (index, own) in listeners.iter().enumerate() {
        let earlier = listeners.iter().take(index).find(|other| own.collides(other));
        if let Some(other) = earlier {
            let section = ConfigPlace { key: None, ..other.place.clone() };
            let text = format!("{} is the address of {section}, too", own.address);
            found.error("address-twice", own.place.clone(), &text, "each needs a port of its own");
        }
        if (1..PRIVILEGED).contains(&own.address.port()) {
            found.error(
                "port-privileged",
                own.place.clone(),
                &format!("port {} is for root, and the service is not", own.address.port()),
                &format!("a port from {PRIVILEGED}"),
            );
        }
    }
    callers(config, &listeners, found);
    echoes(config, &listeners, found);
    hosts(config, found);
    open_page(config, found);
    commanders(config, found);
}

/// Servers that are called: do they have a port, and are they ourselves?
fn callers(config: &Config, listeners: &[Listener], found: &mut Found) {
    for (place, transport) in uses::inputs(config) {
        let (Transport::TcpClient(insd_drivers::ports::TcpClient { address, .. })
        | Transport::GatewayTcp(insd_drivers::can::GatewayTcp { address, .. })) = transport
        else {
            continue;
        };
        let place = place.key("transport.address");
        let number = address.rsplit_once(':').and_then(|(_, port)| port.parse::<u16>().ok());
        let Some(number) = number else {
            found.error(
                "address-port",
                place,
                &format!("\"{address}\" has no port"),
                &format!("\"{address}:10110\", or whatever the server says"),
            );
            continue;
        };
        let local = address.parse::<SocketAddr>().is_ok_and(|own| own.ip().is_loopback())
            || address.starts_with("localhost:");
        let own = listeners.iter().find(|own| own.tcp && own.address.port() == number);
        if let Some(own) = own.filter(|_| local) {
            let section = ConfigPlace { key: None, ..own.place.clone() };
            let text = format!("{address} is served by {section}: insd would call itself");
            found.error("calls-itself", place, &text, "");
        }
    }
}

/// Datagrams that come back: an output to where an input listens.
fn echoes(config: &Config, listeners: &[Listener], found: &mut Found) {
    for (place, destination) in uses::destinations(config) {
        let Destination::Udp(own) = destination else { continue };
        let hears = |other: &&Listener| {
            let group = other.group.is_some_and(|group| group == own.to.ip());
            let local = own.to.ip().is_loopback() && other.group.is_none();
            !other.tcp && other.address.port() == own.to.port() && (group && own.loopback || local)
        };
        if let Some(other) = listeners.iter().find(hears) {
            let section = ConfigPlace { key: None, ..other.place.clone() };
            found.warn(
                "hears-itself",
                place.key("destination.to"),
                &format!("what goes to {} comes back at {section}", own.to),
                "loopback = false for a group, or another port",
            );
        }
    }
}

/// Names under which the page is asked for are names alone.
fn hosts(config: &Config, found: &mut Found) {
    for host in &config.web.hosts {
        let bare = host.split("://").last().unwrap_or(host);
        let bare = bare.split(['/', ':']).next().unwrap_or(bare);
        if bare != host && !bare.is_empty() && host.parse::<std::net::Ipv6Addr>().is_err() {
            let text = format!("\"{host}\" is no bare name");
            found.warn(
                "host-form",
                ConfigPlace::one("web").key("hosts"),
                &text,
                &format!("\"{bare}\""),
            );
        }
    }
}

/// A page that the network may see, and where nobody can acknowledge an alert.
fn open_page(config: &Config, found: &mut Found) {
    let web = &config.web;
    if web.enabled && !web.listen.ip().is_loopback() && web.token_file.is_none() {
        let text = "no token: nobody can acknowledge an alert on the page";
        let advice = "token_file = \"/etc/insd/token\", if that is wanted";
        found.note("token-none", ConfigPlace::one("web").key("token_file"), text, advice);
    }
}

/// Ports that are listened to for commands, and nobody is listed whose commands are obeyed; and the other
/// way round.
fn commanders(config: &Config, found: &mut Found) {
    for port in config.ports.iter().filter(|port| port.transport.is_network()) {
        let place = || ConfigPlace::of("port", &port.name).key("commands_from");
        let has_node = config.nodes.iter().any(|node| node.port == port.name);
        let listed = port.commands_from.as_ref().is_some_and(|hosts| !hosts.is_empty());
        if port.alerts && !listed {
            let text = "nobody is listed: commands about alerts that come from here are refused";
            found.warn("commands-nobody", place(), text, "commands_from = [\"192.168.1.20\"]");
        } else if listed && !port.alerts && !has_node {
            let text = "it is not listened to for commands about alerts, and has no node";
            found.warn("commands-unheard", place(), text, "alerts = true, if that is wanted");
        } else if listed && has_node && !port.obeys_bus() {
            let text = "others can send there, too: the node obeys nobody";
            let advice = "the gateway's own address in transport, as an address and not as a name";
            found.warn("commands-gateway", place(), text, advice);
        }
    }
}
