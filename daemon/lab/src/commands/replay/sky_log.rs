//! The sky of each epoch, written once its satellites have been judged.

use std::path::Path;

use insd_base::Time;
use insd_base::satellites::Sky;
use insd_config::OutputFile;
use insd_engine::Engine;

use crate::evaluation::{RowWriter, SkyRow};

/// A file of skies.
pub(super) struct SkyLog {
    file: RowWriter<SkyRow, OutputFile>,
    /// The newest epoch, and whether its satellites have been judged.
    newest: Option<(Sky, bool)>,
}

impl SkyLog {
    pub(super) fn create(path: &Path) -> anyhow::Result<Self> {
        Ok(SkyLog { file: RowWriter::new(OutputFile::create(path)?), newest: None })
    }

    /// Looks at the sky after each message. An epoch that is ahead of the IMU is judged when the solution has come to its time, and looked at again.
    pub(super) fn look(&mut self, engine: &Engine, solved: Option<Time>) -> std::io::Result<()> {
        let Some(time) = engine.sky_time() else { return Ok(()) };
        let is_judged = solved.is_some_and(|solved| solved >= time);
        match &self.newest {
            Some((sky, false)) if sky.time == time && !is_judged => return Ok(()),
            Some((sky, true)) if sky.time == time => return Ok(()),
            Some((sky, _)) if sky.time != time => self.write()?,
            _ => {}
        }
        self.newest = engine.sky().map(|sky| (sky, is_judged));
        Ok(())
    }

    fn write(&mut self) -> std::io::Result<()> {
        let Some((sky, _)) = self.newest.take() else { return Ok(()) };
        SkyRow::all(&sky).try_for_each(|row| self.file.write(&row))
    }

    /// Writes the last epoch, and moves the file to its place.
    pub(super) fn finish(mut self) -> anyhow::Result<()> {
        self.write()?;
        self.file.finish()?.finish()
    }
}
