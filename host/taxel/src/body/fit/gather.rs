//! Touches in a board's lists of contacts.

use taxel_core::body::Placed;
use taxel_core::format::Micros;

/// Time without a contact that ends a touch, us.
const PAUSE_US: u64 = 100_000;
/// Frames that make a touch; fewer are an impulse.
const FRAMES: usize = 3;
/// Frames that count of a touch, from its begin: ten seconds of the reference board.
const MOST: usize = 2048;
/// Share of a touch's greatest pressure from which its centroid counts.
const FIRM: f64 = 0.5;

/// A touch, from the first contact to the last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeltTouch {
    /// Number of the panel.
    pub panel: u8,
    /// Centroid in taxels of the panel, weighted by pressure: x the column, y the row.
    pub x: f64,
    /// See `x`.
    pub y: f64,
}

/// Makes touches of contacts. Of contacts at the same time, the strongest counts.
#[derive(Debug, Clone, Default)]
pub struct TouchGatherer {
    /// The strongest contact of each frame of the present touch, with its pressure.
    frames: Vec<(FeltTouch, f64)>,
    last: Option<Micros>,
}

impl TouchGatherer {
    /// Takes the contacts of a frame. Returns a touch that has ended before.
    pub fn frame(&mut self, time: Micros, contacts: &[Placed]) -> Option<FeltTouch> {
        let strongest = contacts.iter().map(|placed| &placed.contact).max_by_key(|contact| contact.total);
        // Some streams have no frames without contacts.
        let is_over = self.last.is_some_and(|last| time.0.saturating_sub(last.0) >= PAUSE_US);
        let ended = if is_over { self.ended() } else { None };
        if let Some(contact) = strongest {
            self.last = Some(time);
            if self.frames.len() < MOST {
                let felt = FeltTouch { panel: contact.panel, x: contact.x.to_f64(), y: contact.y.to_f64() };
                self.frames.push((felt, f64::from(contact.total)));
            }
        }
        ended
    }

    /// The touch that has not ended yet, at the end of a stream.
    pub fn ended(&mut self) -> Option<FeltTouch> {
        let frames = std::mem::take(&mut self.frames);
        self.last = None;
        let (firmest, most) = *frames.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let counts = |(felt, total): &&(FeltTouch, f64)| felt.panel == firmest.panel && *total >= FIRM * most;
        let firm: Vec<&(FeltTouch, f64)> = frames.iter().filter(counts).collect();
        let sum =
            |of: &dyn Fn(&FeltTouch) -> f64| firm.iter().map(|(felt, total)| of(felt) * total).sum::<f64>();
        let all = sum(&|_| 1.0);
        (frames.len() >= FRAMES && all > 0.0).then(|| FeltTouch {
            panel: firmest.panel,
            x: sum(&|felt| felt.x) / all,
            y: sum(&|felt| felt.y) / all,
        })
    }
}
