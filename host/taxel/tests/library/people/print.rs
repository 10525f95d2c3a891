//! Footprints as domes of pressure: palm and fingers of a hand, knuckles of a fist, a strap that bends.

use fastrand::Rng;

/// A dome of pressure: an ellipse over which it falls as `(1 - r^2)^power`.
#[derive(Debug, Clone, Copy)]
struct Dome {
    /// Centre in the touch's own frame, mm.
    at: [f64; 2],
    /// Half axes, mm.
    half: [f64; 2],
    power: f64,
    /// Share of the pressure.
    weight: f64,
    /// Delay of its landing after the first, s.
    late_s: f64,
}

/// Turned domes whose shares add up to the whole force.
#[derive(Debug, Clone)]
pub struct Print {
    domes: Vec<Dome>,
    turn: (f64, f64),
    whole: f64,
    /// Reach of all domes from the centre, mm.
    pub reach: f64,
}

impl Print {
    fn of(domes: Vec<Dome>, angle: f64) -> Print {
        let volume = |d: &Dome| d.weight * std::f64::consts::PI * d.half[0] * d.half[1] / (d.power + 1.0);
        let reach = |d: &Dome| d.at[0].hypot(d.at[1]) + d.half[0].max(d.half[1]);
        Print {
            whole: domes.iter().map(volume).sum(),
            reach: domes.iter().map(reach).fold(0.0, f64::max),
            turn: angle.sin_cos(),
            domes,
        }
    }

    /// A palm and four fingers of a hand of this size (1: 85 mm broad), randomly varied.
    pub fn hand(size: f64, angle: f64, rng: &mut Rng) -> Print {
        let dome = |x: f64, y: f64, a: f64, b: f64, weight: f64| Dome {
            at: [x * size, y * size],
            half: [a * size, b * size],
            power: 0.4,
            weight,
            late_s: 0.0,
        };
        let mut domes = vec![dome(0.0, -8.0, 42.0, 40.0, 1.0)];
        let fingers = 0.3 + 0.5 * rng.f64();
        for (index, length) in [28.0, 34.0, 32.0, 24.0].into_iter().enumerate() {
            domes.push(dome(-30.0 + 20.0 * index as f64, 24.0 + length, 9.0, length, fingers));
        }
        Print::of(domes, angle)
    }

    /// Some fingertips side by side.
    pub fn fingertips(count: u32, size: f64, angle: f64) -> Print {
        let tip = |index: u32| Dome {
            at: [f64::from(index) * 21.0 * size, 0.0],
            half: [8.0 * size, 10.0 * size],
            power: 0.6,
            weight: 1.0,
            late_s: 0.0,
        };
        Print::of((0..count).map(tip).collect(), angle)
    }

    /// Four knuckles and the area between them.
    pub fn fist(size: f64, angle: f64) -> Print {
        let knuckle = |index: u32| Dome {
            at: [(f64::from(index) - 1.5) * 21.0 * size, 0.0],
            half: [13.0 * size, 16.0 * size],
            power: 0.8,
            weight: 1.0,
            late_s: 0.0,
        };
        let between =
            Dome { at: [0.0, -14.0 * size], half: [38.0 * size, 20.0 * size], weight: 0.5, ..knuckle(0) };
        Print::of((0..4).map(knuckle).chain([between]).collect(), angle)
    }

    /// A strap that bends and lands from one end to the other.
    pub fn strap(length: f64, width: f64, angle: f64, lands_s: f64, rng: &mut Rng) -> Print {
        let bend = (rng.f64() - 0.5) * 0.2;
        let pieces = (length / (width * 0.6)).ceil().max(2.0);
        let piece = |index: u32| {
            let part = f64::from(index) / (pieces - 1.0) - 0.5;
            let along = part * (length - width);
            Dome {
                at: [along, bend * along * along / length],
                half: [width * 0.6, width * 0.5],
                power: 0.2,
                weight: 1.0,
                late_s: (part + 0.5) * lands_s,
            }
        };
        Print::of((0..pieces as u32).map(piece).collect(), angle)
    }

    /// Pressure at `x`, `y` mm from the centre, if `force` is the force (N) at a delay (s), N / mm^2.
    pub fn pressure(&self, x: f64, y: f64, force: impl Fn(f64) -> f64) -> f64 {
        let (sin, cos) = self.turn;
        let (u, v) = (x * cos + y * sin, y * cos - x * sin);
        let of = |dome: &Dome| {
            let r2 = ((u - dome.at[0]) / dome.half[0]).powi(2) + ((v - dome.at[1]) / dome.half[1]).powi(2);
            if r2 < 1.0 { dome.weight * (1.0 - r2).powf(dome.power) * force(dome.late_s) } else { 0.0 }
        };
        self.domes.iter().map(of).sum::<f64>() / self.whole
    }
}
