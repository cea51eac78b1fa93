//! Files and folders that the daemon needs beside its ports.

use std::fs::{self, Metadata};
use std::io::ErrorKind;
use std::os::unix::fs::{FileTypeExt, MetadataExt};
use std::path::Path;

use insd_config::Config;
use insd_config::check::{ConfigFinding, ConfigPlace, Severity};
use insd_web::MIN_TOKEN;

use super::people::{Person, Wish, group_name};

/// Bytes of a megabyte, as quotas count.
const MEGABYTE: u64 = 1_000_000;

pub(super) fn look(config: &Config, person: &Person) -> Vec<ConfigFinding> {
    let mut found = Vec::new();
    if let Some(file) = config.web.token_file.as_deref().filter(|_| config.web.enabled) {
        found.extend(token(file, person));
    }
    if let Some(recording) = &config.recording {
        let place = ConfigPlace::one("recording").key("folder");
        let own = folder("recording-folder", place, &recording.folder, person);
        if own.is_none() {
            found.extend(room(&recording.folder, recording.quota_mb));
        }
        found.extend(own);
    }
    let state = &config.state;
    for (key, path) in [("folder", &state.folder), ("runtime_folder", &state.runtime_folder)] {
        if let Some(path) = path.as_deref().filter(|_| state.enabled) {
            let place = ConfigPlace::one("state").key(key);
            found.extend(folder("state-folder", place, path, person));
        }
    }
    if let Some(chrony) = &config.chrony {
        found.extend(socket(&chrony.socket, person));
    }
    found
}

/// The file with the word that allows changes.
fn token(file: &Path, person: &Person) -> Vec<ConfigFinding> {
    let place = || ConfigPlace::one("web").key("token_file");
    let path = file.display();
    let make = format!(
        "sudo install -m 640 -g insd /dev/null {path}; openssl rand -base64 24 | sudo tee {path}"
    );
    let data = match fs::metadata(file) {
        Ok(data) => data,
        Err(error) => {
            let text = format!("{path}: {}", reason(&error));
            let finding = ConfigFinding::new(Severity::Error, "token-absent", place(), &text);
            return vec![finding.advise(make)];
        }
    };
    let mut found = Vec::new();
    if !person.may(Wish::Read, &data) {
        let text = format!("{path} cannot be read by {}", person.name);
        let finding = ConfigFinding::new(Severity::Error, "token-denied", place(), &text);
        found.push(finding.advise(format!("sudo chgrp insd {path}; sudo chmod 640 {path}")));
    }
    if data.mode() & 0o004 != 0 {
        let text = format!("{path} can be read by everybody on this computer");
        let finding = ConfigFinding::new(Severity::Warning, "token-open", place(), &text);
        found.push(finding.advise(format!("sudo chgrp insd {path}; sudo chmod 640 {path}")));
    }
    if let Ok(text) = fs::read_to_string(file) {
        let length = text.trim().chars().count();
        if length < MIN_TOKEN {
            let text = format!("the token has {length} characters; {MIN_TOKEN} is the least");
            found.push(
                ConfigFinding::new(Severity::Error, "token-short", place(), &text).advise(make),
            );
        }
    }
    found
}

/// A folder in which the daemon writes.
fn folder(
    cause: &'static str,
    place: ConfigPlace,
    path: &Path,
    person: &Person,
) -> Option<ConfigFinding> {
    let shown = path.display();
    let make = format!("sudo install -d -o {0} -g {0} -m 750 {shown}", person.name);
    let text = match fs::metadata(path) {
        Err(error) => format!("{shown}: {}", reason(&error)),
        Ok(data) if !data.is_dir() => format!("{shown} is no folder"),
        Ok(data) if !person.may(Wish::Write, &data) => {
            format!("{shown} cannot be written to by {}", person.name)
        }
        Ok(_) => return None,
    };
    Some(ConfigFinding::new(Severity::Error, cause, place, &text).advise(make))
}

/// Whether the disk has room for the quota.
fn room(folder: &Path, quota_mb: Option<u64>) -> Option<ConfigFinding> {
    let disk = rustix::fs::statvfs(folder).ok()?;
    let free_mb = disk.f_bavail.saturating_mul(disk.f_frsize) / MEGABYTE;
    let quota = quota_mb.filter(|quota| *quota > free_mb)?;
    let place = ConfigPlace::one("recording").key("quota_mb");
    let text = format!("{quota} MB are more than the {free_mb} MB that are free on this disk");
    let finding = ConfigFinding::new(Severity::Warning, "recording-room", place, &text);
    Some(finding.advise(format!("quota_mb = {}", free_mb * 8 / 10)))
}

/// The socket of chronyd.
fn socket(path: &Path, person: &Person) -> Option<ConfigFinding> {
    let place = ConfigPlace::one("chrony").key("socket");
    let shown = path.display();
    let advice = format!("`refclock SOCK {shown}` in chrony's configuration; docs/service.md");
    let text = match fs::metadata(path) {
        Err(error) => format!("{shown}: {}", reason(&error)),
        Ok(data) if !data.file_type().is_socket() => format!("{shown} is no socket"),
        Ok(data) if !person.may(Wish::Write, &data) => return denied(&place, path, &data, person),
        Ok(_) => return None,
    };
    Some(ConfigFinding::new(Severity::Warning, "chrony-socket", place, &text).advise(advice))
}

fn denied(
    place: &ConfigPlace,
    path: &Path,
    data: &Metadata,
    person: &Person,
) -> Option<ConfigFinding> {
    let (shown, group) = (path.display(), group_name(data.gid()));
    let text = format!("{shown} is for the group {group}, and {} is not in it", person.name);
    let advice =
        format!("setfacl -m u:{}:rw {shown}, each time it is made: docs/service.md", person.name);
    Some(
        ConfigFinding::new(Severity::Warning, "chrony-socket", place.clone(), &text).advise(advice),
    )
}

/// What the system says, without its number.
pub(super) fn reason(error: &std::io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "there is no such file".to_owned(),
        ErrorKind::PermissionDenied => "cannot be looked at: permission denied".to_owned(),
        _ => error.to_string(),
    }
}
