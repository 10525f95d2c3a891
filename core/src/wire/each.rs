//! A list whose elements are computed while they are written.

use serde::ser::SerializeSeq;
use serde::{Serialize, Serializer};

/// Elements as a list, without a place that holds them all. Unless their number is known, they are computed
/// twice.
pub(crate) struct Each<I>(pub I);

impl<I: Iterator<Item: Serialize> + Clone> Serialize for Each<I> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let count = match self.0.size_hint() {
            (least, Some(most)) if least == most => least,
            _ => self.0.clone().count(),
        };
        let mut list = serializer.serialize_seq(Some(count))?;
        for element in self.0.clone() {
            list.serialize_element(&element)?;
        }
        list.end()
    }
}
