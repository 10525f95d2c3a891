//! How a panel drifts, and when nobody can tell.

use super::factor::{Shift, Teacher};
use super::own::Own;
use super::rates::{BEYOND, CLUTTER, FASTEST, GAP_MS, HIDDEN, PAUSE_MS, TURN_US, UNSURE, counts, in_time};
use super::witness::{Said, Seen, WITNESSES};
use crate::format::Micros;

/// Turns after which the witnesses that stray are fetched back a little.
const FETCHED: u8 = 8;

/// How far the anchors of a panel are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// Baselines have been set since.
    None,
    /// They are put where the baselines are, in the turn under way.
    Begins,
    /// They stand.
    Runs,
}

/// What a row is to do in its turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Orders {
    /// What the baselines move by: the drift, and what it is expected to be in the middle of the time until the next
    /// turn.
    pub shift: Shift,
    /// What a code is expected to drift until the middle of that time, counts.
    pub lead: i32,
    pub teacher: Teacher,
    pub own: Own,
}

/// The drift of one panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Panel {
    /// Where the baseline of each witness would be if it had followed nothing but the panel.
    anchors: [u16; WITNESSES],
    phase: Phase,
    last: Micros,
    /// Drift that the witnesses have agreed on, counts towards pressure; it wraps at 2^16.
    drift: i32,
    /// What of it came last: the anchors move by that when they are asked next.
    moved: Shift,
    /// How far the middle witness had come; those that stray from it are fetched back in this turn, if in any.
    fetched: Option<i8>,
    turns: u8,
    /// How fast the drift has been in the last second, Q8 counts per second.
    rate: i32,
    /// And in the last ten.
    steady: i32,
    pub orders: Orders,
    /// How far the baseline under a touch may be wrong, Q8 counts.
    doubt: u32,
    /// How far off the strongest code under a touch is in this turn, and was since it began, counts.
    strongest: u16,
    peak: u16,
    pub unsure: bool,
}

impl Panel {
    pub const NONE: Panel = Panel {
        anchors: [0; WITNESSES],
        phase: Phase::None,
        last: Micros(0),
        drift: 0,
        moved: Shift::NONE,
        fetched: None,
        turns: 0,
        rate: 0,
        steady: 0,
        orders: Orders { shift: Shift::NONE, lead: 0, teacher: Teacher::NONE, own: Own::NONE },
        doubt: 0,
        strongest: 0,
        peak: 0,
        unsure: false,
    };

    /// Begins anew with the next turn; what is known of its taxels stays.
    pub fn forget(&mut self) {
        (self.phase, self.unsure) = (Phase::None, false);
    }

    /// Whether rows have anything to follow.
    pub fn runs(&self) -> bool {
        self.phase == Phase::Runs
    }

    /// A turn begins.
    pub fn begin(&mut self, floor: u16) {
        if self.phase == Phase::None {
            let teacher = self.orders.teacher.at_rest();
            *self = Panel { phase: Phase::Begins, ..Panel::NONE };
            self.orders.teacher = teacher;
            self.orders.own.renew(0, [0; 2], floor, 0);
        }
    }

    /// A touch leaves the strongest code of a row so far off, counts.
    pub fn felt(&mut self, strongest: u16) {
        self.strongest = self.strongest.max(strongest);
    }

    /// Hears a witness in the turn of its row.
    pub fn hear(&mut self, witness: usize, seen: &Seen, (floor, falling): (u16, bool), said: &mut Said) {
        let Some(anchor) = self.anchors.get_mut(witness) else { return };
        // As codes go up with pressure, so do these.
        let up = |value: i32| if falling { 0xffff - value } else { value };
        if self.phase != Phase::Runs {
            *anchor = up(seen.expected).clamp(0, 0xffff) as u16;
        }
        said.ask(seen.factor);
        let mut at = up(i32::from(*anchor)) + self.moved.of(seen.factor);
        let followed = seen.expected - at;
        // The baseline tells without noise how far it has drifted, but follows later: what the code is further off
        // than noise and a light touch leave it counts, too.
        let noise = i32::from(floor / 4);
        let displacement = followed + seen.off - seen.off.clamp(-noise, noise);
        if let Some(middle) = self.fetched
            && !seen.held
        {
            let astray = displacement - i32::from(middle);
            at += astray / 16 + astray.signum();
        }
        *anchor = up(at).clamp(0, 0xffff) as u16;
        // Of a contact's rectangle only what drift does not explain is touched.
        let own = &self.orders.own;
        if seen.held && !own.is_near(seen.off) {
            return;
        }
        said.show(seen.off, noise);
        if seen.off >= own.far() {
            said.clutter += 1;
            return;
        }
        said.spread.add(displacement);
        // More than that no touch leaves behind unfelt.
        let most = i32::from(floor) * 3 / 2;
        said.ahead += u8::from(followed > most);
        said.behind += u8::from(followed < -most);
    }

    /// Takes in what the witnesses have said: what the rows are to do in the next turn.
    pub fn decide(&mut self, said: &Said, now: Micros, touched: bool, floor: u16) {
        // Nobody knows when the first baselines were right: what codes are off by then tells no rate.
        let first = self.phase != Phase::Runs;
        let ms = if first { TURN_US / 1000 } else { now.millis_since(self.last).min(GAP_MS) };
        self.last = now;
        if self.phase == Phase::None {
            return;
        }
        self.phase = Phase::Runs;
        // Where a touch hides nearly all of a panel it is taken to go on as before.
        let hidden = said.is_hidden();
        let known = if self.rate.signum() == self.steady.signum() { self.steady } else { 0 };
        let wanted = if hidden {
            counts(known, ms)
        } else {
            said.agreed(i32::from(floor / 4), self.orders.teacher.is_fresh())
        };
        let most = counts(FASTEST as i32, ms).max(1);
        let step = wanted.clamp(-most, most);
        self.moved = Shift { from: self.drift, to: self.drift + step };
        self.drift += step;
        self.turns = if self.turns < FETCHED { self.turns + 1 } else { 1 };
        let fetches = self.turns == FETCHED && said.spread.count() > 0;
        self.fetched = fetches.then(|| said.spread.eighth(4) as i8);
        // After a pause a turn may follow the one before at once: that tells no rate.
        if !hidden && !first && 4_000 * ms >= TURN_US {
            let now = ((step * 1000) << 8).checked_div(ms as i32).unwrap_or(0);
            self.rate += (now - self.rate) / 3;
            self.steady += (now - self.steady) / 32;
        }
        // A witness was asked half of a turn ago in the mean; its row is visited a turn later than it was asked, and
        // stands for a turn from then on.
        let Orders { shift, lead, teacher, .. } = &mut self.orders;
        *shift = Shift { from: shift.to, to: self.drift + counts(self.rate, TURN_US * 3 / 2000) };
        *lead = counts(self.rate, TURN_US / 2000);
        let moves = shift.counts().unsigned_abs();
        teacher.renew(self.steady, moves, [said.above, said.below, said.asked]);
        let missed = (wanted - step).unsigned_abs() << 8;
        let unseen = self.unseen(touched, hidden, ms);
        let clutter = if 4 * u32::from(said.clutter) > said.asked.into() { in_time(CLUTTER, ms) } else { 0 };
        self.judge(touched, unseen + clutter + missed);
        let left = if touched && self.strongest > self.peak / 4 { 0 } else { self.doubt >> 8 };
        let steady = self.steady.unsigned_abs();
        // What turns back leaves codes far off while its rate is none.
        let rate = self.rate.unsigned_abs().max(steady);
        self.orders.own.renew(ms.min(PAUSE_MS), [rate, steady], floor, left);
        self.strongest = 0;
        self.wrap();
    }

    /// Keeps the counts small: factors times 2^16 counts are whole.
    fn wrap(&mut self) {
        let whole = self.orders.shift.to & !0xffff;
        self.drift -= whole;
        let Orders { shift, .. } = &mut self.orders;
        for counts in [&mut shift.from, &mut shift.to, &mut self.moved.from, &mut self.moved.to] {
            *counts -= whole;
        }
    }

    /// Drift that may have gone unseen in this turn, Q8 counts.
    fn unseen(&self, touched: bool, hidden: bool, ms: u32) -> u32 {
        let rate = self.rate.unsigned_abs();
        let Orders { shift, teacher, .. } = &self.orders;
        let drifted = if touched { shift.counts().unsigned_abs() * teacher.error() } else { 0 };
        let hides = if hidden { in_time((rate + self.steady.unsigned_abs()) / 2 + HIDDEN, ms) } else { 0 };
        drifted + hides + in_time(rate.saturating_sub(BEYOND), ms)
    }

    /// What may be wrong by now, given what this turn adds (Q8 counts).
    fn judge(&mut self, touched: bool, more: u32) {
        // What is left of it fades while nothing touches.
        let fading = if touched || more > 0 { 0 } else { self.doubt / 16 + 1 };
        self.doubt = self.doubt.saturating_add(more).saturating_sub(fading).min(0xff_ffff);
        self.peak = if touched { self.peak.max(self.strongest) } else { 0 };
        let most = UNSURE.max(u32::from(self.strongest) / 2);
        self.unsure = self.doubt >> 8 >= if self.unsure { most / 4 } else { most };
    }
}
