//! The password: out of a file that others cannot read, and never into a word of ours.

use std::fs::File;
use std::io::Read;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use super::config::Ntrip;

/// Where systemd has put the credentials of the service.
const DIRECTORY: &str = "CREDENTIALS_DIRECTORY";
/// Longest file, bytes.
const LONGEST: u64 = 1024;
/// Who else may not read it.
const OTHERS: u32 = 0o077;

/// The password of a caster; empty where there is none.
///
/// # Errors
/// In words, without a byte of it: it is not there, others may read it, or it is none.
pub(in super::super) fn password(config: &Ntrip) -> Result<String, String> {
    let Some(path) = path(config)? else { return Ok(String::new()) };
    read_password(&path).map_err(|fault| format!("password: {}: {fault}", path.display()))
}

fn path(config: &Ntrip) -> Result<Option<PathBuf>, String> {
    let Some(name) = &config.credential else { return Ok(config.password_file.clone()) };
    let directory = std::env::var_os(DIRECTORY).ok_or_else(|| {
        format!("password: credential {name}: the service is given none (LoadCredential=)")
    })?;
    Ok(Some(Path::new(&directory).join(name)))
}

/// The first line of a file that nobody else can read. It is opened once, so that what is looked at is what is read.
///
/// # Errors
/// In words, without a byte of it: it is not there, others may read it, or it is none.
pub fn read_password(path: &Path) -> Result<String, String> {
    let file = File::open(path).map_err(|error| error.to_string())?;
    let mode = file.metadata().map_err(|error| error.to_string())?.permissions().mode();
    if mode & OTHERS != 0 {
        let mode = mode & 0o777;
        return Err(format!("others can read it (mode {mode:04o}); chmod 600 makes it safe"));
    }
    let mut text = String::new();
    file.take(LONGEST).read_to_string(&mut text).map_err(|error| error.to_string())?;
    let line = text.lines().next().unwrap_or("");
    if line.is_empty() || line.contains(char::is_control) {
        return Err("there is no password in it".to_owned());
    }
    Ok(line.to_owned())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_password_that_others_can_read_is_refused_without_being_told() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("secret");
        fs::write(&file, "tOpSecret\n").unwrap();
        let own = Ntrip {
            user: Some("ship".to_owned()),
            password_file: Some(file.clone()),
            ..Ntrip::new("a:1".to_owned(), "M".to_owned())
        };
        let allow = |mode| fs::set_permissions(&file, fs::Permissions::from_mode(mode)).unwrap();
        for mode in [0o644, 0o640, 0o604, 0o660] {
            allow(mode);
            let fault = password(&own).unwrap_err();
            assert!(fault.contains("others can read it") && fault.contains("chmod 600"), "{fault}");
            assert!(!fault.contains("tOpSecret"), "{fault}");
        }
        for mode in [0o600, 0o400] {
            allow(mode);
            assert_eq!(password(&own).unwrap(), "tOpSecret");
        }
        fs::write(&file, "").unwrap_or(());
        allow(0o600);
        fs::write(&file, "\n").unwrap();
        assert!(password(&own).unwrap_err().contains("no password"));
        fs::remove_file(&file).unwrap();
        assert!(password(&own).unwrap_err().contains("secret"));
    }

    #[test]
    fn a_credential_that_the_service_is_not_given_is_told() {
        let own = Ntrip {
            credential: Some("caster".to_owned()),
            ..Ntrip::new("a:1".to_owned(), "M".to_owned())
        };
        assert!(password(&own).unwrap_err().contains("caster"));
        let none = Ntrip::new("a:1".to_owned(), "M".to_owned());
        assert_eq!(password(&none).unwrap(), "");
    }
}
