//! Runs of several files put together, as if one computer had sailed them all.

use std::path::PathBuf;

use insd_config::BadInput;

use super::declaration::CampaignDeclaration;
use super::kept::KeptRuns;

/// Reads all files.
///
/// # Errors
/// One cannot be read, is of another campaign, or has a run that another has, too.
pub(super) fn merge<D: CampaignDeclaration>(paths: &[PathBuf]) -> anyhow::Result<KeptRuns<D>> {
    let mut whole = KeptRuns::<D>::default();
    let mut first = String::new();
    for path in paths {
        let kept = KeptRuns::<D>::read(path)?;
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

fn same_campaigns<D: CampaignDeclaration>(
    own: &[D],
    others: &[D],
    here: &str,
    there: &str,
) -> Result<(), BadInput> {
    for declared in own {
        let matching = others.iter().find(|other| other.is_counterpart_of(declared));
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

fn take_over<D: CampaignDeclaration>(
    whole: &mut KeptRuns<D>,
    kept: KeptRuns<D>,
    name: &str,
) -> Result<(), BadInput> {
    for (id, runs) in kept.runs {
        let own = whole.runs.entry(id).or_default();
        for (key, (line, run)) in runs {
            if own.insert(key.clone(), (line, run)).is_some() {
                return Err(BadInput(format!(
                    "{name}:{line}: {} {key} is in a file before it already",
                    D::KEY
                )));
            }
        }
    }
    Ok(())
}
