//! A hand on the garment of a simulated board: what somebody presses while it runs.

use crate::error::Result;
use crate::files::scripts;
use crate::sim::{Script, TOOLS, Tool, Touch, Trace};
use std::collections::{BTreeSet, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use taxel_core::garment::Layout;

/// Greatest force of a finger, N.
const MOST_N: f64 = 200.0;
/// Most fingers that press at a time.
const FINGERS: usize = 16;
/// Most orders of a hand that wait: the board takes them after each frame.
pub const HAND_ORDERS: usize = 256;
/// Most knots that are kept: half an hour of a hand that moves.
const KNOTS: usize = 100_000;
/// Most touches of scripts that are kept.
const TOUCHES: usize = 4096;

/// Presses the garment of one simulated board. Clones press the same one.
#[derive(Debug, Clone)]
pub struct Hand(Arc<HandParts>);

#[derive(Debug)]
struct HandParts {
    layout: Layout,
    desk: Mutex<Desk>,
}

/// State that the board's thread and the others share.
#[derive(Debug)]
struct Desk {
    orders: VecDeque<Order>,
    fingers: BTreeSet<u64>,
    /// Everything that has touched the garment since the board started, or what was drawn was forgotten.
    script: Script,
    knots: usize,
    playing: Option<String>,
}

/// Press of a finger.
#[derive(Debug, Clone, PartialEq)]
pub struct FingerPress {
    /// Number of the finger.
    pub finger: u64,
    /// Tool with which it presses.
    pub tool: Tool,
    /// Direction of the tool's length, degrees from +x towards +y.
    pub angle_deg: f64,
    /// Index of the panel.
    pub panel: usize,
    /// Centre, taxels of the panel.
    pub at: [f64; 2],
    /// Force, N.
    pub force_n: f64,
}

/// Order to the board's thread.
#[derive(Debug)]
pub(super) enum Order {
    /// With the name of the panel.
    Press(FingerPress, String),
    Release(u64),
    Play(Box<Script>),
    Again,
    Clear,
}

impl Hand {
    /// A hand on a garment that is touched as this script says.
    pub(super) fn new(script: Script, layout: Layout) -> Hand {
        let (orders, fingers) = (VecDeque::new(), BTreeSet::new());
        let desk = Desk { orders, fingers, script, knots: 0, playing: None };
        Hand(Arc::new(HandParts { layout, desk: Mutex::new(desk) }))
    }

    /// Locks the desk. A panic of another thread leaves it whole.
    fn lock(&self) -> MutexGuard<'_, Desk> {
        self.0.desk.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The tools that this garment is coarse enough for.
    pub fn tools(&self) -> impl Iterator<Item = Tool> + '_ {
        TOOLS.into_iter().filter(|tool| tool.fits(&self.0.layout))
    }

    /// Presses with a finger, or moves it. The centre is kept on the panel. Returns false, and does nothing, for a
    /// panel that the garment lacks, numbers that are none, a force outside 0 to 200 N, too many fingers, or a
    /// board that has not taken what it was sent before.
    pub fn press(&self, press: FingerPress) -> bool {
        let Some(area) = self.0.layout.areas().get(press.panel) else { return false };
        let numbers = [press.at[0], press.at[1], press.angle_deg];
        if !numbers.iter().all(|number| number.is_finite()) || !(0.0..=MOST_N).contains(&press.force_n) {
            return false;
        }
        let on = |at: f64, count: u16| {
            (at * 1000.0).round().clamp(-500.0, f64::from(count) * 1000.0 - 500.0) / 1000.0
        };
        let at = [on(press.at[0], area.columns), on(press.at[1], area.rows)];
        let press = FingerPress {
            at,
            angle_deg: press.angle_deg % 360.0,
            force_n: (press.force_n * 1000.0).round() / 1000.0,
            ..press
        };
        let mut desk = self.lock();
        if !desk.fingers.contains(&press.finger) && desk.fingers.len() >= FINGERS {
            return false;
        }
        let finger = press.finger;
        // The release of each finger has room.
        let is_full = desk.orders.len() + FINGERS >= HAND_ORDERS;
        let newest = desk.orders.iter_mut().rev().find(|order| match order {
            Order::Press(other, _) => other.finger == finger,
            Order::Release(other) => *other == finger,
            _ => false,
        });
        let panel = area.name.to_string();
        match newest {
            Some(Order::Press(other, of)) => (*other, *of) = (press, panel),
            _ if is_full => return false,
            _ => desk.orders.push_back(Order::Press(press, panel)),
        }
        desk.fingers.insert(finger);
        true
    }

    /// Lifts a finger.
    pub fn release(&self, finger: u64) {
        let mut desk = self.lock();
        if desk.fingers.remove(&finger) {
            desk.orders.push_back(Order::Release(finger));
        }
    }

    /// Plays a script of touches once, from now on. Its garment, and what it says of the sensors, have no effect.
    /// Error if a touch of it has no place on the garment.
    pub fn play(&self, script: Script) -> Result<()> {
        let script = scripts::fit(script, &self.0.layout)?;
        self.order(Order::Play(Box::new(script)));
        Ok(())
    }

    /// Plays again what was drawn.
    pub fn again(&self) {
        self.order(Order::Again);
    }

    /// Forgets what was drawn.
    pub fn clear(&self) {
        self.order(Order::Clear);
    }

    /// Queues an order; of each kind one waits at most.
    fn order(&self, order: Order) {
        let mut desk = self.lock();
        let kind = std::mem::discriminant(&order);
        if desk.orders.iter().all(|waiting| std::mem::discriminant(waiting) != kind) {
            desk.orders.push_back(order);
        }
    }

    /// Name of the script that plays.
    pub fn playing(&self) -> Option<String> {
        self.lock().playing.clone()
    }

    /// Number of touches that were drawn and are kept.
    pub fn touches(&self) -> usize {
        self.lock().script.traces.len()
    }

    /// The script that plays what has touched the garment since the board started, or since what was drawn was
    /// forgotten.
    pub fn script(&self) -> Script {
        let script = self.lock().script.clone();
        let drawn = script.traces.iter().filter_map(|trace| trace.path.last()).map(|[t, ..]| *t);
        let ends = script.touches.iter().map(Touch::end_s).chain(drawn);
        // A second is left for what is felt of the last touch.
        let duration_s = ends.fold(0.0, f64::max).ceil() + 1.0;
        let (name, title) = (String::new(), "what a hand has pressed".into());
        Script { name, title, description: String::new(), duration_s, ..script }
    }

    /// Number of orders that the board has not taken yet: [`HAND_ORDERS`] at most.
    pub fn waiting(&self) -> usize {
        self.lock().orders.len()
    }

    /// Takes the orders.
    pub(super) fn orders(&self) -> VecDeque<Order> {
        std::mem::take(&mut self.lock().orders)
    }

    /// Keeps a touch along a path that begins. Returns where; none if it is not kept.
    pub(super) fn keep(&self, trace: Trace) -> Option<usize> {
        let mut desk = self.lock();
        let is_room = desk.knots < KNOTS;
        is_room.then(|| {
            desk.knots += trace.path.len();
            desk.script.traces.push(trace);
            desk.script.traces.len() - 1
        })
    }

    /// Keeps the next knot of a path.
    pub(super) fn keep_knot(&self, at: usize, knot: [f64; 4]) {
        let mut desk = self.lock();
        if let Some(trace) = desk.script.traces.get_mut(at) {
            trace.path.push(knot);
            desk.knots += 1;
        }
    }

    /// Keeps what a script plays, whose times are those of the board.
    pub(super) fn keep_script(&self, script: &Script) {
        let mut desk = self.lock();
        desk.playing = Some(script.name.clone());
        if desk.script.traces.is_empty() {
            desk.script.touches.clear();
            desk.script.joints.clear();
        }
        if desk.script.touches.len() < TOUCHES {
            desk.script.touches.extend_from_slice(&script.touches);
            desk.script.joints.extend_from_slice(&script.joints);
        }
    }

    /// No script plays.
    pub(super) fn ended(&self) {
        self.lock().playing = None;
    }

    /// The paths that were drawn.
    pub(super) fn traces(&self) -> Vec<Trace> {
        self.lock().script.traces.clone()
    }

    /// Forgets everything that has touched the garment.
    pub(super) fn forget(&self) {
        let mut desk = self.lock();
        desk.knots = 0;
        desk.script.traces.clear();
        desk.script.touches.clear();
        desk.script.joints.clear();
    }
}
