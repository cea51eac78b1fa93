//! Pictures: of `insd evaluate --plot` track, errors within their claimed bands, innovations, satellites; of `insd integrity
//! --plot` the Stanford chart.

mod decimate;
mod panel;
mod satellites;
mod stanford;
mod track;

use std::path::Path;

use anyhow::{Context, bail};
use insd_base::{Solution, Truth};
use insd_drivers::recording::NavRow;
use kuva::render::figure::Figure;
use kuva::render::render::Scene;

use super::by_satellites::{WithSatellites, by_satellites};
use super::component::Component;
use super::errors::VoyageErrors;
use super::innovation::InnovationRow;
use super::sky::SkyRow;
use super::statistics::quantile;
use panel::{Panel, TimeAxis};
pub use stanford::StanfordChart;

const CELL_WIDTH: f64 = 800.0;
const CELL_HEIGHT: f64 = 260.0;
/// Rows of cells for the sky, and for the lanes of satellites.
const SKY_ROWS: usize = 2;
const LANE_ROWS: usize = 3;
/// Pixels for one unit of the figure.
const PNG_SCALE: f32 = 1.5;

/// What is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// Title above all panels.
    pub title: &'a str,
    /// Solutions, and how many satellites they rest on.
    pub nav: &'a [NavRow],
    /// Truth.
    pub truth: &'a [Truth],
    /// Their differences.
    pub errors: &'a VoyageErrors,
    /// Innovations; none for no panel.
    pub innovations: &'a [InnovationRow],
    /// The sky; none for no panel.
    pub sky: &'a [SkyRow],
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
        let nav = self.nav.iter().map(|row| &row.solution);
        let nav = nav.filter(|row: &&Solution| span.contains(&Some(row.time)));
        let truth = self.truth.iter().filter(|row| span.contains(&Some(row.time)));
        let nav: Vec<_> = nav.map(|row| row.position).collect();
        let truth: Vec<_> = truth.map(|row| row.position).collect();
        track::panel(&nav, &truth)
    }

    /// Sky and number of satellites beside each other, what each told below; nothing where there are none.
    fn push_satellites(
        &self,
        structure: &mut Vec<Vec<usize>>,
        panels: &mut Vec<Panel>,
        axis: TimeAxis,
    ) {
        let epochs = by_satellites(self.nav, self.errors);
        let figures = WithSatellites::all(self.nav, self.errors);
        let sky = satellites::sky(self.sky, axis);
        let by_number = satellites::by_number(&epochs, &figures);
        match (sky, by_number) {
            (Some(sky), Some(by_number)) => {
                let first = next_cell(structure);
                structure.extend([cells(first, SKY_ROWS, &[0]), cells(first, SKY_ROWS, &[1])]);
                panels.extend([sky, by_number]);
            }
            (sky, by_number) => {
                for panel in [sky, by_number].into_iter().flatten() {
                    push(structure, SKY_ROWS, &[0, 1]);
                    panels.push(panel);
                }
            }
        }
        if let Some(panel) = satellites::residuals(self.innovations, axis) {
            push(structure, LANE_ROWS, &[0, 1]);
            panels.push(panel);
        }
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
            push(&mut structure, 1, &[0, 1]);
            panels.push(panel);
        }
        self.push_satellites(&mut structure, &mut panels, axis);
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

/// Adds a panel of so many rows below all others, in these columns.
fn push(structure: &mut Vec<Vec<usize>>, rows: usize, columns: &[usize]) {
    let first = next_cell(structure);
    structure.push(cells(first, rows, columns));
}

fn cells(first: usize, rows: usize, columns: &[usize]) -> Vec<usize> {
    (0..rows).flat_map(|row| columns.iter().map(move |column| first + 2 * row + column)).collect()
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

    /// A ship that goes north, with so many satellites, or with fixes alone.
    fn sailed(satellites: Option<u32>) -> (Vec<NavRow>, Vec<Truth>) {
        let point = |t: i32| Geodetic::from_degrees(1.0 + f64::from(t) * 1e-4, 2.0, 3.0);
        let row = |t: i32| NavRow {
            solution: solution(f64::from(t), point(t)),
            horizontal_level: None,
            vertical_level: None,
            integrity: None,
            excluded: Vec::new(),
            satellites,
        };
        ((0..50).map(row).collect(), (0..50).map(|t| truth(f64::from(t), point(t))).collect())
    }

    fn innovation(t: i32, aid: &str, component: &str) -> InnovationRow {
        InnovationRow {
            t_s: f64::from(t),
            aid: aid.to_owned(),
            component: component.to_owned(),
            innovation: 0.5,
            sigma: 1.0,
            accepted: t % 10 > 0,
        }
    }

    fn seen(t: i32) -> SkyRow {
        SkyRow {
            t_s: f64::from(t),
            satellite: "G07".to_owned(),
            azimuth_deg: Some(f64::from(t)),
            elevation_deg: Some(30.0),
            cn0_dbhz: None,
            state: "used".to_owned(),
            reason: None,
        }
    }

    #[test]
    fn pictures_are_drawn_with_and_without_attitude_and_innovations() {
        let dir = tempfile::tempdir().unwrap();
        let (nav, mut rows) = sailed(None);
        let solutions: Vec<_> = nav.iter().map(|row| row.solution).collect();
        let innovations: Vec<_> = (0..50).map(|t| innovation(t, "gnss_position", "0")).collect();
        for (name, shown) in [("a.png", &innovations[..]), ("b.svg", &[]), ("c.svg", &innovations)]
        {
            let found = errors(&solutions, &rows, None);
            let picture = Picture {
                title: "test",
                nav: &nav,
                truth: &rows,
                errors: &found,
                innovations: shown,
                sky: &[],
            };
            picture.draw(&dir.path().join(name)).unwrap();
            assert!(picture.draw(&dir.path().join("a.gif")).is_err());
            rows.iter_mut().for_each(|row| row.attitude = None);
        }
    }

    #[test]
    fn satellites_are_drawn_where_there_are_any_and_the_picture_is_as_it_was_where_not() {
        let dir = tempfile::tempdir().unwrap();
        let sky: Vec<_> = (0..50).map(seen).collect();
        let told: Vec<_> = (0..50).map(|t| innovation(t, "satellite_code", "G07")).collect();
        let drawn = |satellites, innovations: &[InnovationRow], sky: &[SkyRow]| {
            let (nav, truth) = sailed(satellites);
            let solutions: Vec<_> = nav.iter().map(|row| row.solution).collect();
            let found = errors(&solutions, &truth, None);
            let picture = Picture {
                title: "test",
                nav: &nav,
                truth: &truth,
                errors: &found,
                innovations,
                sky,
            };
            picture.draw(&dir.path().join("a.svg")).unwrap();
            std::fs::read_to_string(dir.path().join("a.svg")).unwrap()
        };
        let titles = ["satellites in use", "sky: tracks", "innovations of satellites"];
        let all = drawn(Some(7), &told, &sky);
        assert!(titles.iter().all(|title| all.contains(title)), "{all}");
        for (at, one) in [drawn(Some(7), &[], &[]), drawn(None, &[], &sky), drawn(None, &told, &[])]
            .iter()
            .enumerate()
        {
            let there: Vec<_> = titles.iter().map(|title| one.contains(title)).collect();
            assert_eq!(there, [at == 0, at == 1, at == 2]);
        }
        let none = drawn(None, &[], &[]);
        assert!(!titles.iter().any(|title| none.contains(title)), "{none}");
    }
}
