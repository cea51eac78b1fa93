//! Pictures: of `insd evaluate --plot` track, errors within their claimed bands, innovations; of `insd integrity --plot`
//! the Stanford chart.

mod decimate;
mod panel;
mod stanford;
mod track;

use std::path::Path;

use anyhow::{Context, bail};
use insd_base::{Solution, Truth};
use kuva::render::figure::Figure;
use kuva::render::render::Scene;

use super::component::Component;
use super::errors::VoyageErrors;
use super::innovation::InnovationRow;
use super::statistics::quantile;
use panel::{Panel, TimeAxis};
pub use stanford::StanfordChart;

const CELL_WIDTH: f64 = 800.0;
const CELL_HEIGHT: f64 = 260.0;
/// Pixels for one unit of the figure.
const PNG_SCALE: f32 = 1.5;

/// What is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// Title above all panels.
    pub title: &'a str,
    /// Solutions.
    pub nav: &'a [Solution],
    /// Truth.
    pub truth: &'a [Truth],
    /// Their differences.
    pub errors: &'a VoyageErrors,
    /// Innovations; none for no panel.
    pub innovations: &'a [InnovationRow],
}

impl Picture<'_> {
    /// Draws to a `.png` or `.svg` file.
    ///
    /// # Errors
    /// Another ending, nothing to draw, or a file that cannot be written.
    pub fn draw(&self, file: &Path) -> anyhow::Result<()> {
        if self.errors.epochs.is_empty() {
            bail!("nothing to draw: solution and truth have no common time");
        }
        write(&self.scene(), file)
    }

    /// The track in the time of the errors.
    fn track(&self) -> Panel {
        let epochs = &self.errors.epochs;
        let span = epochs.first().map(|e| e.time)..=epochs.last().map(|e| e.time);
        let nav = self.nav.iter().filter(|row| span.contains(&Some(row.time)));
        let truth = self.truth.iter().filter(|row| span.contains(&Some(row.time)));
        let nav: Vec<_> = nav.map(|row| row.position).collect();
        let truth: Vec<_> = truth.map(|row| row.position).collect();
        track::panel(&nav, &truth)
    }

    /// The track on the left over two rows, the two errors that matter most beside it, the others
    /// below in pairs, innovations over the whole width.
    fn scene(&self) -> Scene {
        let axis = TimeAxis::covering(&self.errors.epochs);
        let mut panels = vec![self.track(), panel::horizontal(self.errors, axis)];
        let after_track = [
            Component::Heading,
            Component::North,
            Component::VelocityNorth,
            Component::East,
            Component::VelocityEast,
            Component::Down,
            Component::VelocityDown,
            Component::Roll,
            Component::Pitch,
        ];
        let errors = after_track.iter().filter_map(|c| panel::error(self.errors, *c, axis));
        panels.extend(errors);
        let mut structure = pairs_beside_track(panels.len());
        if let Some(panel) = panel::innovations(self.innovations, axis) {
            let first = next_cell(&structure);
            structure.push(vec![first, first + 1]);
            panels.push(panel);
        }
        let rows = next_cell(&structure) / 2;
        let (plots, layouts): (Vec<_>, Vec<_>) =
            panels.into_iter().map(|Panel { plots, layout }| (plots, layout)).unzip();
        Figure::new(rows, 2)
            .with_title(self.title)
            .with_title_size(22)
            .with_structure(structure)
            .with_plots(plots)
            .with_layouts(layouts)
            .with_cell_size(CELL_WIDTH, CELL_HEIGHT)
            .with_spacing(14.0)
            .render()
    }
}

/// Writes a scene to a `.png` or `.svg` file.
fn write(scene: &Scene, file: &Path) -> anyhow::Result<()> {
    let extension = file.extension().and_then(|e| e.to_str()).unwrap_or("");
    let bytes = match extension.to_ascii_lowercase().as_str() {
        "png" => kuva::backend::png::PngBackend::new()
            .with_scale(PNG_SCALE)
            .render_scene(scene)
            .map_err(|fault| anyhow::anyhow!("cannot draw: {fault}"))?,
        "svg" => kuva::backend::svg::SvgBackend.render_scene(scene).into_bytes(),
        _ => bail!("{}: expected a file ending in .png or .svg", file.display()),
    };
    std::fs::write(file, bytes).with_context(|| file.display().to_string())
}

/// Cells of a grid of two columns: panel 0 on the left of the first two rows, panels 1 and 2 on
/// their right, the others in pairs; a lone last one takes the whole width.
fn pairs_beside_track(count: usize) -> Vec<Vec<usize>> {
    let mut structure = vec![vec![0, 2], vec![1], vec![3]];
    if count == 2 {
        structure = vec![vec![0], vec![1]];
    }
    for cell in 4..count + 1 {
        structure.push(vec![cell]);
    }
    if count > 3 && count.is_multiple_of(2) {
        let last = structure.len() - 1;
        structure[last].push(count + 1);
    }
    structure
}

fn next_cell(structure: &[Vec<usize>]) -> usize {
    structure.iter().flatten().max().map_or(0, |cell| cell + 1)
}

#[cfg(test)]
mod tests {
    use super::super::errors::errors;
    use super::super::testing::{solution, truth};
    use super::*;
    use insd_base::Geodetic;

    #[test]
    fn panels_fill_the_grid_whatever_their_number() {
        for count in 2..14 {
            let mut cells = pairs_beside_track(count).concat();
            cells.sort_unstable();
            assert_eq!(cells, (0..cells.len()).collect::<Vec<_>>());
            assert_eq!(cells.len() % 2, 0);
            assert_eq!(pairs_beside_track(count).len(), count);
        }
    }

    #[test]
    fn pictures_are_drawn_with_and_without_attitude_and_innovations() {
        let dir = tempfile::tempdir().unwrap();
        let point = |t: i32| Geodetic::from_degrees(1.0 + f64::from(t) * 1e-4, 2.0, 3.0);
        let nav: Vec<_> = (0..50).map(|t| solution(f64::from(t), point(t))).collect();
        let mut rows: Vec<_> = (0..50).map(|t| truth(f64::from(t), point(t))).collect();
        let row = |t: i32| InnovationRow {
            t_s: f64::from(t),
            aid: "gnss_position".to_owned(),
            component: 0,
            innovation: 0.5,
            sigma: 1.0,
            accepted: t % 10 > 0,
        };
        let innovations: Vec<_> = (0..50).map(row).collect();
        for (name, shown) in [("a.png", &innovations[..]), ("b.svg", &[]), ("c.svg", &innovations)]
        {
            let found = errors(&nav, &rows, None);
            let picture = Picture {
                title: "test",
                nav: &nav,
                truth: &rows,
                errors: &found,
                innovations: shown,
            };
            picture.draw(&dir.path().join(name)).unwrap();
            assert!(picture.draw(&dir.path().join("a.gif")).is_err());
            rows.iter_mut().for_each(|row| row.attitude = None);
        }
    }
}
