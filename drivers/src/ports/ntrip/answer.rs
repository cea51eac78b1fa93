//! What a caster answers. Reads any bytes and never panics.

/// Longest header, bytes.
const HEADER: usize = 8 * 1024;
/// Longest piece of an answer that is quoted, characters.
const QUOTED: usize = 60;
/// Mount points that are named.
const NAMED: usize = 6;

/// What is to be made of an answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    /// The stream begins.
    Stream {
        /// Words for it: which version answers.
        version: &'static str,
        /// It comes in chunks (HTTP/1.1).
        is_chunked: bool,
        /// Bytes of the stream that have come already.
        rest: Vec<u8>,
    },
    /// A table of what the caster has comes in its place.
    Table {
        /// Bytes of the table that have come already.
        rest: Vec<u8>,
    },
    /// There is no stream, and why.
    Refused(String),
}

/// Reads an answer; `None` while more of it must come.
pub(super) fn read(bytes: &[u8], mount: &str) -> Option<Answer> {
    let Some((line, after)) = split_line(bytes) else {
        // no answer begins with what cannot be text
        let is_rubbish = bytes.len() > HEADER || bytes.iter().any(|byte| !is_text(*byte));
        return is_rubbish.then(|| Answer::Refused(no_caster(bytes)));
    };
    let text = String::from_utf8_lossy(line);
    if text.starts_with("ICY 200") {
        let (version, rest) = ("NTRIP 1", without_header(after).to_vec());
        return Some(Answer::Stream { version, is_chunked: false, rest });
    }
    if text.starts_with("SOURCETABLE 200") {
        return Some(Answer::Table { rest: after.to_vec() });
    }
    if text.starts_with("ERROR") {
        let is_password = text.to_ascii_lowercase().contains("password");
        let why = if is_password { "user or password refused" } else { "refused" };
        return Some(Answer::Refused(format!("{why}: {}", quoted(line))));
    }
    let code = text.strip_prefix("HTTP/1.").and_then(|rest| rest.split(' ').nth(1)?.parse().ok());
    let Some(code) = code else { return Some(Answer::Refused(no_caster(line))) };
    let Some((header, rest)) = split_header(after) else {
        return (bytes.len() > HEADER)
            .then(|| Answer::Refused("the header of the answer has no end".to_owned()));
    };
    Some(of_http(code, line, header, rest, mount))
}

fn of_http(code: u16, line: &[u8], header: &[u8], rest: &[u8], mount: &str) -> Answer {
    let refused = |why: String| Answer::Refused(format!("{why}: {}", quoted(line)));
    match code {
        200 => {}
        401 | 403 => return refused("user or password refused".to_owned()),
        404 => return refused(format!("there is no mount point {mount}")),
        300..=399 => return refused("the caster is elsewhere".to_owned()),
        _ => return refused("no stream".to_owned()),
    }
    let header = String::from_utf8_lossy(header).to_ascii_lowercase();
    let value = |name: &str| {
        let own = |line: &str| Some(line.strip_prefix(name)?.strip_prefix(':')?.trim().to_owned());
        header.lines().find_map(own).unwrap_or_default()
    };
    let kind = value("content-type");
    if kind.starts_with("gnss/sourcetable") {
        return Answer::Table { rest: rest.to_vec() };
    }
    if kind.starts_with("text/html") {
        return Answer::Refused("a web page comes in place of a stream".to_owned());
    }
    let is_chunked = value("transfer-encoding").contains("chunked");
    let version = if is_chunked { "NTRIP 2, chunked" } else { "NTRIP 2" };
    Answer::Stream { version, is_chunked, rest: rest.to_vec() }
}

/// Why a table comes in place of a stream.
pub(super) fn of_table(table: &[u8], mount: &str) -> String {
    let table = String::from_utf8_lossy(table);
    let name = |line: &str| line.strip_prefix("STR;")?.split(';').next().map(str::to_owned);
    let names: Vec<String> = table.lines().filter_map(name).collect();
    if names.iter().any(|name| name == mount) {
        return format!("mount point {mount} is listed, but has no stream at present");
    }
    let shown: Vec<String> = names.iter().take(NAMED).map(|name| quoted(name.as_bytes())).collect();
    match names.len() {
        0 => format!("there is no mount point {mount}: the caster has none"),
        count if count > NAMED => {
            let (shown, more) = (shown.join(", "), count - NAMED);
            format!("there is no mount point {mount}: the caster has {shown} and {more} more")
        }
        _ => format!("there is no mount point {mount}: the caster has {}", shown.join(", ")),
    }
}

/// Whether a table has come to its end.
pub(super) fn is_whole(table: &[u8]) -> bool {
    table.windows(14).any(|window| window == b"ENDSOURCETABLE")
}

fn no_caster(bytes: &[u8]) -> String {
    format!("that is no NTRIP caster: it answers \"{}\"", quoted(bytes))
}

fn is_text(byte: u8) -> bool {
    byte.is_ascii_graphic() || byte.is_ascii_whitespace()
}

/// A line without its end, and what follows.
fn split_line(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let end = bytes.iter().position(|byte| *byte == b'\n')?;
    let line = &bytes[..end];
    Some((line.strip_suffix(b"\r").unwrap_or(line), &bytes[end + 1..]))
}

/// Lines up to an empty one, and what follows.
fn split_header(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let mut rest = bytes;
    loop {
        let (line, after) = split_line(rest)?;
        if line.is_empty() {
            return Some((&bytes[..bytes.len() - rest.len()], after));
        }
        rest = after;
    }
}

/// Casters of version 1 send an empty line behind their word, some a header, and some neither.
fn without_header(bytes: &[u8]) -> &[u8] {
    match split_header(bytes) {
        Some((header, rest)) if header.iter().all(|byte| is_text(*byte)) => rest,
        _ => bytes,
    }
}

fn quoted(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    text.trim().chars().take(QUOTED).flat_map(char::escape_default).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(bytes: &[u8]) -> String {
        match read(bytes, "BASE") {
            Some(Answer::Refused(why)) => why,
            other => panic!("{other:?}"),
        }
    }

    fn stream(bytes: &[u8]) -> (&'static str, bool, Vec<u8>) {
        match read(bytes, "BASE") {
            Some(Answer::Stream { version, is_chunked, rest }) => (version, is_chunked, rest),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn casters_of_both_versions_are_understood() {
        assert_eq!(stream(b"ICY 200 OK\r\n\r\n\xD3\x00"), ("NTRIP 1", false, vec![0xD3, 0]));
        assert_eq!(stream(b"ICY 200 OK\r\n\xD3\x00"), ("NTRIP 1", false, vec![0xD3, 0]));
        assert_eq!(stream(b"ICY 200 OK\r\nServer: x\r\n\r\n\xD3").2, [0xD3]);
        let chunked = b"HTTP/1.1 200 OK\r\nContent-Type: gnss/data\r\n\
                        TRANSFER-ENCODING: Chunked\r\n\r\n4\r\n";
        assert_eq!(stream(chunked), ("NTRIP 2, chunked", true, b"4\r\n".to_vec()));
        assert_eq!(stream(b"HTTP/1.0 200 OK\n\n\xD3"), ("NTRIP 2", false, vec![0xD3]));
    }

    #[test]
    fn each_refusal_has_a_word_of_its_own() {
        let bad = refusal(b"HTTP/1.1 401 Unauthorized\r\nWWW-Authenticate: Basic\r\n\r\n");
        assert_eq!(bad, "user or password refused: HTTP/1.1 401 Unauthorized");
        let bad = refusal(b"ERROR - Bad Password\r\n");
        assert_eq!(bad, "user or password refused: ERROR - Bad Password");
        let bad = refusal(b"ERROR - Mount Point Taken or Invalid\r\n");
        assert_eq!(bad, "refused: ERROR - Mount Point Taken or Invalid");
        assert!(refusal(b"HTTP/1.1 404 Not Found\r\n\r\n").contains("no mount point BASE"));
        assert!(refusal(b"HTTP/1.1 302 Found\r\n\r\n").contains("elsewhere"));
        assert!(refusal(b"HTTP/1.1 503 Busy\r\n\r\n").contains("503 Busy"));
        let page = b"HTTP/1.1 200 OK\r\nContent-Type: text/html\r\n\r\n<html>";
        assert!(refusal(page).contains("a web page"));
        assert!(refusal(b"SSH-2.0-OpenSSH_9.2\r\n").contains("no NTRIP caster"));
        assert!(refusal(&[0xD3, 0, 0x13, 0xFF]).contains("no NTRIP caster"));
        assert!(refusal(&[b'a'; HEADER + 1]).contains("no NTRIP caster"));
        let endless = [b"HTTP/1.1 200 OK\r\n".to_vec(), b"a: b\r\n".repeat(2000)].concat();
        assert!(refusal(&endless).contains("no end"));
    }

    #[test]
    fn an_answer_that_is_not_whole_is_waited_for() {
        let whole = b"HTTP/1.1 200 OK\r\nContent-Type: gnss/data\r\n\r\n";
        for length in 0..whole.len() {
            assert_eq!(read(&whole[..length], "BASE"), None, "{length}");
        }
        assert!(read(whole, "BASE").is_some());
    }

    #[test]
    fn a_table_says_which_mount_points_there_are() {
        let table = b"STR;A;x;RTCM 3\r\nSTR;B;y;RTCM 3\r\nCAS;c\r\nENDSOURCETABLE\r\n";
        let answer = [b"SOURCETABLE 200 OK\r\n".to_vec(), table.to_vec()].concat();
        assert!(matches!(read(&answer, "BASE"), Some(Answer::Table { .. })));
        assert!(is_whole(table) && !is_whole(&table[..40]));
        let told = of_table(table, "BASE");
        assert_eq!(told, "there is no mount point BASE: the caster has A, B");
        assert!(of_table(table, "B").contains("no stream at present"));
        assert!(of_table(b"", "BASE").ends_with("has none"));
        let many: String = (0..40).map(|at| format!("STR;M{at};\r\n")).collect();
        assert!(of_table(many.as_bytes(), "BASE").ends_with("M5 and 34 more"));
    }

    #[test]
    fn any_bytes_are_read() {
        for seed in 0..2000_u32 {
            let length = seed as usize % 60;
            let byte = |at: usize| (seed.wrapping_mul(2_654_435_761) >> (at % 24)) as u8;
            let bytes: Vec<u8> = (0..length).map(byte).collect();
            let _ = read(&bytes, "BASE");
            let _ = read(&[b"HTTP/1.1 200 OK\r\n", &bytes[..]].concat(), "BASE");
            let _ = of_table(&bytes, "BASE");
        }
    }
}
