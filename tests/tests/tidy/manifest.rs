//! Reads the manifests of the workspace.

use std::fs;
use std::path::{Path, PathBuf};

use toml::{Table, Value};

/// One crate of the workspace.
#[derive(Debug)]
pub(crate) struct Member {
    /// Its name.
    pub(crate) name: String,
    /// Its folder.
    pub(crate) folder: PathBuf,
    manifest: Table,
}

/// The folder of the workspace.
pub(crate) fn root() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own).to_owned()
}

/// All crates that the root manifest lists.
pub(crate) fn members() -> Vec<Member> {
    let manifest = read(&root());
    let list = manifest["workspace"]["members"].as_array().unwrap();
    let folders = list.iter().map(|member| root().join(member.as_str().unwrap()));
    folders
        .map(|folder| {
            let manifest = read(&folder);
            let name = manifest["package"]["name"].as_str().unwrap().to_owned();
            Member { name, folder, manifest }
        })
        .collect()
}

fn read(folder: &Path) -> Table {
    let text = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
    text.parse().unwrap()
}

impl Member {
    /// What it is built from, and whether each is inherited from the workspace.
    pub(crate) fn dependencies(&self) -> Vec<(String, bool)> {
        self.section("dependencies")
    }

    /// The same with what its tests and build script need.
    pub(crate) fn all_dependencies(&self) -> Vec<(String, bool)> {
        ["dependencies", "dev-dependencies", "build-dependencies"]
            .iter()
            .flat_map(|section| self.section(section))
            .collect()
    }

    /// Whether the table at this path says `workspace = true`.
    pub(crate) fn inherits(&self, path: &[&str]) -> bool {
        let start = self.manifest.get(path[0]);
        let value = path[1..].iter().fold(start, |value, key| value?.get(key));
        value.is_some_and(is_inherited)
    }

    fn section(&self, name: &str) -> Vec<(String, bool)> {
        let table = self.manifest.get(name).and_then(Value::as_table);
        let entries = table.into_iter().flatten();
        entries.map(|(name, value)| (name.clone(), is_inherited(value))).collect()
    }
}

fn is_inherited(value: &Value) -> bool {
    value.get("workspace").and_then(Value::as_bool) == Some(true)
}
