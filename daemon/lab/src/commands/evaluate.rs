//! `insd evaluate`: a solution against truth.

use std::path::PathBuf;

use insd_base::{Solution, Time, Truth};
use insd_config::BadInput;
use insd_drivers::recording::{NavRow, Rows, read_nav_rows, read_truth_rows};

use crate::evaluation::plot::Picture;
use crate::evaluation::{
    ErrorReport, Evidence, VoyageErrors, WithSatellites, drifts, errors, outages, read_rows,
};

/// Options of `insd evaluate`.
///
/// Errors are solution minus truth. NEES is the mean of (error / claimed sigma)^2, 1 when the
/// claims are honest; honest claims hold 68.3, 95.4 and 99.7 % of errors within 1, 2 and 3 sigma.
///
/// Evidence is what the solution said of how far it may be relied on. A position is usable at an alert
/// limit while its protection level (hpl_m, or five horizontal sigmas) is within it and neither mode nor
/// integrity says otherwise; a heading while it claims less than 2 deg. It misleads while it is usable and
/// off by more than the limit, a heading by more than 3 deg and three sigmas. More than 10 s of that in a
/// piece, or 60 s in all, is hazardous.
#[derive(Clone, Debug, clap::Args)]
pub struct EvaluateArgs {
    /// Solution to score
    #[arg(value_name = "NAV.csv")]
    nav: PathBuf,
    /// Truth, plain or compressed
    #[arg(value_name = "TRUTH.csv")]
    truth: PathBuf,
    /// Leave out what is before this time, s
    #[arg(long, value_name = "T", value_parser = super::seconds)]
    from: Option<f64>,
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
    /// Draw track, errors with claimed 3-sigma bands, innovations, and of satellites sky, innovations and what their number does
    #[arg(long, value_name = "FILE.png|.svg", value_parser = super::picture)]
    plot: Option<PathBuf>,
    /// Innovations written by `insd replay --innovations`, for the plot
    #[arg(long, value_name = "FILE.csv", requires = "plot")]
    innovations: Option<PathBuf>,
    /// Sky written by `insd replay --sky`, for the plot
    #[arg(long, value_name = "FILE.csv", requires = "plot")]
    sky: Option<PathBuf>,
}

/// Runs the command.
///
/// # Errors
/// A file cannot be read, or the two have no common time.
pub fn run(args: &EvaluateArgs) -> anyhow::Result<()> {
    let nav = read_nav_rows(&args.nav)?;
    let truth = read_truth_rows(&args.truth)?;
    let names = [&args.nav, &args.truth].map(|file| file.display().to_string());
    let (report, found) = score(names, &nav, &truth, args.from.map(Time::from_seconds))?;
    if args.json {
        crate::terminal::print(&(serde_json::to_string_pretty(&report)? + "\n"))?;
    } else {
        crate::terminal::print(&report.to_string())?;
    }
    let Some(file) = &args.plot else { return Ok(()) };
    let innovations = args.innovations.as_deref().map(read_rows).transpose()?;
    let sky = args.sky.as_deref().map(read_rows).transpose()?;
    let name = args.nav.file_name().unwrap_or(args.nav.as_os_str()).to_string_lossy();
    Picture {
        title: &format!("{name}: errors with claimed ±3σ bands"),
        nav: &nav.rows,
        truth: &truth.rows,
        errors: &found,
        innovations: innovations.as_deref().unwrap_or_default(),
        sky: sky.as_deref().unwrap_or_default(),
    }
    .draw(file)
}

/// The report of a solution against truth from a time on, and the errors that it is made of; `names` of both are told in it.
///
/// # Errors
/// The two have no common time.
pub fn score(
    names: [String; 2],
    nav: &Rows<NavRow>,
    truth: &Rows<Truth>,
    from: Option<Time>,
) -> Result<(ErrorReport, VoyageErrors), BadInput> {
    let solutions: Vec<Solution> = nav.rows.iter().map(|row| row.solution).collect();
    let found = errors(&solutions, &truth.rows, from);
    let [nav_name, truth_name] = names;
    if found.epochs.is_empty() {
        return Err(BadInput(format!(
            "{nav_name} and {truth_name} have no common time to compare"
        )));
    }
    let drifts = drifts(&outages(&solutions), &found.epochs);
    let report = ErrorReport {
        nav: nav_name,
        truth: truth_name,
        skipped_nav_rows: nav.report.faulty(),
        skipped_truth_rows: truth.report.faulty(),
        satellites: WithSatellites::all(&nav.rows, &found),
        ..ErrorReport::new(&found, drifts, Evidence::new(nav, &found, from))
    };
    Ok((report, found))
}
