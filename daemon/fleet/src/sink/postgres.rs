//! Rows into PostgreSQL, by way of `psql`, which is wherever its client is: it knows passwords, services, TLS and
//! all else that a connection may need. A batch is a transaction, and done when the server says so.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io;
use std::process::Stdio;

use serde_json::Value;
use tokio::io::{AsyncBufReadExt, AsyncWriteExt, BufReader, Lines};
use tokio::process::{Child, ChildStdin, ChildStdout, Command};

use super::columns::{ALERT, FleetColumn, SHIP};
use super::row::{FleetRow, RowKind};

/// What every row begins with.
const KEY: &str = "ship text not null, run text not null, seq bigint not null, utc timestamptz";
/// What every row ends with.
const END: &str = "told jsonb not null, received timestamptz not null default now()";

/// The tables, as they are made where they are not there.
#[must_use]
pub fn schema() -> String {
    let (ship, alert) = (definitions(&SHIP), definitions(&ALERT));
    format!(
        "create table if not exists insd_history ({KEY}, {ship}, {END}, primary key (ship, run, seq));\n\
         create index if not exists insd_history_utc on insd_history (ship, utc);\n\
         create table if not exists insd_alert ({KEY}, {alert}, {END}, primary key (ship, run, seq));\n\
         create table if not exists insd_state ({KEY}, name text, {ship}, {END}, primary key (ship));\n"
    )
}

fn definitions(columns: &[FleetColumn]) -> String {
    let kind = |own: &FleetColumn| if own.is_number { "double precision" } else { "text" };
    columns.iter().map(|own| format!("{} {}", own.name, kind(own))).collect::<Vec<_>>().join(", ")
}

fn names(columns: &[FleetColumn]) -> String {
    columns.iter().map(|own| own.name).collect::<Vec<_>>().join(", ")
}

/// Tables of the session through which rows come in.
fn doors() -> String {
    ["history", "alert", "state"]
        .map(|own| {
            format!("create temp table insd_{own}_in (like insd_{own} including defaults) on commit delete rows;\n")
        })
        .concat()
}

/// A transaction that writes some rows.
#[must_use]
pub fn transaction(rows: &[FleetRow]) -> String {
    let of = |kind: RowKind| rows.iter().filter(move |own| own.kind == kind);
    let mut text = "begin;\n".to_owned();
    copy(&mut text, "history", &SHIP, of(RowKind::History));
    copy(&mut text, "alert", &ALERT, of(RowKind::Alert));
    // of each ship the last state counts
    let states: BTreeMap<&str, &FleetRow> =
        of(RowKind::State).map(|own| (own.ship.as_str(), own)).collect();
    copy(&mut text, "state", &SHIP, states.into_values());
    text.push_str("commit;\n");
    text
}

fn copy<'a>(
    text: &mut String,
    table: &str,
    columns: &[FleetColumn],
    rows: impl Iterator<Item = &'a FleetRow>,
) {
    let is_state = table == "state";
    let name = if is_state { "name, " } else { "" };
    let all = format!("ship, run, seq, utc, {name}{}, told", names(columns));
    let start = text.len();
    let _ = writeln!(text, "copy insd_{table}_in ({all}) from stdin;");
    let head = text.len();
    for row in rows {
        line(text, row, columns, is_state);
    }
    if text.len() == head {
        return text.truncate(start);
    }
    let newest =
        columns.iter().map(|own| own.name).chain(["run", "seq", "utc", "name", "told", "received"]);
    let newest: Vec<String> = newest.map(|own| format!("{own} = excluded.{own}")).collect();
    let conflict = if is_state {
        format!(
            "(ship) do update set {} where insd_state.run <> excluded.run or insd_state.seq < excluded.seq",
            newest.join(", ")
        )
    } else {
        "do nothing".to_owned()
    };
    let _ = writeln!(
        text,
        "\\.\ninsert into insd_{table} ({all}) select {all} from insd_{table}_in on conflict {conflict};"
    );
}

/// A row in the text format of COPY.
fn line(text: &mut String, row: &FleetRow, columns: &[FleetColumn], with_name: bool) {
    let _ = write!(text, "{}\t{}\t{}\t", escaped(&row.ship), row.run, row.sequence);
    let optional = |own: Option<&str>| own.map_or("\\N".to_owned(), escaped);
    text.push_str(&optional(row.utc.as_deref()));
    if with_name {
        let _ = write!(text, "\t{}", optional(row.name.as_deref()));
    }
    for column in columns {
        let value = column.of(&row.told).map(|own| match own {
            Value::String(word) => escaped(word),
            number => number.to_string(),
        });
        let _ = write!(text, "\t{}", value.as_deref().unwrap_or("\\N"));
    }
    let _ = writeln!(text, "\t{}", escaped(&row.told.to_string()));
}

fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' => escaped.push_str("\\\\"),
            '\t' => escaped.push_str("\\t"),
            '\n' => escaped.push_str("\\n"),
            '\r' => escaped.push_str("\\r"),
            c => escaped.push(c),
        }
    }
    escaped
}

/// A session of `psql`.
#[derive(Debug)]
pub struct PostgresSession {
    child: Child,
    input: ChildStdin,
    output: Lines<BufReader<ChildStdout>>,
    batches: u64,
}

impl PostgresSession {
    /// Begins a session and makes the tables; `target` is a database, connection string or URI, as psql takes it.
    ///
    /// # Errors
    /// There is no `psql`, or it does not reach the server, which it says on standard error.
    pub async fn start(target: &str) -> io::Result<Self> {
        let mut child = Command::new("psql")
            .args(["--no-psqlrc", "--quiet", "--tuples-only", "--no-align", "--no-password"])
            .args(["--set=ON_ERROR_STOP=1", "--dbname", target])
            .env("PGOPTIONS", "-c client_min_messages=warning")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .kill_on_drop(true)
            .spawn()?;
        let ends = child.stdin.take().zip(child.stdout.take());
        let (input, output) = ends.ok_or_else(|| io::Error::other("psql has no ends"))?;
        let output = BufReader::new(output).lines();
        let mut session = PostgresSession { child, input, output, batches: 0 };
        session.run(&(schema() + &doors())).await?;
        Ok(session)
    }

    /// Writes some rows; they are there when it returns.
    ///
    /// # Errors
    /// The session is over, and nothing of the rows is there.
    pub async fn write(&mut self, rows: &[FleetRow]) -> io::Result<()> {
        self.run(&transaction(rows)).await
    }

    async fn run(&mut self, script: &str) -> io::Result<()> {
        self.batches += 1;
        let word = format!("insd-done-{}", self.batches);
        self.input.write_all(script.as_bytes()).await?;
        self.input.write_all(format!("select '{word}';\n").as_bytes()).await?;
        self.input.flush().await?;
        loop {
            match self.output.next_line().await? {
                Some(line) if line == word => return Ok(()),
                Some(_) => {}
                None => {
                    let status = self.child.wait().await?;
                    return Err(io::Error::other(format!("psql has ended: {status}")));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::key::RunId;

    #[test]
    fn a_text_cannot_break_out_of_its_column() {
        let told = json!({ "mode": { "name": "a\tb\n\\." }, "motion": { "lat_deg": 53.5 } });
        let (ship, run) = ("x\\.\n".to_owned(), RunId::of_number(1));
        let row = FleetRow {
            kind: RowKind::History,
            ship,
            name: None,
            run,
            sequence: 7,
            utc: None,
            nanos: None,
            told,
        };
        let text = transaction(&[row]);
        let line = text.lines().nth(2).unwrap();
        assert!(
            line.starts_with("x\\\\.\\n\t0000000000000001\t7\t\\N\ta\\tb\\n\\\\.\t53.5\t\\N"),
            "{line}"
        );
        assert_eq!(text.lines().filter(|line| *line == "\\.").count(), 1);
        assert_eq!(text.matches("copy ").count(), 1);
    }
}
