//! Orders of a page to the player of a recording.

use serde::Deserialize;

/// Most images of a step.
const STEPS: i32 = 1000;

/// An order.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Order {
    /// Play or pause.
    Play(bool),
    /// Jump to this time, s.
    Seek(f64),
    /// Multiple of the recorded speed.
    Speed(f64),
    /// Repeat the range.
    Loop(bool),
    /// Play from the first to the second time, s; none for all.
    Range(Option<[f64; 2]>),
    /// Step this many images, negative for back; then pause.
    Step(i32),
}

impl Order {
    /// True if the order is valid: times and speeds are finite, speeds are above 0.
    pub fn is_sound(&self) -> bool {
        match self {
            Order::Seek(seconds) => seconds.is_finite(),
            Order::Speed(speed) => speed.is_finite() && *speed > 0.0,
            Order::Range(Some(ends)) => ends.iter().all(|end| end.is_finite()),
            Order::Step(images) => (1..=STEPS).contains(&images.saturating_abs()),
            Order::Play(_) | Order::Loop(_) | Order::Range(None) => true,
        }
    }

    /// True if this order makes an earlier, waiting one unnecessary.
    pub fn replaces(&self, waiting: &Order) -> bool {
        let places = |order: &Order| matches!(order, Order::Seek(_));
        let ends = |order: &Order| matches!(order, Order::Range(_));
        (places(self) && places(waiting)) || (ends(self) && ends(waiting))
    }
}
