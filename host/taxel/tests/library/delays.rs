//! Delays of links, us, drawn at random: what carries a request to the board, and the answer back.

use fastrand::Rng;

/// A kind of link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Link {
    /// The board reads between two stages of a frame, 0.1 to 5 ms late. The way back takes at least 0.8 ms,
    /// on average 0.3 ms more; in bursts, ten seconds of each half minute, on average 20 ms more, as behind
    /// images on a busy link. One answer in twenty is lost.
    Serial,
    /// Polled each millisecond, in both directions; the board is busy for up to 2 ms. Nothing is lost.
    Usb,
    /// A network: 0.2 ms there and 0.4 ms back at least, and on average 0.4 and 1.5 ms more; one answer in a
    /// hundred comes 100 ms late, one in fifty never.
    Network,
}

/// Draws the delays of a link.
#[derive(Debug, Clone)]
pub struct Delays {
    link: Link,
    rng: Rng,
}

impl Delays {
    /// Of a link, from this seed.
    pub fn of(link: Link, seed: u64) -> Delays {
        Delays { link, rng: Rng::with_seed(seed) }
    }

    /// From the request until the board reads it.
    pub fn there(&mut self) -> f64 {
        match self.link {
            Link::Serial => 100.0 + self.rng.f64() * 4_900.0,
            Link::Usb => self.rng.f64() * 1_000.0 + self.rng.f64() * 2_000.0,
            Link::Network => 200.0 + self.exponential(400.0),
        }
    }

    /// From reading to answering.
    pub fn on_board(&mut self) -> f64 {
        self.rng.f64() * 300.0
    }

    /// From the answer until it arrives; `now` is the time of the request.
    pub fn back(&mut self, now: f64) -> f64 {
        let in_burst = now % 30e6 < 10e6;
        match self.link {
            Link::Serial => 800.0 + self.exponential(if in_burst { 20_000.0 } else { 300.0 }),
            Link::Usb => 50.0 + self.rng.f64() * 1_000.0,
            Link::Network => {
                let late = if self.rng.u8(..100) == 0 { 100_000.0 } else { 0.0 };
                400.0 + self.exponential(1_500.0) + late
            }
        }
    }

    /// From the start of a frame of the bus until the board notices it, at most `late_us`: mostly soon.
    pub fn notice(&mut self, late_us: u16) -> f64 {
        f64::from(late_us) * self.rng.f64().powi(3)
    }

    /// True if an answer never comes.
    pub fn is_lost(&mut self) -> bool {
        match self.link {
            Link::Serial => self.rng.u8(..20) == 0,
            Link::Usb => false,
            Link::Network => self.rng.u8(..50) == 0,
        }
    }

    fn exponential(&mut self, mean: f64) -> f64 {
        -mean * (1.0 - self.rng.f64()).ln()
    }
}
