//! What a page asks of the player of a recording.

use serde::Deserialize;

/// Images that are stepped at a time, at most.
const STEPS: i32 = 1000;

/// An order.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Order {
    /// Play, or stand still.
    Play(bool),
    /// Show this time, s.
    Seek(f64),
    /// So many times as fast as it was.
    Speed(f64),
    /// Begin again at the end of the range.
    Loop(bool),
    /// Play from here to there, s; none: all of it.
    Range(Option<[f64; 2]>),
    /// So many images further, or back; then stand still.
    Step(i32),
}

impl Order {
    /// Whether it can be obeyed: times and speeds are numbers, no speed is 0 or less.
    pub fn is_sound(&self) -> bool {
        match self {
            Order::Seek(seconds) => seconds.is_finite(),
            Order::Speed(speed) => speed.is_finite() && *speed > 0.0,
            Order::Range(Some(ends)) => ends.iter().all(|end| end.is_finite()),
            Order::Step(images) => (1..=STEPS).contains(&images.saturating_abs()),
            Order::Play(_) | Order::Loop(_) | Order::Range(None) => true,
        }
    }

    /// Whether this one, coming after another that still waits, makes that one needless.
    pub fn replaces(&self, waiting: &Order) -> bool {
        let places = |order: &Order| matches!(order, Order::Seek(_));
        let ends = |order: &Order| matches!(order, Order::Range(_));
        (places(self) && places(waiting)) || (ends(self) && ends(waiting))
    }
}
