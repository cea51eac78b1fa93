//! As whom the daemon runs, and what this person may do.

use std::fs::{self, Metadata};
use std::os::unix::fs::MetadataExt;

/// Number of the one who may do everything.
const ROOT: u32 = 0;

/// A user of the computer with the groups that it is in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Person {
    /// Its name.
    pub name: String,
    uid: u32,
    groups: Vec<u32>,
}

/// What somebody wants to do to a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wish {
    /// Read it.
    Read,
    /// Write it, or files in it.
    Write,
    /// Both.
    Both,
}

impl Person {
    /// A user by name; `None` if there is none.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let read = |file: &str| fs::read_to_string(file).unwrap_or_default();
        Self::of(name, &read("/etc/passwd"), &read("/etc/group"))
    }

    /// Who runs this program.
    #[must_use]
    pub fn here() -> Self {
        let own = fs::metadata("/proc/self").map_or(ROOT, |data| data.uid());
        let passwd = fs::read_to_string("/etc/passwd").unwrap_or_default();
        let name = passwd.lines().find_map(|line| {
            let mut fields = line.split(':');
            let name = fields.next()?;
            (fields.nth(1)?.parse() == Ok(own)).then_some(name)
        });
        let known = name.and_then(Self::named);
        known.unwrap_or_else(|| Person { name: own.to_string(), uid: own, groups: Vec::new() })
    }

    /// From the texts of `/etc/passwd` and `/etc/group`.
    fn of(name: &str, passwd: &str, group: &str) -> Option<Self> {
        let line = passwd.lines().find(|line| line.split(':').next() == Some(name))?;
        let fields: Vec<&str> = line.split(':').collect();
        let (uid, gid) = (fields.get(2)?.parse().ok()?, fields.get(3)?.parse().ok()?);
        let member = |line: &str| {
            let fields: Vec<&str> = line.split(':').collect();
            let is_in = fields.get(3)?.split(',').any(|own| own.trim() == name);
            fields.get(2)?.parse().ok().filter(|_| is_in)
        };
        let groups = std::iter::once(gid).chain(group.lines().filter_map(member)).collect();
        Some(Person { name: name.to_owned(), uid, groups })
    }

    /// Whether the permissions of a file let this person.
    pub(super) fn may(&self, wish: Wish, file: &Metadata) -> bool {
        let mode = file.mode();
        let own = if self.uid == file.uid() {
            mode >> 6
        } else if self.groups.contains(&file.gid()) {
            mode >> 3
        } else {
            mode
        };
        let needed = match wish {
            Wish::Read => 0o4,
            Wish::Write => 0o2,
            Wish::Both => 0o6,
        };
        self.uid == ROOT || own & needed == needed
    }
}

/// The name of a group by its number.
pub(super) fn group_name(number: u32) -> String {
    let groups = fs::read_to_string("/etc/group").unwrap_or_default();
    let named = groups.lines().find_map(|line| {
        let mut fields = line.split(':');
        let name = fields.next()?;
        (fields.nth(1)?.parse() == Ok(number)).then(|| name.to_owned())
    });
    named.unwrap_or_else(|| number.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    const PASSWD: &str =
        "root:x:0:0::/root:/bin/sh\ninsd:x:997:996:Inertial navigation:/:/bin/false\n";
    const GROUP: &str = "dialout:x:20:anna,insd\ninsd:x:996:\n";

    #[test]
    fn a_user_is_in_its_own_group_and_those_that_name_it() {
        let insd = Person::of("insd", PASSWD, GROUP).unwrap();
        assert_eq!((insd.uid, insd.groups), (997, vec![996, 20]));
        assert_eq!(Person::of("nobody", PASSWD, GROUP), None);
    }

    #[test]
    fn a_person_may_what_the_permissions_say() {
        use std::os::unix::fs::PermissionsExt;
        let file = tempfile::NamedTempFile::new().unwrap();
        let may = |mode: u32, person: &Person, wish| {
            file.as_file().set_permissions(fs::Permissions::from_mode(mode)).unwrap();
            person.may(wish, &file.as_file().metadata().unwrap())
        };
        let data = file.as_file().metadata().unwrap();
        let person = |uid, groups| Person { name: String::new(), uid, groups };
        let owner = person(data.uid().max(1), Vec::new());
        let stranger = person(54_321, Vec::new());
        let fellow = person(54_321, vec![data.gid()]);
        assert!(may(0o660, &fellow, Wish::Both) && !may(0o660, &stranger, Wish::Read));
        assert!(may(0o640, &fellow, Wish::Read) && !may(0o640, &fellow, Wish::Write));
        assert!(may(0o604, &stranger, Wish::Read) && !may(0o604, &fellow, Wish::Read));
        assert!(may(0o000, &person(ROOT, Vec::new()), Wish::Both));
        assert_eq!(may(0o200, &owner, Wish::Write), owner.uid == data.uid());
    }
}
