//! The name that a recording bears in its header: this library, and the wire whose frames it holds.

use taxel_core::wire::PROTOCOL;

/// Name in the header of a recording.
pub(super) fn library() -> String {
    format!("taxel {}, wire {PROTOCOL}", env!("CARGO_PKG_VERSION"))
}

/// Says why a recording of that name cannot be read; none if it can, as those of other programs. The first
/// recordings did not name their wire. Those of later ones say in each `Hello` which it is: a name in which a bit
/// has changed is no reason to refuse a file.
pub(super) fn foreign_wire(library: &str) -> Option<String> {
    let version = library.strip_prefix("taxel ")?;
    let is_first = version.chars().all(|sign| sign.is_ascii_digit() || sign == '.');
    is_first.then(|| {
        format!(
            "it was recorded with wire 1, and this program reads wire {PROTOCOL}: read it with taxel {version}, which \
             recorded it"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recording_of_another_wire_is_refused_by_version() {
        assert_eq!(foreign_wire(&library()), None);
        assert_eq!(foreign_wire("libmcap 1.2"), None);
        let first = "it was recorded with wire 1, and this program reads wire 2: read it with taxel 0.1.0, which recorded it";
        assert_eq!(foreign_wire("taxel 0.1.0").as_deref(), Some(first));
        assert_eq!(foreign_wire("taxel 0.2.00wire 2"), None, "a damaged name");
    }
}
