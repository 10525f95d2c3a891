//! A touch as a physical contact: a force over time on a moving footprint.

use super::footprint::Footprint;
use super::touch::Touch;
use super::trace::Knot;
use libm::cos;
use std::f64::consts::PI;
use std::sync::Arc;

/// A touch, prepared for evaluation.
#[derive(Debug, Clone)]
pub struct Contact {
    /// Distribution of its force.
    pub footprint: Arc<Footprint>,
    course: ContactCourse,
}

/// Place and force of a contact over time.
#[derive(Debug, Clone)]
enum ContactCourse {
    Scripted(Scripted),
    /// Along a path; the last knot lasts if the touch does.
    Drawn {
        path: Vec<Knot>,
        lasts: bool,
    },
}

/// A touch of a script.
#[derive(Debug, Clone)]
struct Scripted {
    centre: [f64; 2],
    velocity: [f64; 2],
    force_n: f64,
    levels: Vec<f64>,
    /// Index of the first of the greatest levels.
    peak: usize,
    hysteresis: f64,
    start_ns: u64,
    period_ns: u64,
    last: u64,
    /// Rise to a level; rise and hold of it; whole duration, ns.
    phases_ns: [u64; 3],
}

impl Contact {
    /// Contact of a valid touch on a panel with this pitch and taxels with this
    /// [hysteresis](super::Sensor::hysteresis).
    pub fn build(touch: &Touch, pitch_mm: [f64; 2], hysteresis: f64) -> Contact {
        let ns = |seconds: f64| (seconds * 1e9).round() as u64;
        let rise = ns(touch.rise_s);
        let hold = rise + ns(touch.hold_s);
        let once = hold * touch.levels.len() as u64 + ns(touch.fall_s);
        let peak = touch.levels.iter().enumerate().rev().max_by(|a, b| a.1.total_cmp(b.1));
        let course = ContactCourse::Scripted(Scripted {
            centre: touch.centre(pitch_mm),
            velocity: touch.velocity,
            force_n: touch.force_n,
            levels: touch.levels.clone(),
            peak: peak.map_or(0, |(index, _)| index),
            hysteresis,
            start_ns: ns(touch.start_s),
            period_ns: touch.period_s.map_or(once, ns).max(once).max(1),
            last: u64::from(touch.repeat.max(1) - 1),
            phases_ns: [rise, hold, once],
        });
        let footprint = Footprint::build(touch.shape, touch.size(), touch.angle_deg, pitch_mm);
        Contact { footprint: Arc::new(footprint), course }
    }

    /// Contact along a path of ascending times. If it `lasts`, the place and the force of the last knot stay.
    pub fn drawn(footprint: Arc<Footprint>, path: Vec<Knot>, lasts: bool) -> Contact {
        Contact { footprint, course: ContactCourse::Drawn { path, lasts } }
    }

    /// First and last time of possible contact, ns.
    pub fn span_ns(&self) -> (u64, u64) {
        match &self.course {
            ContactCourse::Scripted(touch) => {
                (touch.start_ns, touch.start_ns + touch.last * touch.period_ns + touch.phases_ns[2])
            }
            ContactCourse::Drawn { path, lasts } => {
                let end = path.last().filter(|_| !lasts).map_or(u64::MAX, |knot| knot.t_ns);
                (path.first().map_or(u64::MAX, |knot| knot.t_ns), end)
            }
        }
    }

    /// Bounding box of the footprint's path: `[x_min, x_max, y_min, y_max]`, taxels of its panel.
    pub fn sweep(&self) -> [f64; 4] {
        let reach = self.footprint.reach();
        let [x, y] = [0, 1].map(|axis| {
            let [low, high] = self.course.extent(axis);
            [low - reach[axis], high + reach[axis]]
        });
        [x[0], x[1], y[0], y[1]]
    }

    /// Force on the taxel at `x`, `y` of the contact's panel at a time, N.
    pub fn newtons(&self, x: f32, y: f32, t_ns: u64) -> f32 {
        match &self.course {
            ContactCourse::Scripted(touch) => {
                let Some(phase_ns) = touch.phase(t_ns) else { return 0.0 };
                let t = phase_ns as f64 / 1e9;
                let dx = f64::from(x) - touch.centre[0] - touch.velocity[0] * t;
                let dy = f64::from(y) - touch.centre[1] - touch.velocity[1] * t;
                let share = self.footprint.share(dx as f32, dy as f32);
                if share == 0.0 { 0.0 } else { share * touch.force_n(phase_ns) as f32 }
            }
            ContactCourse::Drawn { path, .. } => {
                let Some(knot) = Knot::between(path, t_ns) else { return 0.0 };
                let share = self
                    .footprint
                    .share((f64::from(x) - knot.at[0]) as f32, (f64::from(y) - knot.at[1]) as f32);
                share * knot.force_n as f32
            }
        }
    }
}

impl ContactCourse {
    /// Least and greatest position of the centre along an axis, taxels.
    fn extent(&self, axis: usize) -> [f64; 2] {
        match self {
            ContactCourse::Scripted(touch) => {
                let way = touch.velocity[axis] * touch.phases_ns[2] as f64 / 1e9;
                [touch.centre[axis] + way.min(0.0), touch.centre[axis] + way.max(0.0)]
            }
            ContactCourse::Drawn { path, .. } => {
                let first = path.first().map_or(0.0, |knot| knot.at[axis]);
                path.iter()
                    .fold([first; 2], |[low, high], knot| [low.min(knot.at[axis]), high.max(knot.at[axis])])
            }
        }
    }
}

impl Scripted {
    /// Time since the onset of the current repetition; none between repetitions.
    fn phase(&self, t_ns: u64) -> Option<u64> {
        let since = t_ns.checked_sub(self.start_ns)?;
        let phase = if since < self.period_ns {
            since
        } else {
            since - (since / self.period_ns).min(self.last) * self.period_ns
        };
        (phase < self.phases_ns[2]).then_some(phase)
    }

    /// Total felt force at a time after the onset, N.
    fn force_n(&self, phase_ns: u64) -> f64 {
        let [rise, each, once] = self.phases_ns;
        let index = phase_ns.checked_div(each).unwrap_or(u64::MAX).min(self.levels.len() as u64) as usize;
        let into = phase_ns - index as u64 * each;
        let before = index.checked_sub(1).and_then(|index| self.levels.get(index)).copied().unwrap_or(0.0);
        let level = match self.levels.get(index) {
            Some(level) if into < rise => eased(before, *level, into, rise),
            Some(level) => *level,
            None => eased(before, 0.0, into, once - self.levels.len() as u64 * each),
        };
        let peak = self.levels.get(self.peak).copied().unwrap_or(1.0);
        let below = if peak > 0.0 { 1.0 - level / peak } else { 0.0 };
        let lag = if index > self.peak { 0.5 } else { -0.5 };
        self.force_n * level * (1.0 + lag * self.hysteresis * below)
    }
}

/// Interpolates by half a cosine.
fn eased(from: f64, to: f64, at_ns: u64, length_ns: u64) -> f64 {
    let part = if length_ns > 0 { at_ns as f64 / length_ns as f64 } else { 1.0 };
    from + (to - from) * (0.5 - 0.5 * cos(PI * part))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PITCH: [f64; 2] = [12.0, 10.0];

    #[test]
    fn a_touch_repeats_rises_holds_and_falls() {
        let touch: Touch = toml::from_str(
            "panel = \"a\"\nshape = \"box\"\nforce_n = 8\nat = [0, 0]\nstart_s = 0.2\nrise_s = 0.1\nhold_s = 0.1\nfall_s = 0.2\nrepeat = 2\nperiod_s = 0.5",
        )
        .unwrap();
        let contact = Contact::build(&touch, PITCH, 0.0);
        let ContactCourse::Scripted(touch) = &contact.course else { panic!("scripted") };
        let force = |ms: u64| touch.phase(ms * 1_000_000).map(|p| (touch.force_n(p) * 1e6).round() / 1e6);
        for onset in [200, 700] {
            let at = |ms: u64| force(onset + ms);
            assert_eq!([at(0), at(50), at(100), at(199)], [Some(0.0), Some(4.0), Some(8.0), Some(8.0)]);
            assert_eq!([at(300), at(400), at(499)], [Some(4.0), None, None]);
        }
        assert_eq!([force(0), force(199), force(1200), force(99_999)], [None; 4]);
        assert_eq!(contact.span_ns(), (200_000_000, 1_100_000_000));
    }

    #[test]
    fn weights_are_put_on_and_taken_off_and_felt_with_a_lag() {
        let touch: Touch = toml::from_str(
            "panel = \"a\"\nshape = \"plate\"\nforce_n = 20\nat = [0, 0]\nstart_s = 0\nrise_s = 0.1\nhold_s = 0.9\nlevels = [0.1, 1, 0.1]",
        )
        .unwrap();
        let contact = Contact::build(&touch, PITCH, 0.04);
        let ContactCourse::Scripted(touch) = &contact.course else { panic!("scripted") };
        let force = |ms: u64| (touch.force_n(ms * 1_000_000) * 1e6).round() / 1e6;
        assert_eq!([force(500), force(1500), force(2500)], [2.0 * 0.982, 20.0, 2.0 * 1.018]);
        assert_eq!(contact.span_ns().1, 3_050_000_000);
        let shares: Vec<f32> = (-3..=3).map(|x| contact.footprint.share(x as f32 + 0.5, 0.5)).collect();
        assert_eq!(shares.iter().filter(|share| **share > 0.0).count(), 6);
    }
}
