//! A touch of a board, carried on to a time between two of the board's scans.

use super::history::TouchHistory;
use super::plane::{PlanePoint, PlaneSide};
use super::seam_change::SeamChange;
use super::touched::BoardTouch;

/// A touch of a board as it was reported last.
#[derive(Debug, Clone, PartialEq)]
pub struct CarriedTouch {
    /// Number of the board.
    pub board: usize,
    /// What the board says of it, with what presses beyond seams.
    pub touch: BoardTouch,
    /// The host's time of that, us.
    pub host_us: u64,
    history: TouchHistory,
    /// Time between the board's scans, us: it is not carried further than that.
    interval_us: u64,
}

/// The box around a touch in the plane of a seam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneBox {
    /// First and last along the seam, taxels, borders included.
    pub along: [f64; 2],
    /// Distance from the line of the seam, mm; below 0 beyond it.
    pub away: f64,
    /// How far it was carried across the seam, mm.
    pub carried: f64,
}

impl PlaneBox {
    /// True if it lies beside a seam of this length, or at most `slack` taxels from its ends.
    pub fn is_along(&self, length: f64, slack: f64) -> bool {
        self.along[0] <= length - 0.5 + slack && self.along[1] >= -0.5 - slack
    }
}

impl CarriedTouch {
    /// A touch of a scan; `before` is the same one in an earlier scan, without which it was not there
    /// `interval_us` earlier.
    pub fn new(
        board: usize,
        touch: BoardTouch,
        host_us: u64,
        interval_us: u64,
        before: Option<CarriedTouch>,
    ) -> CarriedTouch {
        let mut history = before.map(|before| before.history).unwrap_or_default();
        if history.is_empty() && interval_us > 0 {
            history.push(host_us.saturating_sub(interval_us), BoardTouch { total: 0, ..touch.clone() });
        }
        history.push(host_us, touch.clone());
        CarriedTouch { board, touch, host_us, history, interval_us }
    }

    /// Makes in the scan at the host's time, us, the changes that lie at the touch, and takes them out.
    pub fn change(&mut self, host_us: u64, changes: &mut Vec<SeamChange>) {
        let changed = self.history.change(host_us, changes);
        if let Some(touch) = changed.filter(|_| host_us == self.host_us) {
            self.touch.clone_from(touch);
        }
    }

    /// The same, carried on for that long.
    pub fn lasting(self, interval_us: u64) -> CarriedTouch {
        CarriedTouch { interval_us, ..self }
    }

    /// Time between the board's scans, us.
    pub fn interval_us(&self) -> u64 {
        self.interval_us
    }

    /// Its age at a time of the host, us; below 0 if it is newer.
    pub fn age_us(&self, host_us: u64) -> i64 {
        host_us.wrapping_sub(self.host_us) as i64
    }

    /// Time of its newest scan until a time of the host, us; none if all are later.
    pub fn newest_until(&self, host_us: u64) -> Option<u64> {
        self.history.newest_until(host_us)
    }

    /// How far what is interpolated for a time of the host, us, may be off: see
    /// [`TouchHistory::interpolation_error`].
    pub fn interpolation_error(&self, host_us: u64) -> f64 {
        self.history.interpolation_error(host_us)
    }

    /// Time by which it is carried on, s.
    fn carried(&self, host_us: u64) -> f64 {
        let most = self.interval_us as i64;
        self.age_us(host_us).clamp(-most, most) as f64 / 1e6
    }

    /// Its total then, counts.
    pub fn total(&self, host_us: u64) -> f64 {
        match self.history.at(host_us) {
            Some(moment) => moment.total,
            None => (f64::from(self.touch.total) + self.history.rate() * self.carried(host_us)).max(0.0),
        }
    }

    /// Its centroid then, `[x, y]` in taxels of its panel.
    pub fn centroid(&self, host_us: u64) -> [f64; 2] {
        if let Some(moment) = self.history.at(host_us) {
            return moment.centroid;
        }
        let ([x, y], [right, down]) = (self.touch.centroid, self.moved(host_us));
        [x + right, y + down]
    }

    fn moved(&self, host_us: u64) -> [f64; 2] {
        self.touch.velocity.map(|speed| speed * self.carried(host_us))
    }

    /// The box around it then, in the plane of a seam of its panel.
    pub fn bounds(&self, side: &PlaneSide, host_us: u64) -> PlaneBox {
        let (bounds, [x, y]) = (self.touch.bounds, self.moved(host_us));
        let corner = |column: f64, row: f64| side.in_plane([column + x, row + y]);
        let (left, right) = (f64::from(bounds.left) - 0.5, f64::from(bounds.right) + 0.5);
        let (top, bottom) = (f64::from(bounds.top) - 0.5, f64::from(bounds.bottom) + 0.5);
        let [a, b]: [PlanePoint; 2] = [corner(left, top), corner(right, bottom)];
        let still = side.in_plane([left, top]);
        // Of a panel across the line, the other sign is inside.
        let away = if side.is_first() { -a.across.max(b.across) } else { a.across.min(b.across) };
        PlaneBox {
            along: [a.along.min(b.along), a.along.max(b.along)],
            away,
            carried: (a.across - still.across).abs(),
        }
    }
}
