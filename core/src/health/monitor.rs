//! The monitor: watches the taxels group by group, and keeps the faulty ones.

use super::codes::Codes;
use super::inputs::InputCheck;
use super::judge::{Limits, Shown, Suspects, is_pressed};
use super::seen::Seen;
use super::taxel::TaxelHealth;
use super::walk::{TaxelSpot, Walk};
use super::watch::{FRAMES, Watch};
use crate::acquire::Plan;
use crate::garment::{Circuit, Layout};
use heapless::Vec;

/// Greatest travel that counts in the median: a code that travels further is touched.
const TOUCHED: u16 = 256;

/// Greatest number of faulty taxels that are remembered.
pub const FAULTY_TAXELS: usize = 128;
/// Greatest number of neighbours that may fail together. If more seem to, the cause is not the taxels, and
/// none is called faulty.
const FOUND: usize = 16;

/// A faulty taxel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FaultyTaxel {
    /// Number of the taxel.
    pub taxel: u16,
    /// Kind of fault.
    pub health: TaxelHealth,
    /// Gain from before it was found, Q4.12.
    pub gain: u16,
}

/// Taxels that were found to be faulty in a frame.
pub type FoundFaults = Vec<(u16, TaxelHealth), FOUND>;

/// The garment, and the part of it that is read.
struct ReadGarment<'a> {
    layout: &'a Layout,
    circuit: &'a Circuit,
    plan: &'a Plan,
}

impl ReadGarment<'_> {
    /// True if the panel of a taxel is read.
    fn is_read(&self, taxel: usize) -> bool {
        // Panels are numbered in the order of their taxels.
        let panel = self.layout.areas().iter().rposition(|area| usize::from(area.base) <= taxel);
        taxel < self.layout.taxels() && panel.is_some_and(|panel| self.plan.reads_panel(panel as u8))
    }
}

/// Health of the taxels of a garment.
#[derive(Debug, Clone)]
pub struct Monitor {
    /// Faulty taxels, in the order of their numbers.
    faulty: Vec<FaultyTaxel, FAULTY_TAXELS>,
    watch: Watch,
    /// Median travel of a code while it is watched, eighths of a count.
    usual: u16,
    /// True if too many neighbours seemed to be faulty, up to the group judged last.
    crowd: bool,
    /// Index of the faulty taxel that is checked next for recovery.
    asked: u8,
    inputs: InputCheck,
}

impl Monitor {
    /// State without findings.
    pub const fn new() -> Self {
        Monitor {
            faulty: Vec::new(),
            watch: Watch::new(),
            usual: 0,
            crowd: false,
            asked: 0,
            inputs: InputCheck::new(),
        }
    }

    /// Forgets all findings, and restarts the watch.
    pub fn reset(&mut self) {
        self.faulty.clear();
        self.again();
    }

    /// Restarts the watch; findings stay.
    pub fn again(&mut self) {
        self.watch.again();
        (self.usual, self.crowd) = (0, false);
    }

    /// Faulty taxels in the order of their numbers.
    pub fn faulty(&self) -> &[FaultyTaxel] {
        &self.faulty
    }

    /// Entry of a taxel, if it is faulty.
    pub fn faulty_mut(&mut self, taxel: usize) -> Option<&mut FaultyTaxel> {
        self.faulty.iter_mut().find(|faulty| usize::from(faulty.taxel) == taxel)
    }

    /// Health of a taxel.
    pub fn health(&self, taxel: usize) -> TaxelHealth {
        let faulty = self.faulty.iter().find(|faulty| usize::from(faulty.taxel) == taxel);
        faulty.map_or(TaxelHealth::Good, |faulty| faulty.health)
    }

    /// Adds a faulty taxel. Returns `false` if there are too many.
    pub fn add(&mut self, faulty: FaultyTaxel) -> bool {
        if self.faulty.push(faulty).is_err() {
            return false;
        }
        // Sorts it in by swaps, because `Vec::insert` has a panic path.
        for at in (1..self.faulty.len()).rev() {
            if let Some([a, b, ..]) = self.faulty.get_mut(at - 1..)
                && b.taxel < a.taxel
            {
                core::mem::swap(a, b);
            }
        }
        true
    }

    /// Checks one faulty taxel per call. Clears and returns it if it was called dead and responds to
    /// pressure, or was called shorted and rests: a needle had filled it alone.
    pub fn clear_fault(&mut self, circuit: &Circuit, shown: &Codes<'_>) -> Option<FaultyTaxel> {
        let faulty = self.faulty.get(usize::from(self.asked)).copied();
        self.asked = faulty.map_or(0, |_| self.asked + 1);
        let faulty =
            faulty.filter(|faulty| matches!(faulty.health, TaxelHealth::Dead | TaxelHealth::Shorted))?;
        let taxel = usize::from(faulty.taxel);
        let (code, rest) = shown.now.get(taxel).zip(shown.rest?.get(taxel))?;
        if is_pressed(code.0, *rest, circuit.falling()) != (faulty.health == TaxelHealth::Dead) {
            return None;
        }
        self.faulty.retain(|other| other.taxel != faulty.taxel);
        Some(faulty)
    }

    /// True if a converter input seems faulty in this frame.
    pub fn needs_retest(&mut self, circuit: &Circuit, plan: &Plan, shown: &Codes<'_>) -> bool {
        self.inputs.is_one_odd(circuit, plan, shown, self.usual / 8)
    }

    /// Takes a frame. Adds taxels that seem to be faulty to `found`; the caller passes them to
    /// [`Monitor::add`].
    pub fn watch(
        &mut self,
        layout: &Layout,
        circuit: &Circuit,
        plan: &Plan,
        shown: Codes<'_>,
        found: &mut FoundFaults,
    ) {
        if self.watch.take(shown.now, layout.taxels()) {
            self.judge(&ReadGarment { layout, circuit, plan }, shown, found);
        }
    }

    /// Judges the group that has been watched for long enough.
    fn judge(&mut self, garment: &ReadGarment<'_>, shown: Codes<'_>, found: &mut FoundFaults) {
        let Codes { now: codes, rest, full, touched } = shown;
        let (first, seen) = self.watch.group(FRAMES - 1);
        let seen = seen.get(..garment.layout.taxels().saturating_sub(first)).unwrap_or(seen);
        // The codes of a panel that is not read are no evidence.
        if garment.is_read(first) {
            self.usual = nearer(self.usual, seen);
        }
        // 8-bit codes repeat their upper bits in the lower ones, which hides their step.
        let step = step(seen).max(garment.plan.depth.step());
        let limits = Limits::of(self.usual / 8, step);
        let falling = garment.circuit.falling();
        let shown = Shown { codes, rest, full, falling, limits, touched };
        let bounded = self.suspect(garment, &shown, FRAMES - 1, found);
        if bounded.is_some() && found.is_empty() {
            self.crowd = false;
            return;
        }
        // A common cause may begin with the last taxels of this group, and end with the first ones of the
        // next.
        let mut next = FoundFaults::new();
        let apart = bounded.and_then(|()| self.suspect(garment, &shown, FRAMES - 2, &mut next));
        self.crowd |= apart.is_none() || found.len() + next.len() > FOUND;
        if self.crowd {
            found.clear();
        }
    }

    /// True if the codes of the taxels beside, above and below travelled less than half as far as its own: a
    /// touch or a shock would move them, too. One other noisy taxel is allowed among them if the code goes to
    /// both sides of that at rest.
    fn is_alone(&self, shown: &Shown<'_>, seen: &Seen, spot: &TaxelSpot<'_>) -> bool {
        let TaxelSpot { taxel, area, column, .. } = *spot;
        let columns = usize::from(area.columns);
        let left = (column > 0).then(|| taxel.wrapping_sub(1));
        let right = (column + 1 < area.columns).then_some(taxel + 1);
        let moved = [left, right, taxel.checked_sub(columns), Some(taxel + columns)]
            .into_iter()
            .filter_map(|taxel| self.watch.seen(taxel?))
            .filter(|beside| beside.travel() >= seen.travel() / 2);
        moved.count() <= usize::from(shown.is_around_rest(seen, taxel))
    }

    /// Finds the faulty taxels of a group; none if there are too many.
    fn suspect(
        &self,
        garment: &ReadGarment<'_>,
        shown: &Shown<'_>,
        age: usize,
        found: &mut FoundFaults,
    ) -> Option<()> {
        let (first, seen) = self.watch.group(age);
        let Suspects { mut odd, mut beside } = shown.suspects(first, seen);
        let mut walk = Walk::new(garment.layout);
        let mut taxel = first;
        while odd | beside != 0 && taxel < garment.layout.taxels() {
            if (odd | beside) & 1 == 1
                && let Some((seen, spot)) = seen.get(taxel - first).zip(walk.to(taxel))
                && (odd & 1 == 1 || !shown.is_bare(&spot, self.faulty.len()))
                && let Some(health) = self.fault(garment, shown, seen, &spot)
            {
                found.push((taxel as u16, health)).ok()?;
            }
            (odd, beside) = (odd >> 1, beside >> 1);
            taxel += 1;
        }
        Some(())
    }

    /// Returns the fault of a taxel that was not known to be faulty. A taxel that is absent or not read has
    /// none.
    #[inline(never)]
    fn fault(
        &self,
        garment: &ReadGarment<'_>,
        shown: &Shown<'_>,
        seen: &Seen,
        spot: &TaxelSpot<'_>,
    ) -> Option<TaxelHealth> {
        let ReadGarment { layout, circuit, plan } = *garment;
        let TaxelSpot { taxel, panel, row, column, .. } = *spot;
        if !plan.reads_panel(panel) {
            return None;
        }
        let is_faulty = |taxel| self.health(taxel) != TaxelHealth::Good;
        let health = shown.judge(seen, spot, is_faulty);
        let faulty = health != TaxelHealth::Good
            && (health != TaxelHealth::Noisy || self.is_alone(shown, seen, spot))
            && !is_faulty(taxel)
            && !layout.is_absent(panel, row, column)
            && circuit.wired(taxel).is_some_and(|(block, ..)| plan.reads(panel, block));
        faulty.then_some(health)
    }
}

impl Default for Monitor {
    fn default() -> Self {
        Monitor::new()
    }
}

/// Moves the median travel a step towards the travels of a group; the first group sets it.
fn nearer(usual: u16, seen: &[Seen]) -> u16 {
    let travels = || seen.iter().map(|seen| seen.travel().min(TOUCHED));
    let count = seen.len() as u16;
    if usual == 0 {
        return (travels().sum::<u16>() * 8).checked_div(count).unwrap_or(0);
    }
    let above = travels().filter(|travel| *travel > usual / 8).count() as u16;
    let step = 1 + usual / 128;
    (usual + step * above).saturating_sub(step * (count - above))
}

/// Greatest power of two that divides all codes: 16 where a converter gives 8 bits of 12.
fn step(watched: &[Seen]) -> u16 {
    let bits = watched.iter().fold(0, |bits, seen| bits | seen.bits());
    (bits & bits.wrapping_neg()).max(1)
}
