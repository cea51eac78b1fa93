//! Whether samples of the IMU are missing or its clock has stepped: a twin sails on by the second.

use insd_base::{Event, Received};

use crate::Engine;
use crate::twin::{Ending, Twin};

impl Engine {
    /// Lets a twin begin where samples may be missing, or not.
    pub(crate) fn bear_twin(&mut self, received: &Received, step: f64) {
        if self.twin.is_some() {
            return;
        }
        let mut engine = self.clone();
        engine.stamps.take_back(step);
        self.twin = Some(Twin::new(engine, received.message.time(), step));
    }

    /// The twin hears the same; `before` outputs were there before this engine heard it.
    pub(crate) fn hear_with_twin(&mut self, received: &Received, before: usize) {
        let Some(mut twin) = self.twin.take() else { return };
        twin.engine.handle_alone(received);
        let told = std::mem::take(&mut twin.engine.outputs);
        twin.compare(self.outputs.iter().skip(before), told.iter());
        match twin.ending(received.message.time()) {
            None => self.twin = Some(twin),
            Some(Ending::Wrong) => {}
            Some(Ending::Right) => self.become_twin(twin),
        }
    }

    fn become_twin(&mut self, twin: Twin<Self>) {
        let (outputs, next) = (std::mem::take(&mut self.outputs), self.next_epoch);
        *self = *twin.engine;
        self.outputs = outputs;
        // what was told is not told again
        self.next_epoch = next;
        self.tell(Event::ImuClock { time: twin.since, step: twin.step });
    }
}
