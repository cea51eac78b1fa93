//! What a campaign is: all on which its figures depend.

use std::fmt::{Debug, Display};

use insd_config::BadInput;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// What a campaign is, or one variation of it. Runs of two files may be put together if it is the same in both.
pub trait CampaignDeclaration:
    Clone + Debug + PartialEq + Serialize + DeserializeOwned + Sync
{
    /// What a run is told by.
    type Key: Clone + Display + Ord + Send + Sync;
    /// What comes of a voyage.
    type Run: Clone + Debug + Serialize + DeserializeOwned + Send;
    /// What a key is called where one is missing or there twice.
    const KEY: &'static str;

    /// A checksum over all of it.
    fn id(&self) -> &str;

    /// The keys of the whole campaign, in the order in which its report has them.
    fn keys(&self) -> Vec<Self::Key>;

    /// The key of a run.
    fn key_of(run: &Self::Run) -> Self::Key;

    /// Whether a key is one of [`CampaignDeclaration::keys`].
    fn has_key(&self, key: &Self::Key) -> bool;

    /// The keys of the whole campaign in words.
    fn range(&self) -> String;

    /// Whether another one stands for the same variation in its file.
    fn is_counterpart_of(&self, other: &Self) -> bool;

    /// What must be the same where runs are put together, with what it is called; the coarse before the fine.
    fn facts(&self) -> Vec<(&'static str, String)>;

    /// Whether another is the same.
    ///
    /// # Errors
    /// What differs.
    fn is_same(&self, other: &Self, own: &str, others: &str) -> Result<(), BadInput> {
        let pairs = self.facts().into_iter().zip(other.facts());
        let mut different = pairs.filter(|((_, here), (_, there))| here != there);
        match different.next() {
            None => Ok(()),
            Some(((what, here), (_, there))) => Err(BadInput(format!(
                "{others} is of another campaign than {own}: {what} is {there} there and {here} here"
            ))),
        }
    }
}

/// A checksum of what `told` says, as CRC-64/XZ.
pub(crate) fn checksum(told: &str) -> String {
    let crc = crc::Crc::<u64>::new(&crc::CRC_64_XZ);
    format!("{:016x}", crc.checksum(told.as_bytes()))
}
