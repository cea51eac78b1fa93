//! What people call ports and sensors.

use insd_base::PortId;
use insd_intake::config::IntakeConfig;

/// Names of ports and sensors, by their places in the configuration.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// Of the ports.
    pub ports: Vec<String>,
    /// Of the sensors.
    pub sensors: Vec<String>,
}

impl Names {
    /// Those of what is plugged in.
    #[must_use]
    pub fn of(config: &IntakeConfig) -> Self {
        Names {
            ports: config.ports.iter().map(|port| port.name.clone()).collect(),
            sensors: config.sensors.iter().map(|sensor| sensor.name.clone()).collect(),
        }
    }

    /// That of a port.
    #[must_use]
    pub fn port(&self, port: PortId) -> &str {
        self.ports.get(usize::from(port.0)).map_or("?", String::as_str)
    }

    /// That of a sensor.
    #[must_use]
    pub fn sensor(&self, sensor: usize) -> &str {
        self.sensors.get(sensor).map_or("?", String::as_str)
    }
}
