//! Parts of one former contact stay one while no more than a taxel has opened between them: a hand that lies on ribs, or an arm on
//! a crease, keeps its name.

use super::component::{Component, Components};
use super::label::Labels;
use super::piece::Piece;
use super::record::Contact;
use crate::garment::{Layout, Rect};

impl<const CONTACTS: usize> Components<CONTACTS> {
    /// Makes one of those that were one contact, `contacts`, in the frame before, and that hardly came apart.
    #[inline(never)] // a stack frame of its own is near
    pub fn reunite<const RUNS: usize, const PARTS: usize>(
        &mut self,
        labels: &mut Labels<RUNS, PARTS>,
        layout: &Layout,
        contacts: &[Contact],
    ) {
        while let Some((first, second)) = self.parted(labels, layout, contacts) {
            let Some(lost) = self.list.get(second).cloned() else { return };
            if let Some(whole) = self.list.get_mut(first) {
                whole.absorb(&lost);
            }
            let mut index = 0;
            self.list.retain(|_| {
                index += 1;
                index - 1 != second
            });
            labels.renumber(first as u16, second as u16);
        }
    }

    /// The first two that are to be one.
    fn parted<const RUNS: usize, const PARTS: usize>(
        &self,
        labels: &Labels<RUNS, PARTS>,
        layout: &Layout,
        contacts: &[Contact],
    ) -> Option<(usize, usize)> {
        for (second, b) in self.list.iter().enumerate().skip(1) {
            let first = self.list.iter().take(second).enumerate().position(|(first, a)| {
                are_near(&a.bounds, &b.bounds)
                    && were_one(a, b, contacts)
                    && labels.are_beside(layout, (first as u16, a), second as u16)
            });
            if let Some(first) = first {
                return Some((first, second));
            }
        }
        None
    }
}

/// Whether two rectangles have at most a row and a column between them.
fn are_near(a: &Rect, b: &Rect) -> bool {
    let near = |a: [u16; 2], b: [u16; 2]| a[0].max(b[0]) <= a[1].min(b[1]).saturating_add(2);
    a.panel == b.panel
        && near([a.left, a.right], [b.left, b.right])
        && near([a.top, a.bottom], [b.top, b.bottom])
}

/// Whether both peaks lie where one contact was, and no other.
fn were_one(a: &Component, b: &Component, contacts: &[Contact]) -> bool {
    let (Some(a), Some(b)) = (a.peak_at, b.peak_at) else { return false };
    let holds = |contact: &Contact| [a, b].map(|at| contact.bounds.holds(at.panel, at.row, at.column, 0));
    let mut holding = contacts.iter().map(holds).filter(|held| held.contains(&true));
    holding.next() == Some([true; 2]) && holding.next().is_none()
}

impl<const RUNS: usize, const PARTS: usize> Labels<RUNS, PARTS> {
    /// Whether a taxel of component `a` is at most two from one of component `b`.
    fn are_beside(&self, layout: &Layout, (a, component): (u16, &Component), b: u16) -> bool {
        let panel = |piece: &Piece| self.parts.get(usize::from(piece.part)).map(|part| part.panel);
        component.pieces(self, layout).filter(|(_, piece)| self.contact_of(piece) == Some(a)).any(
            |(_, piece)| {
                let mut near = self.in_rows(piece.row.saturating_sub(2), piece.row.saturating_add(2));
                near.any(|(_, other)| {
                    self.contact_of(other) == Some(b)
                        && panel(other) == panel(piece)
                        && is_beside(piece, other)
                })
            },
        )
    }
}

/// Whether some of their columns are at most two apart.
fn is_beside(a: &Piece, b: &Piece) -> bool {
    let place =
        |piece: &Piece, first: u16| u64::from(piece.taxels).checked_shl((piece.column() - first).into());
    let first = a.column().min(b.column());
    let (Some(a), Some(b)) = (place(a, first), place(b, first)) else { return false };
    (a | a << 1 | a << 2 | a >> 1 | a >> 2) & b != 0
}
