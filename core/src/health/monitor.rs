//! Watches the taxels, some at a time.

use super::inputs::Inputs;
use super::judge::{Doubtful, Limits, Shown, is_pressed};
use super::seen::Seen;
use super::taxel::TaxelHealth;
use super::walk::{Spot, Walk};
use super::watch::{FRAMES, Watch};
use crate::acquire::Plan;
use crate::format::Code;
use crate::garment::{Circuit, Layout};
use heapless::Vec;

/// A code that travels further is touched, and tells as much of the usual noise as one that travels so far.
const TOUCHED: u16 = 256;

/// Most ill taxels that are remembered.
pub const ILL: usize = 128;
/// Most neighbours that fall ill together. Where more seem to, it is not the taxels that are: none is called
/// so.
const FOUND: usize = 16;

/// A taxel that is ill.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IllTaxel {
    /// Its number.
    pub taxel: u16,
    /// What is wrong with it.
    pub health: TaxelHealth,
    /// Its gain when it is well, Q4.12.
    pub gain: u16,
}

/// What a garment shows.
#[derive(Debug, Clone, Copy)]
pub struct Codes<'a> {
    /// The codes of a frame.
    pub now: &'a [Code],
    /// Codes at rest; none: not known.
    pub rest: Option<&'a [u16]>,
    /// The largest code there is.
    pub full: u16,
    /// Something touches the garment.
    pub touched: bool,
}

/// Taxels that were found to be ill in a frame.
pub type Found = Vec<(u16, TaxelHealth), FOUND>;

/// The garment, and what of it is read.
struct Worn<'a> {
    layout: &'a Layout,
    circuit: &'a Circuit,
    plan: &'a Plan,
}

impl Worn<'_> {
    /// Whether the panel of a taxel is read.
    fn is_read(&self, taxel: usize) -> bool {
        // The taxels of a panel follow those of the one before.
        let panel = self.layout.areas().iter().rposition(|area| usize::from(area.base) <= taxel);
        taxel < self.layout.taxels() && panel.is_some_and(|panel| self.plan.reads_panel(panel as u8))
    }
}

/// The health of a garment.
#[derive(Debug, Clone)]
pub struct Monitor {
    /// By number.
    ill: Vec<IllTaxel, ILL>,
    watch: Watch,
    /// How far the code of half of the taxels travels while it is watched, eighths.
    usual: u16,
    /// Too many neighbours seemed to be ill, up to the last one that was judged.
    crowd: bool,
    /// Which of the ill taxels is looked at next: does it answer?
    asked: u8,
    inputs: Inputs,
}

impl Monitor {
    /// Nothing is known against any taxel.
    pub const fn new() -> Self {
        Monitor {
            ill: Vec::new(),
            watch: Watch::new(),
            usual: 0,
            crowd: false,
            asked: 0,
            inputs: Inputs::new(),
        }
    }

    /// Forgets everything.
    pub fn reset(&mut self) {
        self.ill.clear();
        self.again();
    }

    /// Watches anew; what was found stays.
    pub fn again(&mut self) {
        self.watch.again();
        (self.usual, self.crowd) = (0, false);
    }

    /// The ill taxels by number.
    pub fn ill(&self) -> &[IllTaxel] {
        &self.ill
    }

    /// What is known of a taxel, if it is ill.
    pub fn ill_mut(&mut self, taxel: usize) -> Option<&mut IllTaxel> {
        self.ill.iter_mut().find(|ill| usize::from(ill.taxel) == taxel)
    }

    /// The class of a taxel.
    pub fn health(&self, taxel: usize) -> TaxelHealth {
        let ill = self.ill.iter().find(|ill| usize::from(ill.taxel) == taxel);
        ill.map_or(TaxelHealth::Good, |ill| ill.health)
    }

    /// Takes down that a taxel is ill. `false`: too many are.
    pub fn add(&mut self, ill: IllTaxel) -> bool {
        if self.ill.push(ill).is_err() {
            return false;
        }
        // Down to its place; the library's own insertion panics where there is none.
        for at in (1..self.ill.len()).rev() {
            if let Some([a, b, ..]) = self.ill.get_mut(at - 1..)
                && b.taxel < a.taxel
            {
                core::mem::swap(a, b);
            }
        }
        true
    }

    /// Looks at one of the ill taxels, and gives it back if it was called dead and answers to pressure, or if
    /// it was called shorted and rests: a needle had filled it alone.
    pub fn acquit(&mut self, circuit: &Circuit, shown: &Codes<'_>) -> Option<IllTaxel> {
        let ill = self.ill.get(usize::from(self.asked)).copied();
        self.asked = ill.map_or(0, |_| self.asked + 1);
        let ill = ill.filter(|ill| matches!(ill.health, TaxelHealth::Dead | TaxelHealth::Shorted))?;
        let taxel = usize::from(ill.taxel);
        let (code, rest) = shown.now.get(taxel).zip(shown.rest?.get(taxel))?;
        if is_pressed(code.0, *rest, circuit.falling()) != (ill.health == TaxelHealth::Dead) {
            return None;
        }
        self.ill.retain(|other| other.taxel != ill.taxel);
        Some(ill)
    }

    /// Whether something speaks against a converter input in this frame.
    pub fn doubts(&mut self, circuit: &Circuit, plan: &Plan, shown: &Codes<'_>) -> bool {
        self.inputs.is_one_odd(circuit, plan, shown, self.usual / 8)
    }

    /// Takes a frame; what seems to be ill is added to `found`, for the caller to [`Monitor::add`].
    pub fn watch(
        &mut self,
        layout: &Layout,
        circuit: &Circuit,
        plan: &Plan,
        shown: Codes<'_>,
        found: &mut Found,
    ) {
        if self.watch.take(shown.now, layout.taxels()) {
            self.judge(&Worn { layout, circuit, plan }, shown, found);
        }
    }

    /// Judges the group that has been seen for long enough.
    fn judge(&mut self, worn: &Worn<'_>, shown: Codes<'_>, found: &mut Found) {
        let Codes { now: codes, rest, full, touched } = shown;
        let (first, seen) = self.watch.group(FRAMES - 1);
        let seen = seen.get(..worn.layout.taxels().saturating_sub(first)).unwrap_or(seen);
        // What is not read tells nothing.
        if worn.is_read(first) {
            self.usual = nearer(self.usual, seen);
        }
        // Codes of 8 bits repeat their upper bits below: they do not show their step.
        let step = step(seen).max(worn.plan.depth.step());
        let limits = Limits::of(self.usual / 8, step);
        let falling = worn.circuit.falling();
        let shown = Shown { codes, rest, full, falling, limits, touched };
        let bounded = self.suspect(worn, &shown, FRAMES - 1, found);
        if bounded.is_some() && found.is_empty() {
            self.crowd = false;
            return;
        }
        // What makes many ill at once may begin with the last ones of these, and end with the first ones.
        let mut next = Found::new();
        let apart = bounded.and_then(|()| self.suspect(worn, &shown, FRAMES - 2, &mut next));
        self.crowd |= apart.is_none() || found.len() + next.len() > FOUND;
        if self.crowd {
            found.clear();
        }
    }

    /// Whether the codes of the taxels beside, above and below one travelled less than half as far as its
    /// own: what touches or shakes it would move them, too. Another noisy one may be among them where the
    /// code goes to both sides of that at rest.
    fn is_alone(&self, shown: &Shown<'_>, seen: &Seen, spot: &Spot<'_>) -> bool {
        let Spot { taxel, area, column, .. } = *spot;
        let columns = usize::from(area.columns);
        let left = (column > 0).then(|| taxel.wrapping_sub(1));
        let right = (column + 1 < area.columns).then_some(taxel + 1);
        let moved = [left, right, taxel.checked_sub(columns), Some(taxel + columns)]
            .into_iter()
            .filter_map(|taxel| self.watch.seen(taxel?))
            .filter(|beside| beside.travel() >= seen.travel() / 2);
        moved.count() <= usize::from(shown.is_around_rest(seen, taxel))
    }

    /// Finds what is to be said against the taxels of a group that is watched; none where that is too much.
    fn suspect(&self, worn: &Worn<'_>, shown: &Shown<'_>, age: usize, found: &mut Found) -> Option<()> {
        let (first, seen) = self.watch.group(age);
        let Doubtful { mut odd, mut beside } = shown.doubtful(first, seen);
        let mut walk = Walk::new(worn.layout);
        let mut taxel = first;
        while odd | beside != 0 && taxel < worn.layout.taxels() {
            if (odd | beside) & 1 == 1
                && let Some((seen, spot)) = seen.get(taxel - first).zip(walk.to(taxel))
                && (odd & 1 == 1 || !shown.is_bare(&spot, self.ill.len()))
                && let Some(health) = self.fault(worn, shown, seen, &spot)
            {
                found.push((taxel as u16, health)).ok()?;
            }
            (odd, beside) = (odd >> 1, beside >> 1);
            taxel += 1;
        }
        Some(())
    }

    /// What is to be said against a taxel that was not known to be ill. Whatever is not there, or not read,
    /// shows nothing.
    #[inline(never)]
    fn fault(&self, worn: &Worn<'_>, shown: &Shown<'_>, seen: &Seen, spot: &Spot<'_>) -> Option<TaxelHealth> {
        let Worn { layout, circuit, plan } = *worn;
        let Spot { taxel, panel, row, column, .. } = *spot;
        if !plan.reads_panel(panel) {
            return None;
        }
        let is_ill = |taxel| self.health(taxel) != TaxelHealth::Good;
        let health = shown.judge(seen, spot, is_ill);
        let ill = health != TaxelHealth::Good
            && (health != TaxelHealth::Noisy || self.is_alone(shown, seen, spot))
            && !is_ill(taxel)
            && !layout.is_absent(panel, row, column)
            && circuit.wired(taxel).is_some_and(|(block, ..)| plan.reads(panel, block));
        ill.then_some(health)
    }
}

impl Default for Monitor {
    fn default() -> Self {
        Monitor::new()
    }
}

/// A step towards how far the code of half of the taxels travels, from what some of them show; the first ones
/// tell it alone.
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

/// The power of two that all their codes are multiples of: 16 where a converter gives 8 bits of 12.
fn step(watched: &[Seen]) -> u16 {
    let bits = watched.iter().fold(0, |bits, seen| bits | seen.bits());
    (bits & bits.wrapping_neg()).max(1)
}
