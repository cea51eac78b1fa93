//! `insd integrity`: errors against the protection levels that were told with them.

use std::path::PathBuf;

use insd_base::{Solution, Time, Truth};
use insd_config::BadInput;
use insd_drivers::recording::{NavRow, Rows, read_nav_rows, read_truth_rows};

use crate::evaluation::plot::StanfordChart;
use crate::evaluation::{AlertLimit, IntegrityReport, errors};

/// What stands behind the options.
const MORE: &str = "\
Each epoch has a place in the Stanford chart: unavailable where the level is not below the alert limit, or the row says
that it is not to be used; else nominal where the error is within the level, misleading where it is beyond the level but
within the limit, hazardous where it is beyond the limit. Intervals are of 95 % confidence, for as many independent
samples as the epochs are worth by the autocorrelation of the errors.

Alert limits with a name: ocean 100 m, harbour 10 m (IMO A.1046); coastal 25 m, port 2.5 m, docking 0.25 m (IMO A.915);
circ1575-a 100 m, circ1575-b 10 m, circ1575-c 1 m, circ1575-d 0.1 m (MSC.1/Circ.1575).

Ends with 0 if no epoch is hazardous, with 3 if any is, with 2 if a file cannot be used, and with 1 otherwise.";

/// Options of `insd integrity`.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = MORE)]
pub struct IntegrityArgs {
    /// Solution with protection levels (hpl_m, vpl_m)
    #[arg(value_name = "NAV.csv")]
    nav: PathBuf,
    /// Truth, plain or compressed
    #[arg(value_name = "TRUTH.csv")]
    truth: PathBuf,
    /// Alert limit of the horizontal error, m, or its name
    #[arg(long, value_name = "M|NAME", default_value = "harbour")]
    alert_limit: AlertLimit,
    /// Alert limit of the error of the height, m, or its name; that of the horizontal one if absent
    #[arg(long, value_name = "M|NAME")]
    vertical_alert_limit: Option<AlertLimit>,
    /// Leave out what is before this time, s
    #[arg(long, value_name = "T", value_parser = super::seconds)]
    from: Option<f64>,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    /// Draw the chart, and levels and errors over time
    #[arg(long, value_name = "FILE.png|.svg", value_parser = super::picture)]
    plot: Option<PathBuf>,
}

/// Some epochs are hazardous: the program ends with exit status 3.
#[derive(Debug, thiserror::Error)]
#[error("{epochs} hazardous epochs: the error was beyond the alert limit, the level within it")]
pub struct Hazardous {
    /// How many.
    pub epochs: u64,
}

/// Runs the command.
///
/// # Errors
/// A file cannot be read, tells no levels, or the two have no common time; epochs are hazardous.
pub fn run(args: &IntegrityArgs) -> anyhow::Result<()> {
    let nav = read_nav_rows(&args.nav)?;
    let truth = read_truth_rows(&args.truth)?;
    let names = [&args.nav, &args.truth].map(|file| file.display().to_string());
    let limits = [Some(args.alert_limit), args.vertical_alert_limit];
    let limits = limits.map(|limit| limit.unwrap_or(args.alert_limit));
    let report = judge(names, &nav, &truth, limits, args.from.map(Time::from_seconds))?;
    if args.json {
        crate::terminal::print(&(serde_json::to_string_pretty(&report)? + "\n"))?;
    } else {
        crate::terminal::print(&report.to_string())?;
    }
    if let Some(file) = &args.plot {
        let name = args.nav.file_name().unwrap_or(args.nav.as_os_str()).to_string_lossy();
        StanfordChart { title: &name, report: &report }.draw(file)?;
    }
    match report.hazardous() {
        0 => Ok(()),
        epochs => Err(Hazardous { epochs }.into()),
    }
}

/// Errors from a time on against the levels that were told with them, at alert limits of the horizontal error and of that of
/// the height; `names` of solution and truth are told in the report.
///
/// # Errors
/// The solution tells no levels, or the two have no common time.
pub fn judge(
    names: [String; 2],
    nav: &Rows<NavRow>,
    truth: &Rows<Truth>,
    limits: [AlertLimit; 2],
    from: Option<Time>,
) -> Result<IntegrityReport, BadInput> {
    let [nav_name, truth_name] = names;
    if !nav.has("hpl_m") {
        return Err(BadInput(format!(
            "{nav_name}: no column hpl_m, so there is no level to judge"
        )));
    }
    let solutions: Vec<Solution> = nav.rows.iter().map(|row| row.solution).collect();
    let found = errors(&solutions, &truth.rows, from);
    let [horizontal, vertical] = limits;
    let report = IntegrityReport::new(nav, &found, horizontal, vertical.limit_m);
    if report.horizontal.epochs == 0 {
        return Err(BadInput(format!(
            "{nav_name} and {truth_name} have no common time to compare"
        )));
    }
    Ok(IntegrityReport { nav: nav_name, truth: truth_name, ..report })
}
