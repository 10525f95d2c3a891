//! State of a track beside its public record, and the update of motion.

use super::point::{PanelPoint, nearest_way};
use super::slip::{SLIP_STEPS, Slip, Way};
use crate::format::{Fixed16, Inverse, Micros, signed_wide};
use crate::garment::{Area, Layout, Transform};
use crate::measure::component::Component;
use crate::measure::contact::Contact;
use crate::segment::config::ContactConfig;

/// State of a track beside its [`Contact`].
#[derive(Debug, Clone)]
pub(crate) struct Trail {
    /// Index of its component in this frame, or [`NONE`](crate::segment::union_find::NONE).
    pub component: u16,
    /// True if it has merged or split in this frame: the jump of its centroid is no motion.
    pub leaps: bool,
    /// Greatest total at which its form was measured.
    pub looked: u32,
    /// Frames since its form was measured; saturates at 255.
    pub age: u8,
    slip: Slip,
}

/// Per-frame inputs shared by all tracks.
pub(crate) struct TrackInputs<'a> {
    pub config: &'a ContactConfig,
    pub layout: &'a Layout,
    pub pace: VelocityFilter,
}

impl Trail {
    pub const fn new(component: u16) -> Self {
        Trail { component, leaps: false, looked: 0, age: 0, slip: Slip::new() }
    }

    /// Updates displacement, velocity and slip from the contact's component; the other measures follow later.
    #[inline(never)] // own frame: locals stay within short SP offsets
    pub fn follow(&mut self, contact: &mut Contact, component: &Component, inputs: &TrackInputs) {
        let TrackInputs { config, layout, pace } = inputs;
        let from = PanelPoint::of(contact.panel, contact.x, contact.y);
        let to = PanelPoint::of(component.bounds.panel, component.x, component.y);
        if let Some((Some(way), _)) = nearest_way(layout, from, to) {
            carry(contact, &way);
        }
        let step = [component.x.0.saturating_sub(contact.x.0), component.y.0.saturating_sub(contact.y.0)];
        // Motion leaves the pressure as it is. A quarter more or less at once moves the centroid for another
        // reason.
        let change = component.total.abs_diff(contact.total);
        let step = if self.leaps || change > contact.total / 4 { [0; 2] } else { step };
        let area = layout.areas().get(usize::from(component.bounds.panel));
        self.leaps = false;
        contact.dx = Fixed16(contact.dx.0.saturating_add(step[0]));
        contact.dy = Fixed16(contact.dy.0.saturating_add(step[1]));
        contact.vx = pace.velocity(contact.vx, step[0]);
        contact.vy = pace.velocity(contact.vy, step[1]);
        // If the pressure changes by more than a sixteenth, the outline changes too and moves the centroid.
        let sliding = if change > contact.total / 16 { [0; 2] } else { step };
        let slides = |area| config.slips() && self.slips(contact, sliding, area, inputs);
        contact.slip = area.is_some_and(slides);
    }

    /// Returns true during a slip: it begins with three steps, and lasts as long as the contact is fast.
    fn slips(&mut self, contact: &Contact, step: Way, area: &Area, inputs: &TrackInputs) -> bool {
        let is_fast = || {
            let least = u64::from(area.taxels(inputs.config.slip_speed.into())).pow(2);
            let square = |v: Fixed16| u64::from(v.0.unsigned_abs() >> 12).pow(2);
            square(contact.vx) + square(contact.vy) >= least
        };
        let limit = area.taxels(inputs.pace.limit.min(LONGEST_WAY));
        self.slip.begins(step, limit) || (contact.slip && is_fast())
    }
}

/// Transforms position, displacement and velocity of a contact to another panel.
fn carry(contact: &mut Contact, way: &Transform) {
    let carried = |x: &mut Fixed16, y: &mut Fixed16, one| {
        let moved = way.apply(x.0.into(), y.0.into(), one);
        (*x, *y) = (Fixed16::saturating(moved.0), Fixed16::saturating(moved.1));
    };
    carried(&mut contact.x, &mut contact.y, 1 << 16);
    carried(&mut contact.dx, &mut contact.dy, 0);
    carried(&mut contact.vx, &mut contact.vy, 0);
}

/// Coefficients of the velocity filter in this frame, and the limit of a slip.
pub(crate) struct VelocityFilter {
    /// Time constant, us; below 2^26.
    tau: u32,
    /// Inverse of `tau` plus the time since the last frame; none if no time has passed.
    inverse: Option<Inverse>,
    /// Distance at slip speed during [`SLIP_STEPS`] steps, in 2^-12 cm.
    limit: u32,
}

/// Upper bound of that distance: 16 cm, in 2^-12 cm. Its product with the taxels in 10 mm fits in 32 bits.
const LONGEST_WAY: u32 = 16 << 12;

/// Times of the last frames.
#[derive(Debug, Clone)]
pub(crate) struct FrameTimes([Micros; SLIP_STEPS]);

impl FrameTimes {
    pub const fn new() -> Self {
        FrameTimes([Micros(0); SLIP_STEPS])
    }

    /// Time of the last frame.
    pub const fn last(&self) -> Micros {
        self.0[0]
    }

    /// Takes the time of a new frame, and derives its coefficients.
    pub fn tick(&mut self, config: &ContactConfig, now: Micros) -> VelocityFilter {
        let [last, second, third] = self.0;
        self.0 = [now, last, second];
        let elapsed = now.since(last);
        let tau = u32::from(config.smoothing_ms) * 1000;
        let inverse = (elapsed > 0).then(|| Inverse::of(tau + elapsed.min(1 << 31) as u32));
        // 16 + 32 + 8 bits; 256 = 2^12 / 16.
        let way = u64::from(config.slip_speed) * now.since(third).min(u32::MAX.into()) * 256;
        VelocityFilter { tau, inverse, limit: Inverse::of(1_000_000).quotient(way) }
    }
}

impl VelocityFilter {
    /// `v + (step / dt - v) dt / (tau + dt)` as `(v tau + step) / (tau + dt)`: a first-order low pass over
    /// the real time between the frames.
    fn velocity(&self, v: Fixed16, step: i32) -> Fixed16 {
        match self.inverse {
            // 32 + 26 bits and 32 + 20 bits: no overflow.
            Some(inverse) => {
                Fixed16(inverse.nearest(signed_wide(v.0, self.tau) + signed_wide(step, 1_000_000)))
            }
            None => v,
        }
    }
}
