//! `insd monitor`: the status page in a terminal.

use std::io::{IsTerminal, Write as _};
use std::sync::Arc;
use std::time::Duration;

use anyhow::{Context, bail};
use insd_lab::terminal::{Farewell, Screen, pressed, print};
use insd_web::snapshot::Snapshot;

use crate::monitor::{self, Board, Client, Link, MonitorView};

/// Time between two pictures.
const FRAME: Duration = Duration::from_millis(200);
/// Time between two lines.
const LINE: Duration = Duration::from_secs(1);

/// Options of `insd monitor`.
#[derive(Clone, Debug, clap::Args)]
pub struct MonitorArgs {
    /// Where the status page is
    #[arg(long, value_name = "URL", default_value = "http://127.0.0.1:8470")]
    url: String,
    /// Print a summary and end: with status 0 if she navigates, with 1 if not
    #[arg(long, conflicts_with_all = ["json", "plain"])]
    once: bool,
    /// Print all of it as JSON and end
    #[arg(long, conflicts_with = "plain")]
    json: bool,
    /// One line of text a second in place of the full screen; so too when output is no terminal
    #[arg(long)]
    plain: bool,
}

/// Shows the state of a running daemon.
///
/// # Errors
/// The program cannot be reached, the terminal fails, or with `--once` the ship does not navigate.
pub fn run(args: &MonitorArgs) -> anyhow::Result<()> {
    let client = Client::new(&args.url);
    if args.json {
        print(&format!("{}\n", client.fetch()?))?;
        return Ok(());
    }
    if args.once {
        return once(&client);
    }
    let plain = args.plain || !std::io::stdout().is_terminal();
    let url = client.url().to_owned();
    let board = Arc::new(Board::default());
    // the thread ends with the program
    client.follow(Arc::clone(&board)).context("cannot start a thread")?;
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    runtime.block_on(async { if plain { lines(&board).await } else { screen(&board, &url).await } })
}

fn once(client: &Client) -> anyhow::Result<()> {
    let snapshot: Snapshot =
        serde_json::from_str(&client.fetch()?).context("this is no status of insd")?;
    print(&monitor::summary(&snapshot).to_string())?;
    if !snapshot.is_navigating() {
        bail!("not navigating: {}", snapshot.mode.name.replace('_', " "));
    }
    Ok(())
}

async fn lines(board: &Board) -> anyhow::Result<()> {
    let mut farewell = Farewell::new(None)?;
    loop {
        tokio::select! {
            () = tokio::time::sleep(LINE) => {}
            () = farewell.wait() => return Ok(()),
        }
        let line = match (board.snapshot(), board.link().0) {
            (Some(snapshot), Link::Live) => monitor::line(&snapshot),
            (_, Link::Silent) => "no new data".to_owned(),
            _ => board.fault().unwrap_or_else(|| "connecting".to_owned()),
        };
        // a closed pipe is the end, not a fault
        if writeln!(std::io::stdout(), "{line}").is_err() {
            return Ok(());
        }
    }
}

async fn screen(board: &Board, url: &str) -> anyhow::Result<()> {
    let mut farewell = Farewell::new(None)?;
    let mut screen = Screen::new()?;
    let mut view = MonitorView::default();
    loop {
        screen.terminal.draw(|frame| monitor::draw(frame, board, url, view))?;
        tokio::select! {
            () = tokio::time::sleep(FRAME) => {}
            () = farewell.wait() => return Ok(()),
        }
        let pressed = pressed()?;
        if pressed.quit {
            return Ok(());
        }
        view = pressed.letters.chars().fold(view, MonitorView::after);
    }
}
