//! How the panels drift as a whole, and when nobody can tell.

use super::factor::{Shift, Teacher};
use super::own::Own;
use super::rates::{BEYOND, CLUTTER, GAP_MS, HIDDEN, PAUSE_MS, TURN_US, UNSURE, in_time};
use super::slices::panel_of;
use super::spread::Spread;
use super::terms::Terms;
use crate::format::{Code, Micros};
use crate::garment::{Area, PANELS};

/// Taxels of a panel that are asked.
const WITNESSES: usize = 32;
/// No panel drifts faster, Q8 counts per second.
const FASTEST: i32 = 128 << 8;
/// Visits after which those that stray are fetched back a little.
const FETCHED: u8 = 8;

/// What a panel shows when its turn comes.
pub(super) struct Shown<'a> {
    pub area: &'a Area,
    pub codes: &'a [Code],
    pub baseline: &'a [u16],
    pub gain: &'a [u16],
    pub factor: &'a [u8],
    pub terms: Terms,
    pub now: Micros,
    /// A contact is on the panel.
    pub touched: bool,
}

/// A taxel that is asked.
struct Witness {
    code: i32,
    rest: i32,
    factor: u8,
    /// A contact's rectangle covers it, or touches it.
    held: bool,
}

impl Shown<'_> {
    /// Those that are asked, in the order of their anchors; absent and dead ones, and those without a code, say nothing.
    fn witnesses(&self, held: impl Fn(usize) -> bool) -> impl Iterator<Item = Option<Witness>> {
        let (codes, baseline) = (panel_of(self.codes, self.area), panel_of(self.baseline, self.area));
        let (gain, factor) = (panel_of(self.gain, self.area), panel_of(self.factor, self.area));
        places(gain.len()).map(move |at| {
            gain.get(at).filter(|gain| **gain != 0)?;
            let (code, rest) = (codes.get(at)?.0.into(), (*baseline.get(at)?).into());
            Some(Witness { code, rest, factor: *factor.get(at)?, held: held(at) })
        })
    }

    /// Difference of two codes towards pressure.
    fn towards(&self, from: i32, to: i32) -> i32 {
        if self.terms.falling { from - to } else { to - from }
    }

    /// How far a witness has drifted beyond its anchor. Its baseline tells that without noise, but follows later: what the code is
    /// further off than noise and a light touch leave it counts, too.
    fn displacement(&self, anchor: u16, witness: &Witness, lead: Shift) -> i32 {
        let noise = i32::from(self.terms.floor / 4);
        let lead = lead.of(witness.factor);
        let off = self.towards(witness.rest, witness.code) + lead;
        self.towards(anchor.into(), witness.rest) - lead + off - off.clamp(-noise, noise)
    }
}

/// The drift of one panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Panel {
    /// Where the baseline of each witness would be if it had followed nothing but the panel.
    anchors: [u16; WITNESSES],
    begun: bool,
    last: Micros,
    /// Drift that the witnesses have agreed on, counts towards pressure; it wraps at 2^16.
    drift: i32,
    /// How fast it has been in the last second, Q8 counts per second.
    rate: i32,
    /// And in the last ten.
    steady: i32,
    /// What the baselines move by in this turn: the drift, and what it is expected to be in the middle of the next one.
    shift: Shift,
    /// What a code is expected to drift until the middle of the time for which its baseline stands.
    lead: Shift,
    teacher: Teacher,
    own: Own,
    visits: u8,
    /// How far the baseline under a touch may be wrong, Q8 counts.
    doubt: u32,
    /// How far off the strongest code under a touch is in this turn, and was since it began, counts.
    strongest: u16,
    peak: u16,
    unsure: bool,
}

impl Panel {
    const NONE: Panel = Panel {
        anchors: [0; WITNESSES],
        begun: false,
        last: Micros(0),
        drift: 0,
        rate: 0,
        steady: 0,
        shift: Shift::NONE,
        lead: Shift::NONE,
        teacher: Teacher::NONE,
        own: Own::NONE,
        visits: 0,
        doubt: 0,
        strongest: 0,
        peak: 0,
        unsure: false,
    };
}

impl Panel {
    /// Asks the witnesses, and says what the rows of the panel are to do until they are asked again.
    fn ask(&mut self, shown: &Shown<'_>, held: impl Fn(usize) -> bool) {
        if !self.begun {
            return self.begin(shown);
        }
        let ms = shown.now.millis_since(self.last).min(GAP_MS);
        self.last = shown.now;
        let said = self.hear(shown, &held);
        // Where a touch hides nearly all of a panel it is taken to go on as before.
        let hidden = 8 * said.spread.count() < said.asked;
        let known = if self.rate.signum() == self.steady.signum() { self.steady } else { 0 };
        let step = if hidden { counts(known, ms) } else { said.agreed(i32::from(shown.terms.floor / 4)) };
        self.fetch(shown, step, &said.spread, held);
        self.drift += step;
        // After a pause a turn may follow the one before at once: that tells no rate.
        if !hidden && 4_000 * ms >= TURN_US {
            let now = ((step * 1000) << 8).checked_div(ms as i32).unwrap_or(0).clamp(-FASTEST, FASTEST);
            self.rate += (now - self.rate) / 3;
            self.steady += (now - self.steady) / 32;
        }
        // A row is visited at the beginning of a turn or at its end, and stands until the next: in the mean a turn later.
        self.shift = Shift { from: self.shift.to, to: self.drift + counts(self.rate, TURN_US / 1000) };
        self.lead = Shift { from: 0, to: counts(self.rate, TURN_US / 2000) };
        self.wrap();
        let factors = shown.witnesses(|_| false).flatten().map(|witness| witness.factor);
        self.teacher.renew(self.steady, self.shift.counts().unsigned_abs(), factors);
        self.judge(shown.touched, hidden, 4 * said.clutter > said.asked, ms);
        let left = if shown.touched && self.strongest > self.peak / 4 { 0 } else { self.doubt >> 8 };
        let steady = self.steady.unsigned_abs();
        // What turns back leaves codes far off while its rate is none.
        let rate = self.rate.unsigned_abs().max(steady);
        self.own.renew(ms.min(PAUSE_MS), [rate, steady], shown.terms.floor, left);
        self.strongest = 0;
    }

    /// What the witnesses say that nothing touches.
    fn hear(&self, shown: &Shown<'_>, held: impl Fn(usize) -> bool) -> Said {
        let mut said =
            Said { spread: Spread::new(), off: Spread::new(), asked: 0, clutter: 0, ahead: 0, behind: 0 };
        // More than that no touch leaves behind unfelt.
        let most = i32::from(shown.terms.floor) * 3 / 2;
        for (anchor, witness) in self.anchors.iter().zip(shown.witnesses(held)) {
            let Some(witness) = witness else { continue };
            said.asked += 1;
            let lead = self.lead.of(witness.factor);
            let off = shown.towards(witness.rest, witness.code) + lead;
            // Of a contact's rectangle only what drift does not explain is touched.
            if witness.held && !self.own.is_near(off) {
                continue;
            }
            said.off.add(off);
            if off >= self.own.far() {
                said.clutter += 1;
                continue;
            }
            said.spread.add(shown.displacement(*anchor, &witness, self.lead));
            let followed = shown.towards((*anchor).into(), witness.rest) - lead;
            said.ahead += u32::from(followed > most);
            said.behind += u32::from(followed < -most);
        }
        said
    }

    fn begin(&mut self, shown: &Shown<'_>) {
        *self = Panel { teacher: self.teacher, begun: true, last: shown.now, ..Panel::NONE };
        for (anchor, witness) in self.anchors.iter_mut().zip(shown.witnesses(|_| false)) {
            *anchor = witness.map_or(0, |witness| witness.rest as u16);
        }
        self.teacher.renew(0, 0, core::iter::empty());
        self.own.renew(TURN_US / 1000, [0; 2], shown.terms.floor, 0);
    }

    /// Takes the anchors along with the panel, and fetches back some of those that stray from the middle one.
    fn fetch(&mut self, shown: &Shown<'_>, step: i32, spread: &Spread, held: impl Fn(usize) -> bool) {
        self.visits = if self.visits < FETCHED { self.visits + 1 } else { 1 };
        let fetches = self.visits == FETCHED && spread.count() > 0;
        if step == 0 && !fetches {
            return;
        }
        let middle = spread.eighth(4);
        let shift = Shift { from: self.drift, to: self.drift + step };
        for (anchor, witness) in self.anchors.iter_mut().zip(shown.witnesses(held)) {
            let Some(witness) = witness else { continue };
            let mut moved = shift.of(witness.factor);
            if fetches && !witness.held {
                let astray = shown.displacement(*anchor, &witness, self.lead) - middle;
                moved += astray / 16 + astray.signum();
            }
            let moved = if shown.terms.falling { -moved } else { moved };
            *anchor = (i32::from(*anchor) + moved).clamp(0, 0xffff) as u16;
        }
    }

    /// Keeps the counts small: factors times 2^16 counts are whole.
    fn wrap(&mut self) {
        let whole = self.shift.to & !0xffff;
        self.drift -= whole;
        self.shift.from -= whole;
        self.shift.to -= whole;
    }

    /// What may be wrong by now.
    fn judge(&mut self, touched: bool, hidden: bool, cluttered: bool, ms: u32) {
        let rate = self.rate.unsigned_abs();
        let drifted = if touched { self.shift.counts().unsigned_abs() * self.teacher.error() } else { 0 };
        let unseen = if hidden { in_time((rate + self.steady.unsigned_abs()) / 2 + HIDDEN, ms) } else { 0 };
        let clutter = if cluttered { in_time(CLUTTER, ms) } else { 0 };
        let more = drifted + unseen + clutter + in_time(rate.saturating_sub(BEYOND), ms);
        // What is left of it fades while nothing touches.
        let fading = if touched || more > 0 { 0 } else { self.doubt / 16 + 1 };
        self.doubt = self.doubt.saturating_add(more).saturating_sub(fading).min(0xff_ffff);
        self.peak = if touched { self.peak.max(self.strongest) } else { 0 };
        let most = UNSURE.max(u32::from(self.strongest) / 2);
        self.unsure = self.doubt >> 8 >= if self.unsure { most / 4 } else { most };
    }
}

/// What the witnesses of a panel say.
struct Said {
    /// How far those that nothing touches have drifted beyond their anchors.
    spread: Spread,
    /// How far off the codes of those are that no contact holds.
    off: Spread,
    /// How many witnesses there are.
    asked: u32,
    /// Those that are further off than drift leaves them, though no contact is there.
    clutter: u32,
    /// Those that have followed further than a touch could have gone unfelt, towards pressure and away from it.
    ahead: u32,
    behind: u32,
}

impl Said {
    /// How far the panel has drifted.
    fn agreed(&self, noise: i32) -> i32 {
        let far = i32::from(2 * self.ahead > self.spread.count())
            - i32::from(2 * self.behind > self.spread.count());
        let agreed = if 2 * self.off.count() > self.asked { self.off.unanimous(noise) } else { 0 };
        [agreed, self.spread.agreed(), far].into_iter().find(|step| *step != 0).unwrap_or(0)
    }
}

/// What a rate (Q8 counts per second) comes to in some time, whole counts, rounded towards 0.
fn counts(rate: i32, ms: u32) -> i32 {
    (in_time(rate.unsigned_abs(), ms) >> 8) as i32 * rate.signum()
}

/// The drift of all panels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Common([Panel; PANELS]);

/// What a row is to do.
#[derive(Debug, Clone, Copy)]
pub(super) struct Orders {
    pub shift: Shift,
    pub lead: Shift,
    pub teacher: Teacher,
    pub own: Own,
}

impl Common {
    pub const fn new() -> Self {
        Common([Panel::NONE; PANELS])
    }

    /// Begins anew, since baselines have been set; what is known of the taxels stays.
    pub fn forget(&mut self) {
        self.0.iter_mut().for_each(|panel| (panel.begun, panel.unsure) = (false, false));
    }

    /// Asks the witnesses of a panel, of which some are held by a contact (by their number in the panel).
    #[inline(never)] // M0+: out of line
    pub fn ask(&mut self, panel: u8, shown: &Shown<'_>, held: impl Fn(usize) -> bool) {
        if let Some(panel) = self.0.get_mut(usize::from(panel)) {
            panel.ask(shown, held);
        }
    }

    /// What the rows of a panel are to do; nothing until it was asked.
    pub fn orders(&self, panel: u8) -> Option<Orders> {
        let Panel { begun, shift, lead, teacher, own, .. } = *self.0.get(usize::from(panel))?;
        begun.then_some(Orders { shift, lead, teacher, own })
    }

    /// A touch on a panel leaves the strongest code of a row so far off, counts.
    pub fn felt(&mut self, panel: u8, strongest: u16) {
        if let Some(panel) = self.0.get_mut(usize::from(panel)) {
            panel.strongest = panel.strongest.max(strongest);
        }
    }

    /// A bit for each panel whose baseline is unsure.
    pub fn unsure(&self) -> u8 {
        let bits = self.0.iter().enumerate().map(|(panel, it)| u8::from(it.unsure) << panel);
        bits.fold(0, |all, bit| all | bit)
    }
}

/// Where the witnesses are in a panel of so many taxels: neither 2 nor 3 divides their distance, lest they stand in one column, or meet
/// what is wrong with each third.
fn places(taxels: usize) -> impl Iterator<Item = usize> {
    let odd = (taxels / WITNESSES) | 1;
    let stride = if odd.is_multiple_of(3) { odd + 2 } else { odd };
    (0..WITNESSES).scan(0, move |next, _| {
        let at = *next;
        *next += stride;
        while *next >= taxels.max(1) {
            *next -= taxels.max(1);
        }
        Some(at)
    })
}
