//! Runs of several files put together, as if one computer had sailed them all.

use std::path::PathBuf;

use insd_config::BadInput;

use super::declared::Declared;
use super::kept::Kept;

/// Reads all files.
///
/// # Errors
/// One cannot be read, is of another campaign, or has a seed that another has, too.
pub(super) fn merge(paths: &[PathBuf]) -> anyhow::Result<Kept> {
    let mut whole = Kept::default();
    let mut first = String::new();
    for path in paths {
        let kept = Kept::read(path)?;
        let name = path.display().to_string();
        if kept.declared.is_empty() {
            return Err(BadInput(format!("{name}: no line says what campaign it is of")).into());
        }
        if whole.declared.is_empty() {
            whole.declared.clone_from(&kept.declared);
            first.clone_from(&name);
        }
        same_campaigns(&whole.declared, &kept.declared, &first, &name)?;
        take_over(&mut whole, kept, &name)?;
    }
    Ok(whole)
}

fn same_campaigns(
    own: &[Declared],
    others: &[Declared],
    here: &str,
    there: &str,
) -> Result<(), BadInput> {
    for declared in own {
        let matching = others.iter().find(|other| other.sweep == declared.sweep);
        // with another sweep the first of each tells the difference
        let other = matching.or(others.first());
        other.map_or(Ok(()), |other| declared.is_same(other, here, there))?;
    }
    if own.len() == others.len() {
        Ok(())
    } else {
        Err(BadInput(format!("{there} has {} variations and {here} {}", others.len(), own.len())))
    }
}

fn take_over(whole: &mut Kept, kept: Kept, name: &str) -> Result<(), BadInput> {
    for (id, runs) in kept.runs {
        let own = whole.runs.entry(id).or_default();
        for (seed, (line, run)) in runs {
            if own.insert(seed, (line, run)).is_some() {
                return Err(BadInput(format!(
                    "{name}:{line}: seed {seed} is in a file before it already"
                )));
            }
        }
    }
    Ok(())
}
