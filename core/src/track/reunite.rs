//! Keeps parts of one former contact together while no more than a taxel has opened between them: a hand that
//! lies on ribs, or an arm on a crease, keeps its id.

use super::slot::Slot;
use super::tracks::Tracks;
use crate::garment::{Layout, Place, Rect};
use crate::measure::component::Components;
use crate::segment::labeller::Labeller;
use crate::segment::run::Run;
use crate::segment::union_find::NONE;

/// Adds each unassigned component to the component of the contact that it has just come off: it peaks
/// where that contact was, and hardly a gap has opened.
#[inline(never)] // own frame: locals stay within short SP offsets
pub(crate) fn reunite<const CONTACTS: usize, const RUNS: usize, const LABELS: usize, S: Slot>(
    components: &mut Components<CONTACTS>,
    labeller: &mut Labeller<RUNS, LABELS>,
    layout: &Layout,
    tracks: &mut Tracks<CONTACTS, S>,
) {
    if tracks.trails.iter().filter(|trail| trail.component != NONE).count() == components.list.len() {
        // The usual case: each component is assigned.
        return;
    }
    let known = tracks.known();
    // In descending order, because removal moves up the components behind.
    for lost in (0..components.list.len()).rev().filter(|index| known.get(*index) == Some(&false)) {
        let whole = whole_of(components, lost, labeller, layout, tracks);
        if let Some(whole) = whole {
            components.join(usize::from(whole), lost);
            labeller.renumber(whole, lost as u16);
            tracks.renumber(lost as u16);
        }
    }
}

/// Returns the component that `lost` belongs to, if hardly a gap separates it from a contact.
fn whole_of<const CONTACTS: usize, const RUNS: usize, const LABELS: usize, S: Slot>(
    components: &Components<CONTACTS>,
    lost: usize,
    labeller: &Labeller<RUNS, LABELS>,
    layout: &Layout,
    tracks: &Tracks<CONTACTS, S>,
) -> Option<u16> {
    let part = components.list.get(lost)?;
    let whole = tracks.component_of(only_at(tracks.contacts(), part.peak_at?)?)?;
    let mut runs = part.runs(labeller, layout).map(|(_, run)| run);
    let near = are_near(&part.bounds, &components.list.get(usize::from(whole))?.bounds)
        && runs.any(|run| labeller.contact_of(run) == Some(lost as u16) && is_beside(labeller, run, whole));
    near.then_some(whole)
}

/// Index of the contact that covered a place, if only one did.
fn only_at(contacts: &[impl Slot], at: Place) -> Option<usize> {
    let mut there = contacts
        .iter()
        .enumerate()
        .filter(|(_, slot)| slot.contact().bounds.holds(at.panel, at.row, at.column, 0))
        .map(|(index, _)| index);
    let only = there.next()?;
    there.next().is_none().then_some(only)
}

/// True if at most a row and a column lie between two rectangles.
fn are_near(a: &Rect, b: &Rect) -> bool {
    let near = |a: [u16; 2], b: [u16; 2]| a[0].max(b[0]) <= a[1].min(b[1]).saturating_add(2);
    a.panel == b.panel
        && near([a.left, a.right], [b.left, b.right])
        && near([a.top, a.bottom], [b.top, b.bottom])
}

/// True if a run has a taxel at most two away from one of a component, in the same panel.
fn is_beside<const RUNS: usize, const LABELS: usize>(
    labeller: &Labeller<RUNS, LABELS>,
    run: &Run,
    component: u16,
) -> bool {
    let panel = |run: &Run| labeller.labels.get(usize::from(run.label)).map(|label| label.panel);
    let mut near = labeller.in_rows(run.row.saturating_sub(2), run.row.saturating_add(2));
    near.any(|(_, other)| {
        labeller.contact_of(other) == Some(component)
            && panel(other) == panel(run)
            && have_near_columns(run, other)
    })
}

/// True if some of their columns are at most two apart.
fn have_near_columns(a: &Run, b: &Run) -> bool {
    let first = a.column().min(b.column());
    let bits = |run: &Run| u64::from(run.taxels).checked_shl((run.column() - first).into());
    let (Some(a), Some(b)) = (bits(a), bits(b)) else { return false };
    (a | a << 1 | a << 2 | a >> 1 | a >> 2) & b != 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::segment::bits::WORD;
    use crate::segment::sums::RunSums;

    /// A run of one taxel.
    fn at(column: u16) -> Run {
        let taxels = 1 << (column % WORD);
        let (row, label, area, peak, sums) = (0, 0, 1, 1, RunSums::NONE);
        Run { taxels, row, label, left: column, right: column, area, peak, sums }
    }

    #[test]
    fn two_columns_are_near_and_three_are_not_wherever_they_lie() {
        for column in [0, 1, 31, 32, 40, 100, 1_000, 60_000] {
            for apart in 0..100 {
                let (a, b) = (at(column), at(column + apart));
                assert_eq!([have_near_columns(&a, &b), have_near_columns(&b, &a)], [apart <= 2; 2]);
            }
        }
    }
}
