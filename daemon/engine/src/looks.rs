//! What those who look on are told of the engine, whenever they ask.

use insd_alignment::StoredState;
use insd_base::{
    Body, Disturbance, Estimates, Heave, Integrity, Judgement, Mode, Motion, Parties, Solution,
    Standing, Stands, Time,
};
use insd_nav::filter::state_estimates::StateEstimate;
use insd_nav::judge::Judge;
use insd_nav::{Estimator, Filter, Increment, Navigator};

use crate::ship::Ship;
use crate::{Engine, Stage, checks};

impl Engine {
    /// What the engine is doing.
    #[must_use]
    pub fn mode(&self) -> Mode {
        self.machine.mode()
    }

    /// How the ship moves at the last IMU sample, for outputs between the epochs of the solutions; `None`
    /// while nothing is known that could be shown to anyone. Without data of the IMU it is what receivers and
    /// compass say, in [`Mode::Standby`].
    #[must_use]
    pub fn motion(&self) -> Option<Motion> {
        if self.machine.mode() == Mode::Standby && !self.is_waiting() {
            let motion = self.config.relay.then(|| self.relay.motion(self.reach())).flatten()?;
            return Some(Motion { solution: self.judged(motion.solution), ..motion });
        }
        let ship = self.ship()?;
        let solution = Some(self.judged(ship.solution())).filter(checks::is_sound)?;
        let filter = ship.likeliest().map(Navigator::filter);
        let acceleration = filter.zip(self.last.as_ref());
        Some(Motion {
            solution,
            acceleration: acceleration.map(|(filter, last)| filter.acceleration(last)),
            covariance: filter.map(Filter::motion_covariance),
            current: filter.and_then(Filter::current),
        })
    }

    /// Heave of each monitoring point at the last IMU sample.
    #[must_use]
    pub fn heaves(&self) -> Vec<Option<Heave>> {
        (0..self.config.points.len()).map(|point| self.heave.as_ref()?.heave(point)).collect()
    }

    /// The state to store for the next start: `None` unless the ship is aligned and still lies at her
    /// berth, as one that sails will lie otherwise when she is back.
    #[must_use]
    pub fn stored_state(&self) -> Option<StoredState> {
        self.ship()?.stored_state(&self.config.imu)
    }

    /// The errors of the sensors as the filter has them; `None` until there is one. Some 100 ns.
    #[must_use]
    pub fn estimates(&self) -> Option<Estimates> {
        let ship = self.ship()?;
        let estimates = ship.likeliest()?.filter().estimates(ship.is_moored());
        Some(Estimates { course_less_heading: self.surveyor.course_less_heading(), ..estimates })
    }

    /// Every error state that the filter carries, with its name, unit, axes, value and sigma; none until there is one.
    #[must_use]
    pub fn carried_states(&self) -> Vec<StateEstimate> {
        let navigator = self.ship().and_then(Ship::likeliest);
        navigator.map(|navigator| navigator.filter().carried_states()).unwrap_or_default()
    }

    /// The sea as a model of the velocity that it gives the ship; `None` until half a minute of it has
    /// been seen with a single heading. Fitted anew at every call, for half a millisecond of one core: to be
    /// asked for at most once a second. It changes nothing of the engine.
    #[must_use]
    pub fn disturbance(&self) -> Option<Disturbance> {
        let navigator = self.ship().filter(|ship| ship.has_one_heading())?.likeliest()?;
        self.trace.disturbance(navigator)
    }

    /// Who is left out, or doubted and cannot be left out, as it is known now.
    #[must_use]
    pub fn excluded(&self) -> Parties {
        let judged = self.judge().map(|judge| judge.judgement().excluded).unwrap_or_default();
        judged.and(self.receivers.named(self.surveyor.excluded()))
    }

    /// Whether sensors contradict each other, and it is not known who is wrong.
    #[must_use]
    pub fn is_in_doubt(&self) -> bool {
        let integrity = self.judge().map(|judge| judge.judgement().integrity);
        integrity == Some(Integrity::Contradiction)
    }

    /// How all stand with whom the ship is navigated by; where nobody compares them, those who are not trusted.
    pub fn standings(&self) -> impl Iterator<Item = Stands> {
        let is_compared = self.judge().is_some();
        let docket = self.ship().and_then(Ship::docket);
        let all = docket.map(|docket| docket.all().collect::<Vec<_>>()).unwrap_or_default();
        all.into_iter().filter(move |it| is_compared || it.standing != Standing::Trusted)
    }

    /// A solution with all that is found of the sensors, and levels of the risk that is asked for.
    pub(crate) fn judged(&self, solution: Solution) -> Solution {
        let Judgement { integrity, excluded } = solution.judgement;
        let excluded = excluded.and(self.receivers.named(self.surveyor.excluded()));
        let judged = Solution { judgement: Judgement { integrity, excluded }, ..solution };
        let claimed = self.surveyor.claim(judged, self.reach());
        let more = self.config.models.risk.beyond_usual(&claimed.sigma);
        Solution { hidden: claimed.hidden.plus(&more), ..claimed }
    }

    /// How far the antenna may be from the IMU, m.
    fn reach(&self) -> f64 {
        self.nav.gnss_lever().norm() + self.nav.gnss_lever_std()
    }

    /// The judge of the navigator, if there is one.
    #[must_use]
    pub fn judge(&self) -> Option<&Judge> {
        self.ship()?.likeliest()?.filter().judge()
    }

    /// How much likelier what the others say since an instant is if the gyros turn so much too fast since then, rad/s,
    /// body axes, as a logarithm, the natural one; `None` before she navigates.
    ///
    /// To be asked again and again from that instant on: what is said is weighed for it from the first time on.
    pub fn odds_of_gyros(&mut self, since: Time, excess: &Body) -> Option<f64> {
        let Stage::Running(line) = &mut self.stage else { return None };
        line.estimator_mut().odds_of_gyros(since, excess)
    }

    /// The ship on her time line, if the IMU has been heard since the engine was made.
    pub(crate) fn ship(&self) -> Option<&Ship> {
        match &self.stage {
            Stage::Running(line) if !self.is_waiting() => Some(line.estimator()),
            _ => None,
        }
    }

    /// Looks at the ship that has just moved over an increment: for heave, the sea and the trial.
    pub(crate) fn watch(&mut self, increment: &Increment) {
        let Stage::Running(line) = &self.stage else { return };
        let ship = line.estimator();
        let Some(navigator) = ship.likeliest() else { return };
        if let Some(heave) = &mut self.heave {
            heave.advance(&navigator.filter().vertical_step(increment));
        }
        if ship.has_one_heading() {
            self.trace.watch(navigator);
        }
        if let Some(resumption) = &mut self.resumption {
            let sigma = navigator.solution().sigma;
            resumption.feel(navigator.filter(), increment, sigma.roll.hypot(sigma.pitch));
        }
    }
}
