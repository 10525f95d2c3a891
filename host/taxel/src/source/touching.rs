//! Touches on the garment of a simulated board while it runs: its script, round after round, and a hand.

use super::hand::{FingerPress, Hand, Order};
use crate::sim::{Joint, Knot, Script, SimHand, Trace};
use std::collections::{BTreeMap, VecDeque};

/// Time in which a touch follows the finger, ns: about that from one picture of a screen to the next.
const FOLLOW_NS: u64 = 16_000_000;
/// Time after which a script plays for a garment that nobody touches, ns.
const QUIET_NS: u64 = 10_000_000_000;

/// Most scripts that play at a time.
const SCRIPTS: usize = 8;
/// The board is sent a path that is played again this long before it begins, ns.
const AHEAD_NS: u64 = 50_000_000;

/// Number of rounds of a script.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rounds {
    /// Once.
    One,
    /// Again and again, from the start on.
    Many,
    /// Again and again, once nobody has touched the garment for a while.
    Later,
}

/// Plays orders on a board. All times are the board's.
pub(super) struct Touching<'a> {
    hand: &'a Hand,
    board: SimHand,
    script: &'a Script,
    rounds: Rounds,
    /// Numbers of the next touch and of the next trace.
    touches: u64,
    traces: u64,
    fingers: BTreeMap<u64, Finger>,
    /// Traces that are drawn again, by their beginning, ns.
    again: VecDeque<(u64, Trace)>,
    /// Ends of the scripts that play, ns.
    ends_ns: Vec<u64>,
    /// Time at which the next round may begin, ns.
    next_ns: u64,
}

/// A finger that presses.
struct Finger {
    number: u64,
    press: FingerPress,
    /// Place among what is kept.
    kept: Option<usize>,
    /// The last knots of its path, from one that is not in the future.
    path: Vec<Knot>,
}

impl<'a> Touching<'a> {
    /// On a board that starts, and plays `script` if it does so from the start on.
    pub fn new(hand: &'a Hand, board: SimHand, script: &'a Script, rounds: Rounds) -> Touching<'a> {
        hand.forget();
        let mut ends_ns = Vec::new();
        if rounds != Rounds::Later && !script.is_empty() {
            hand.keep_script(script);
            script.traces.iter().for_each(|trace| _ = hand.keep(trace.clone()));
            ends_ns.push(ns(script.duration_s));
        }
        let next_ns = if rounds == Rounds::Later { QUIET_NS } else { 0 };
        let (touches, traces) = (script.touches.len() as u64, script.traces.len() as u64);
        let (fingers, again) = (BTreeMap::new(), VecDeque::new());
        Touching { hand, board, script, rounds, touches, traces, fingers, again, ends_ns, next_ns }
    }

    /// Carries out what was ordered. Returns the movements of joints that begin.
    pub fn act(&mut self, now_ns: u64) -> Vec<Joint> {
        let mut joints = Vec::new();
        // A whole microsecond, so that a file says the same time in few digits.
        let from_ns = (now_ns / 1000 + 1) * 1000;
        for order in self.hand.orders() {
            match order {
                Order::Press(press, panel) => self.press(press, panel, now_ns, from_ns),
                Order::Release(finger) => self.release(finger, now_ns, from_ns),
                Order::Play(script) => {
                    joints.extend(self.play(&script, from_ns));
                    self.next_ns = self.next_ns.max(from_ns + ns(script.duration_s) + QUIET_NS);
                }
                Order::Again => self.again(from_ns),
                Order::Clear => {
                    self.fingers.values_mut().for_each(|finger| finger.kept = None);
                    self.hand.forget();
                }
            }
        }
        if !self.fingers.is_empty() {
            self.next_ns = now_ns + QUIET_NS;
        }
        self.draw_again(now_ns);
        let playing = self.ends_ns.len();
        self.ends_ns.retain(|end_ns| *end_ns > now_ns);
        if self.ends_ns.is_empty() && playing > 0 {
            self.hand.ended();
        }
        let is_due = self.ends_ns.is_empty() && now_ns >= self.next_ns && !self.script.is_empty();
        if self.rounds != Rounds::One && is_due {
            joints.extend(self.play(self.script, from_ns));
        }
        joints
    }

    fn press(&mut self, press: FingerPress, panel: String, now_ns: u64, from_ns: u64) {
        let id = press.finger;
        let same = |finger: &Finger| {
            (finger.press.panel, finger.press.tool) == (press.panel, press.tool)
                && finger.press.angle_deg == press.angle_deg
        };
        if !self.fingers.get(&id).is_none_or(same) {
            self.release(id, now_ns, from_ns);
        }
        if !self.fingers.contains_key(&id) {
            let first = Knot { t_ns: from_ns, at: press.at, force_n: 0.0 };
            let trace = Trace { path: vec![first.written()], ..press.tool.trace(&panel, press.angle_deg) };
            let kept = self.hand.keep(trace.clone());
            self.board.trace(self.traces, trace, true);
            let finger = Finger { number: self.traces, press: press.clone(), kept, path: vec![first] };
            self.traces += 1;
            self.fingers.insert(id, finger);
        }
        let Some(finger) = self.fingers.get_mut(&id) else { return };
        finger.press = press;
        let (at, force_n) = (finger.press.at, finger.press.force_n);
        finger.go(self.hand, at, force_n, now_ns, from_ns);
        self.board.draw(finger.number, finger.path.clone(), true);
    }

    fn release(&mut self, finger: u64, now_ns: u64, from_ns: u64) {
        let Some(mut finger) = self.fingers.remove(&finger) else { return };
        let at = finger.press.at;
        finger.go(self.hand, at, 0.0, now_ns, from_ns);
        self.board.draw(finger.number, finger.path, false);
    }

    /// Plays a script from a time on. Returns the movements of its joints.
    fn play(&mut self, script: &Script, from_ns: u64) -> Vec<Joint> {
        if self.ends_ns.len() >= SCRIPTS {
            return Vec::new();
        }
        let from_s = from_ns as f64 / 1e9;
        let mut now = script.clone();
        now.touches.iter_mut().for_each(|touch| touch.start_s += from_s);
        now.joints.iter_mut().for_each(|joint| joint.start_s += from_s);
        self.hand.keep_script(&now);
        for touch in now.touches {
            self.board.touch(self.touches, touch);
            self.touches += 1;
        }
        self.draw_later(now.traces, from_s);
        self.ends_ns.push(from_ns + ns(script.duration_s));
        now.joints
    }

    /// Plays what was drawn again.
    fn again(&mut self, from_ns: u64) {
        let traces = self.hand.traces();
        let starts = traces.iter().filter_map(|trace| trace.path.first()).map(|[t, ..]| *t);
        let first = starts.fold(f64::INFINITY, f64::min);
        let ends = traces.iter().filter_map(|trace| trace.path.last()).map(|[t, ..]| *t);
        let length = ns((ends.fold(first, f64::max) - first).max(0.0));
        self.next_ns = self.next_ns.max(from_ns + length + QUIET_NS);
        self.draw_later(traces, from_ns as f64 / 1e9 - first);
    }

    /// Draws paths later than they say, in place of what was drawn again before. It is not kept once more.
    fn draw_later(&mut self, traces: Vec<Trace>, later_s: f64) {
        let mut all: Vec<(u64, Trace)> = Vec::new();
        for mut trace in traces {
            trace.path.iter_mut().for_each(|[t, ..]| *t = ((*t + later_s) * 1e6).round() / 1e6);
            let Some([first_s, ..]) = trace.path.first() else { continue };
            all.push((ns(*first_s), trace));
        }
        all.sort_by_key(|(first_ns, _)| *first_ns);
        self.again = all.into();
    }

    /// Sends the board the paths that are about to begin.
    fn draw_again(&mut self, now_ns: u64) {
        while let Some((_, trace)) = self.again.pop_front_if(|(first_ns, _)| *first_ns <= now_ns + AHEAD_NS) {
            self.board.trace(self.traces, trace, false);
            self.traces += 1;
        }
    }
}

impl Finger {
    /// Goes to a place and a force, in a straight line, from a time on.
    fn go(&mut self, hand: &Hand, at: [f64; 2], force_n: f64, now_ns: u64, from_ns: u64) {
        let Some(last) = self.path.last().copied() else { return };
        let mut add = |knot: Knot| {
            self.path.push(knot);
            self.kept.iter().for_each(|kept| hand.keep_knot(*kept, knot.written()));
        };
        if last.t_ns < from_ns {
            add(Knot { t_ns: from_ns, ..last });
        }
        add(Knot { t_ns: (from_ns + FOLLOW_NS).max(last.t_ns + 1000), at, force_n });
        let past = self.path.partition_point(|knot| knot.t_ns <= now_ns).saturating_sub(1);
        self.path.drain(..past);
    }
}

fn ns(seconds: f64) -> u64 {
    (seconds * 1e9).round() as u64
}
