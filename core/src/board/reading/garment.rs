//! Reads a garment.

use super::Unread;
use crate::board::refusal::Refusal;
use crate::garment::{Garment, Group};

/// Decodes a garment from postcard, in the order of its fields. After an error `to` holds the fields read so
/// far.
#[inline(never)]
pub(crate) fn garment(bytes: &[u8], to: &mut Garment) -> Result<(), Refusal> {
    let from = &mut Unread { what: "garment", bytes };
    from.put("name", &mut to.name)?;
    group(from, ["wiring.block.coding", "wiring.block.lines"], &mut to.wiring.block)?;
    group(from, ["wiring.row.coding", "wiring.row.lines"], &mut to.wiring.row)?;
    group(from, ["wiring.column.coding", "wiring.column.lines"], &mut to.wiring.column)?;
    from.list("wiring.enable", &mut to.wiring.enable)?;
    from.put("wiring.settle_ns", &mut to.wiring.settle_ns)?;
    from.put("wiring.falling", &mut to.wiring.falling)?;
    from.list("panels", &mut to.panels)?;
    from.list("blocks", &mut to.blocks)?;
    from.list("seams", &mut to.seams)?;
    from.list("absent", &mut to.absent)?;
    from.end()
}

#[inline(never)]
fn group(from: &mut Unread<'_>, [coding, lines]: [&str; 2], to: &mut Group) -> Result<(), Refusal> {
    from.put(coding, &mut to.coding)?;
    from.list(lines, &mut to.lines)
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::garment::{Absent, Coding, Seam, SeamEdge, Side};
    use std::string::{String, ToString};

    /// A garment that has something in every list.
    fn full() -> Garment {
        let mut garment = Garment::reference();
        let edge = |panel| SeamEdge { panel, side: Side::Bottom, start: 3 };
        let seam = Seam { a: edge(0), b: edge(1), length: 5, reversed: true };
        garment.seams.push(seam).unwrap();
        garment.absent.push(Absent { panel: 1, row: 2, column: 3, rows: 4, columns: 5 }).unwrap();
        garment.wiring.column.coding = Coding::OneHot;
        garment.wiring.enable.push(garment.wiring.row.lines[0]).unwrap();
        garment
    }

    fn refused(bytes: &[u8]) -> String {
        garment(bytes, &mut Garment::default()).unwrap_err().sentence().to_string()
    }

    #[test]
    fn it_reads_what_a_garment_is_written_as() {
        let mut to = Garment::default();
        let mut bytes = [0; 2048];
        // All into one garment: nothing of the previous one may remain.
        for wanted in [Garment::reference(), full(), Garment::block(), Garment::mat(), full()] {
            garment(postcard::to_slice(&wanted, &mut bytes).unwrap(), &mut to).unwrap();
            assert_eq!(to, wanted);
        }
    }

    #[test]
    fn a_garment_cut_anywhere_is_refused_with_the_field_that_is_missing() {
        let mut bytes = [0; 2048];
        let bytes = postcard::to_slice(&full(), &mut bytes).unwrap();
        for end in 0..bytes.len() {
            let why = refused(&bytes[..end]);
            assert!(why.starts_with("garment: it ends within "), "{end}: {why}");
        }
        assert_eq!(refused(&bytes[..1]), "garment: it ends within name");
    }

    #[test]
    fn a_garment_of_too_many_panels_and_what_follows_it_are_refused() {
        let mut bytes = [0; 2048];
        let length = postcard::to_slice(&full(), &mut bytes).unwrap().len();
        assert_eq!(refused(&bytes[..length + 2]), "garment: bytes after its end: 2");
        let first = full().panels[0].name.clone();
        let at = bytes.windows(first.len()).position(|it| it == first.as_bytes()).unwrap();
        // The length of the name stands before it, and the number of panels before that.
        assert_eq!(usize::from(bytes[at - 2]), full().panels.len());
        bytes[at - 2] = 9;
        assert_eq!(refused(&bytes[..length]), "garment: 9 panels, and there is room for 8");
    }
}
