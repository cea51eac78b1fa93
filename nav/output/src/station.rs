//! All ports together: when something is due, and the epoch of each port's monitoring point.

use insd_base::{
    AlignmentStatus, Body, Heave, Mode, Motion, Ned, SolutionSource, Span, StorageFaults, Time,
    UtcTime,
};
use insd_n2k::pgn::TimeSource;
use insd_wire::nmea::{Acn, AlertCommand, Hbt};

use crate::alerts::{AlertBoard, AlertConfig, Watch};
use crate::docking::{BerthDesk, DockingConfig, HullPart};
use crate::epoch::{Contradicted, Distance, Doubts, OutputEpoch, SatelliteGeometry, Variation};
use crate::policy::Policy;
use crate::port::{OutputPortConfig, Port, PortMessage};
use crate::schedule::{Boundary, Due, Pacer, Rate, WakeUp};

/// Longest time over which a motion is carried on. After it nothing is known: the IMU is silent.
const CARRIED: Span = Span::from_nanos(200_000_000);
/// What receivers and compass say is carried on for longer, as they speak once a second.
const RELAYED: Span = Span::from_nanos(1_500_000_000);

/// Distance, damping and the like are kept up at least so often, and alerts just so often, Hz.
const UPKEEP: f64 = 10.0;

/// Speed below which a ship covers no ground but sways, m/s.
const UNDER_WAY: f64 = 0.1;

/// The newest there is to know, each with its own time.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Situation {
    /// How the IMU moves.
    pub motion: Option<Motion>,
    /// Heave of each monitoring point.
    pub heaves: Vec<Option<Heave>>,
    /// What UTC is known from.
    pub time_source: Option<TimeSource>,
    /// Magnetic variation at the ship.
    pub variation: Option<Variation>,
    /// What the receiver in use says of its fix.
    pub receiver: Option<SatelliteGeometry>,
    /// How the alignment stands.
    pub alignment: Option<AlignmentStatus>,
    /// Whether two engines are apart by more than they claim.
    pub engines_differ: bool,
    /// What of the installation is found to be otherwise than configured.
    pub doubts: Doubts,
    /// Which references that are watched are contradicted.
    pub contradicted: Contradicted,
    /// What cannot be written on the disk.
    pub storage: StorageFaults,
}

/// All ports of a ship.
#[derive(Clone, Debug)]
pub struct OutputStation {
    ports: Vec<Port>,
    points: Vec<Body>,
    groups: Option<Rate>,
    pacer: Pacer,
    odometer: Odometer,
    standing: Standing,
    watch: Watch,
    board: AlertBoard,
    berths: BerthDesk,
}

impl OutputStation {
    /// Ports, and the monitoring points as levers from the IMU, body axes, m; the first is the IMU itself. `groups` is the rate at
    /// which epochs are wanted for those of NMEA 2000.
    #[must_use]
    pub fn new(
        ports: impl IntoIterator<Item = OutputPortConfig>,
        points: Vec<Body>,
        groups: Option<Rate>,
    ) -> Self {
        let ports: Vec<Port> = ports.into_iter().map(Port::new).collect();
        let own = ports.iter().flat_map(Port::rates);
        let rates: Vec<Rate> = own.chain(groups).chain([Rate::from_hertz(UPKEEP)]).collect();
        OutputStation {
            ports,
            points,
            groups,
            pacer: Pacer::new(rates),
            odometer: Odometer::default(),
            standing: Standing::default(),
            watch: Watch::default(),
            board: AlertBoard::default(),
            berths: BerthDesk::default(),
        }
    }

    /// The same with another patience with warnings that nobody acknowledges.
    #[must_use]
    pub fn with_alerts(self, config: AlertConfig) -> Self {
        OutputStation { board: AlertBoard::new(config), ..self }
    }

    /// The same with berths to go alongside.
    #[must_use]
    pub fn with_berths(self, config: DockingConfig) -> Self {
        OutputStation { berths: BerthDesk::new(config), ..self }
    }

    /// The berths, and which of them is told of.
    #[must_use]
    pub fn berths(&self) -> &BerthDesk {
        &self.berths
    }

    /// Chooses a berth by its name, or again the nearest; whether there is such a berth.
    pub fn choose_berth(&mut self, name: Option<&str>) -> bool {
        self.berths.choose(name)
    }

    /// Its ports.
    #[must_use]
    pub fn ports(&self) -> &[Port] {
        &self.ports
    }

    /// Its alerts. Heading and position are judged by the policy of the first port that tells of alerts.
    #[must_use]
    pub fn alerts(&self) -> &AlertBoard {
        &self.board
    }

    /// Obeys a command of the bridge about an alert. What comes of it, an ALF or the refusal, leaves all
    /// ports that send ALF with their next one. Whether it could be obeyed.
    pub fn acknowledge(&mut self, command: &Acn, now: Time, utc: Option<UtcTime>) -> bool {
        self.board.handle(command, &Boundary { time: now, utc }).is_none()
    }

    /// Refuses a command about an alert of somebody who may not give any; the refusal leaves as above.
    pub fn refuse(&mut self, command: &Acn, now: Time, utc: Option<UtcTime>) {
        self.board.refuse(command, &Boundary { time: now, utc });
    }

    /// Obeys the operator at our own page about an alert; whether it could.
    pub fn obey(
        &mut self,
        identifier: u32,
        command: AlertCommand,
        now: Time,
        utc: Option<UtcTime>,
    ) -> bool {
        self.board.obey(identifier, command, &Boundary { time: now, utc })
    }

    /// Other ports of the same ship: alerts and the distance run go on from those of `before`.
    pub fn inherit(&mut self, before: &OutputStation) {
        self.odometer.clone_from(&before.odometer);
        self.standing.clone_from(&before.standing);
        self.watch = before.watch;
        self.board.clone_from(&before.board);
        self.berths.inherit(&before.berths);
    }

    /// Hears a heartbeat of the bridge; see [`AlertBoard::hear`].
    pub fn hear(&mut self, heartbeat: &Hbt, now: Time) {
        self.board.hear(heartbeat, now);
    }

    /// The next instant at which something is due, and what; `None` if nothing ever is.
    #[must_use]
    pub fn next(&self, now: Time, utc: Option<UtcTime>) -> Option<WakeUp> {
        let (at, rate) = self.pacer.next(now, utc)?;
        Some(WakeUp { at, why: rate.map_or(Due::Grid, |rate| self.due_at(rate)) })
    }

    fn due_at(&self, rate: Rate) -> Due {
        match self.ports.iter().position(|port| port.rates().any(|own| own == rate)) {
            Some(port) => Due::Messages(port),
            None if self.groups == Some(rate) => Due::Groups,
            None => Due::Upkeep,
        }
    }

    /// What has become due up to now; see [`Pacer::due`].
    pub fn due(&mut self, now: Time, utc: Option<UtcTime>) -> Vec<Boundary> {
        self.pacer.due(now, utc)
    }

    /// Boundaries that were skipped because nobody was awake.
    #[must_use]
    pub fn skipped(&self) -> u64 {
        self.pacer.skipped()
    }

    /// The messages that are due at a boundary, of each port that has any, with its index. Gives what is known
    /// of each monitoring point there, in their order.
    pub fn messages(
        &mut self,
        boundary: &Boundary,
        moment: &Situation,
        mut send: impl FnMut(usize, Vec<PortMessage>),
    ) -> Vec<OutputEpoch> {
        let motion = carried(boundary, moment);
        let points = self.points.iter().enumerate();
        let mut epochs: Vec<OutputEpoch> = points
            .map(|(index, lever)| {
                let motion = motion.map(|motion| motion.at_point(lever));
                epoch(boundary, moment, motion, index)
            })
            .collect();
        let is_upkeep = Rate::from_hertz(UPKEEP).is_on(boundary.grid());
        if let Some(motion) = motion.filter(|_| is_upkeep) {
            self.berths.note(&motion.solution.position);
        }
        let docking = self.berths.look(motion.as_ref(), boundary.time);
        let stern = self.stern(motion.as_ref());
        for epoch in &mut epochs {
            (epoch.docking, epoch.stern) = (docking, stern);
        }
        if let Some(imu) = epochs.first().copied() {
            self.odometer.note(&imu);
            self.standing.note(&imu);
            if is_upkeep {
                self.keep_watch(&imu, boundary);
            }
        }
        for epoch in &mut epochs {
            epoch.distance = self.odometer.distance;
            epoch.mode_since = self.standing.since;
            epoch.source_since = self.standing.source_since;
        }
        for (index, port) in self.ports.iter_mut().enumerate() {
            let Some(epoch) = epochs.get(port.config().point).or(epochs.first()) else { continue };
            let messages = port.messages_with(epoch, Some(&self.board));
            if !messages.is_empty() {
                send(index, messages);
            }
        }
        epochs
    }

    /// How the stern moves.
    fn stern(&self, motion: Option<&Motion>) -> Option<Ned> {
        let lever = self.berths.config().hull.as_ref()?.told(HullPart::Stern)?;
        Some(motion?.at_point(&lever).solution.velocity)
    }

    /// Raises and rectifies alerts.
    fn keep_watch(&mut self, epoch: &OutputEpoch, now: &Boundary) {
        let mut judges = self.ports.iter().filter(|port| port.tells_alerts());
        let policy = judges.next().map_or_else(Policy::default, |port| port.config().manner.policy);
        let simulated = self.ports.iter().any(|port| port.config().manner.simulated);
        let limits = self.berths.config().limits;
        for (condition, holds) in self.watch.note(epoch, &policy, &limits, simulated) {
            self.board.explain(condition, condition.detail(epoch), now);
            if holds {
                self.board.raise(condition, now);
            } else {
                self.board.rectify(condition, now);
            }
        }
        self.board.wait(now);
    }
}

/// Since when the system does what it does, or nothing, and lives by what it lives by.
#[derive(Clone, Debug, Default)]
struct Standing {
    mode: Option<Mode>,
    since: Option<Time>,
    source: Option<SolutionSource>,
    source_since: Option<Time>,
}

impl Standing {
    fn note(&mut self, epoch: &OutputEpoch) {
        let mode = epoch.solution.map(|solution| solution.mode);
        if self.since.is_none() || mode != self.mode {
            (self.mode, self.since) = (mode, Some(epoch.time));
        }
        let source = epoch.solution.and_then(|solution| solution.source);
        if source != self.source {
            (self.source, self.source_since) = (source, source.map(|_| epoch.time));
        }
    }
}

/// The newest motion at a boundary. It is carried on to it, but not for longer than 0.2 s: nothing is told with a new time
/// that is not new.
fn carried(boundary: &Boundary, moment: &Situation) -> Option<Motion> {
    let motion = moment.motion.filter(|motion| {
        let relayed = motion.solution.mode == Mode::Standby;
        let age = (boundary.time - motion.solution.time).as_nanos().abs();
        age <= if relayed { RELAYED } else { CARRIED }.as_nanos()
    });
    motion.map(|motion| motion.at(boundary.time))
}

/// What is known of a monitoring point at a boundary, which moves so.
fn epoch(
    boundary: &Boundary,
    moment: &Situation,
    motion: Option<Motion>,
    point: usize,
) -> OutputEpoch {
    let is_near = |time: Time| (boundary.time - time).as_nanos().abs() <= CARRIED.as_nanos();
    let heave = moment.heaves.get(point).copied().flatten();
    OutputEpoch {
        solution: motion.map(|motion| motion.solution),
        acceleration: motion.and_then(|motion| motion.acceleration),
        covariance_north_east: motion.and_then(|motion| motion.covariance_north_east()),
        current: motion.and_then(|motion| motion.current).map(|current| current.velocity),
        heave: heave.filter(|heave| is_near(heave.time)).map(|heave| heave.at(boundary.time)),
        utc: boundary.utc,
        time_source: moment.time_source,
        variation: moment.variation,
        receiver: moment.receiver,
        alignment: moment.alignment,
        engines_differ: moment.engines_differ,
        doubts: moment.doubts,
        contradicted: moment.contradicted,
        storage: moment.storage,
        ..OutputEpoch::unknown(boundary.time)
    }
}

/// Adds up the distance run since the start.
#[derive(Clone, Debug, Default)]
struct Odometer {
    distance: Distance,
    last: Option<Time>,
}

impl Odometer {
    fn note(&mut self, epoch: &OutputEpoch) {
        let passed = self.last.replace(epoch.time).map(|last| (epoch.time - last).as_seconds());
        let solution = epoch.solution.filter(|solution| solution.mode.is_navigating());
        let Some((solution, passed)) = solution.zip(passed.filter(|passed| *passed > 0.0)) else {
            return;
        };
        let over_ground = solution.velocity.0.xy();
        let through_water = epoch.current.map(|current| over_ground - current.0.xy());
        add(&mut self.distance.ground, over_ground.norm() * passed, passed);
        if let Some(velocity) = through_water {
            add(&mut self.distance.water, velocity.norm() * passed, passed);
        }
    }
}

fn add(distance: &mut Option<f64>, more: f64, passed: f64) {
    if more.is_finite() {
        let counts = more >= UNDER_WAY * passed;
        *distance.get_or_insert(0.0) += if counts { more } else { 0.0 };
    }
}
