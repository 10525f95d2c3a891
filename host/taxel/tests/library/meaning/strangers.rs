//! Twenty families of touches by an independent simulator: pressure that falls off with powers, logistic
//! edges of force, gamma pulses and waves, on another garment. It shares no code with the simulator's
//! scripts. It was written before the map, whose weights were then chosen with its results in view.
//!
//! A taxel samples the pressure at four points; it saturates, creeps and hums by its own laws. The garments
//! are the reference garment and a sheet of 27 columns with a pitch of 9 x 11 mm.

use crate::meaning::family::{Act, Expected, Family};
use fastrand::Rng;
use taxel_core::garment::{Garment, Layout};

/// The families, in the order of the table.
pub const FAMILIES: [Family; 20] = [
    Family { name: "hug", expected: Expected::Kind },
    Family { name: "handshake", expected: Expected::Kind },
    Family { name: "hearty pat", expected: Expected::Friendly },
    Family { name: "caress", expected: Expected::Kind },
    Family { name: "pat", expected: Expected::Kind },
    Family { name: "massage", expected: Expected::Friendly },
    Family { name: "leaning", expected: Expected::Friendly },
    Family { name: "tap", expected: Expected::Friendly },
    Family { name: "stroke by fingers", expected: Expected::Friendly },
    Family { name: "falls and lies", expected: Expected::Once },
    Family { name: "drops", expected: Expected::Nothing },
    Family { name: "breath", expected: Expected::Nothing },
    Family { name: "drift", expected: Expected::Nothing },
    Family { name: "stab", expected: Expected::Attack },
    Family { name: "poke", expected: Expected::Harmful },
    Family { name: "slap of 30 N", expected: Expected::Harmful },
    Family { name: "slap of 80 N", expected: Expected::Attack },
    Family { name: "punch", expected: Expected::Attack },
    Family { name: "lash", expected: Expected::Attack },
    Family { name: "push", expected: Expected::Harmful },
];

/// Begin of the first force, s.
const BEGIN_S: f64 = 0.9;

/// A patch of pressure that falls as `(1 - r^4)` from its centre to its edge.
struct Patch {
    /// Half axes, mm, and direction, radians.
    half: [f64; 2],
    angle: f64,
    /// Centre as shares of the panel, and its velocity, mm/s.
    at: [f64; 2],
    speed: [f64; 2],
    panel: usize,
    force: Force,
}

/// Force in newtons over seconds since its begin.
enum Force {
    /// Logistic edges: centre and width (s) of rise and fall, and a wave on top (share, Hz).
    Plateau { newtons: f64, up: [f64; 2], down: [f64; 2], wave: [f64; 2] },
    /// Pulses `(t/p)^2 exp(2 - 2 t/p)` at these begins.
    Pulses { newtons: f64, peak_s: f64, begins: Vec<f64> },
}

impl Force {
    fn at(&self, t: f64) -> f64 {
        let edge = |[middle, width]: [f64; 2]| 1.0 / (1.0 + (-(t - middle) / width).exp());
        match self {
            Force::Plateau { newtons, up, down, wave: [part, hz] } => {
                let wave = 1.0 - part * (0.5 - 0.5 * (std::f64::consts::TAU * hz * (t - up[0])).cos());
                newtons * edge(*up) * (1.0 - edge(*down)) * wave
            }
            Force::Pulses { newtons, peak_s, begins } => {
                let pulse = |begin: &f64| {
                    let x = ((t - begin) / peak_s).max(0.0);
                    x * x * (2.0 - 2.0 * x).exp()
                };
                newtons * begins.iter().map(pulse).sum::<f64>()
            }
        }
    }

    /// End, s.
    fn end_s(&self) -> f64 {
        match self {
            Force::Plateau { down: [middle, width], .. } => middle + 5.0 * width,
            Force::Pulses { peak_s, begins, .. } => begins.last().unwrap_or(&0.0) + 5.0 * peak_s,
        }
    }
}

/// Kind of taxels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Make {
    /// Equal, without memory.
    Even,
    /// Of unequal gain, with creep under load.
    Uneven,
}

/// Where a touch lands between the taxels, when between two frames, and in which noise: what nobody chooses.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct Landing {
    /// Shares of the pitch by which it lies farther along x and y.
    taxels: [f64; 2],
    /// Share of the frame period by which it begins later.
    frames: f64,
    /// Number of its noise.
    noise: usize,
}

impl Landing {
    /// Landing `number`, spread evenly over a taxel and a frame (an additive recurrence by the plastic ratio,
    /// and by the golden one); 0 leaves the touch as it is.
    pub fn nth(number: usize) -> Landing {
        let share = |step: f64| (number as f64 * step).fract();
        Landing { taxels: [share(0.7549), share(0.5698)], frames: share(0.6180), noise: number }
    }
}

/// Touch `number` of a family.
pub fn act(family: usize, number: u64) -> Act {
    let garment = if number.is_multiple_of(2) { Garment::reference() } else { sheet() };
    touch_on(family, number, (garment, Make::Uneven), None)
}

/// The touch on any garment, with this frame period (us).
pub fn touch_on(family: usize, number: u64, on: (Garment, Make), period_us: Option<u64>) -> Act {
    landed(family, number, on, period_us, Landing::default())
}

/// The touch on any garment, with this frame period (us), as it lands.
pub fn landed(
    family: usize,
    number: u64,
    (garment, make): (Garment, Make),
    period_us: Option<u64>,
    landing: Landing,
) -> Act {
    let mut rng = Rng::with_seed(0x5742_0000 ^ (family as u64) << 8 ^ number);
    let Family { name, .. } = FAMILIES[family];
    let patches = Stranger { rng: rng.fork() }.does(name);
    let note =
        patches.first().map(|patch| format!("half axes {:.0?} mm, {}", patch.half, announced(&patch.force)));
    let drift = if name == "drift" { 1.5 } else { 0.0 };
    let mut noise = rng.fork();
    let period_us = period_us.unwrap_or([5_128, 4_000, 12_500][rng.usize(..3)]);
    (0..landing.noise).for_each(|_| noise = rng.fork());
    let mut cloth = Cloth::new(&garment, make, drift, noise);
    cloth.landing = landing.taxels;
    let begin_s = BEGIN_S + landing.frames * period_us as f64 / 1e6;
    let end_s = begin_s + patches.iter().map(|patch| patch.force.end_s()).fold(0.0, f64::max);
    let codes = move |start_us: u64, codes: &mut [u16]| {
        cloth.scan(start_us as f64 / 1e6 - begin_s, &patches, codes);
    };
    Act {
        family: FAMILIES[family],
        span: ((begin_s * 1e6) as u64, (end_s * 1e6) as u64),
        period_us,
        garment,
        note: note.unwrap_or_default(),
        codes: Box::new(codes),
    }
}

fn announced(force: &Force) -> String {
    match force {
        Force::Plateau { newtons, up, wave, .. } => {
            format!("{newtons:.1} N, edge {:.0} ms, wave {wave:.1?}", 1e3 * up[1])
        }
        Force::Pulses { newtons, peak_s, begins } => {
            format!("{} pulses of {newtons:.1} N, {:.0} ms", begins.len(), 1e3 * peak_s)
        }
    }
}

/// A sheet of 27 columns.
pub fn sheet() -> Garment {
    let mut garment = Garment::recorded(40, 27);
    garment.panels[0].pitch_um = [9_000, 11_000];
    garment
}

/// A simulated toucher.
struct Stranger {
    rng: Rng,
}

impl Stranger {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.rng.f64()
    }

    fn patch(&mut self, half: [f64; 2], force: Force) -> Patch {
        Patch {
            half,
            angle: self.within(0.0, std::f64::consts::PI),
            at: [self.within(0.42, 0.58), self.within(0.38, 0.62)],
            speed: [0.0; 2],
            panel: self.rng.usize(..4),
            force,
        }
    }

    fn hand(&mut self, force: Force) -> Patch {
        let half = [self.within(44.0, 58.0), self.within(38.0, 48.0)];
        self.patch(half, force)
    }

    /// A plateau with edges of about `rise` and `fall` seconds.
    fn plateau(&mut self, newtons: [f64; 2], rise: [f64; 2], hold: [f64; 2]) -> Force {
        let (rise, hold) = (self.within(rise[0], rise[1]), self.within(hold[0], hold[1]));
        let fall = self.within(0.6, 1.2) * rise.max(0.06);
        let (up, down) = ([0.6 * rise, rise / 6.0], [1.1 * rise + hold, fall / 6.0]);
        Force::Plateau { newtons: self.within(newtons[0], newtons[1]), up, down, wave: [0.0, 1.0] }
    }

    fn pulses(&mut self, newtons: [f64; 2], peak_s: [f64; 2], count: usize, gap: [f64; 2]) -> Force {
        let (peak_s, mut begin) = (self.within(peak_s[0], peak_s[1]), 0.0);
        let begins = (0..count).map(|_| {
            let now = begin;
            begin += 4.0 * peak_s + self.within(gap[0], gap[1]);
            now
        });
        let begins = begins.collect();
        Force::Pulses { newtons: self.within(newtons[0], newtons[1]), peak_s, begins }
    }

    fn does(&mut self, name: &str) -> Vec<Patch> {
        match name {
            "hug" => {
                let arms = [[0.4, 0.3], [0.55, 0.62]].map(|at| {
                    let force = self.plateau([8.0, 45.0], [0.35, 0.9], [1.2, 3.0]);
                    Patch { at, angle: self.within(-0.3, 0.3), panel: 1, ..self.patch([80.0, 32.0], force) }
                });
                let breast = self.plateau([8.0, 40.0], [0.35, 0.9], [1.2, 3.0]);
                let breast = Patch { at: [0.5, 0.45], panel: 0, ..self.patch([75.0, 90.0], breast) };
                arms.into_iter().chain([breast]).collect()
            }
            "handshake" => {
                let mut force = self.plateau([12.0, 35.0], [0.2, 0.4], [1.2, 2.0]);
                if let Force::Plateau { wave, .. } = &mut force {
                    *wave = [self.within(0.35, 0.7), self.within(2.0, 4.0)];
                }
                vec![Patch { panel: 3, ..self.hand(force) }]
            }
            "hearty pat" => {
                let count = self.rng.usize(2..5);
                let force = self.pulses([15.0, 25.0], [0.04, 0.08], count, [0.05, 0.2]);
                vec![self.hand(force)]
            }
            "caress" => {
                let force = self.plateau([1.5, 6.0], [0.15, 0.3], [0.8, 1.6]);
                let (x, y) = (self.within(-15.0, 15.0), self.within(40.0, 80.0));
                vec![Patch { speed: [x, y], at: [0.5, 0.3], ..self.hand(force) }]
            }
            "pat" => {
                let count = self.rng.usize(1..5);
                let force = self.pulses([3.0, 12.0], [0.04, 0.09], count, [0.05, 0.2]);
                vec![self.hand(force)]
            }
            "massage" => {
                let mut force = self.plateau([8.0, 30.0], [0.4, 0.7], [2.5, 4.0]);
                if let Force::Plateau { wave, .. } = &mut force {
                    *wave = [self.within(0.5, 0.9), self.within(0.8, 1.6)];
                }
                let half = self.within(18.0, 40.0);
                vec![self.patch([half, 0.8 * half], force)]
            }
            "leaning" => {
                let force = self.plateau([20.0, 70.0], [0.7, 1.6], [2.0, 3.0]);
                vec![self.patch([90.0, 75.0], force)]
            }
            "tap" => {
                let count = self.rng.usize(1..5);
                let force = self.pulses([1.0, 4.5], [0.015, 0.04], count, [0.05, 0.2]);
                vec![self.patch([9.0, 8.0], force)]
            }
            "stroke by fingers" => {
                let mut tip = |x: f64| {
                    let force =
                        Force::Plateau { newtons: 1.8, up: [0.1, 0.03], down: [1.2, 0.03], wave: [0.2, 3.0] };
                    Patch { at: [x, 0.3], panel: 2, speed: [0.0, 90.0], ..self.patch([9.0, 9.0], force) }
                };
                vec![tip(0.4), tip(0.55)]
            }
            "falls and lies" => {
                let newtons = self.within(4.0, 25.0);
                let half = [self.within(25.0, 60.0), self.within(20.0, 50.0)];
                let rest = Force::Plateau { newtons, up: [0.02, 0.003], down: [4.0, 0.02], wave: [0.0, 1.0] };
                vec![self.patch(half, rest)]
            }
            "drops" => (0..8)
                .map(|index| {
                    let begins = vec![0.15 * f64::from(index)];
                    let force = Force::Pulses { newtons: self.within(0.1, 0.4), peak_s: 0.006, begins };
                    let at = [self.within(0.1, 0.9), self.within(0.1, 0.9)];
                    Patch { at, ..self.patch([6.0, 6.0], force) }
                })
                .collect(),
            "breath" => {
                let wave = [1.0, self.within(0.2, 0.4)];
                let newtons = self.within(1.0, 3.0);
                let force = Force::Plateau { newtons, up: [1.0, 0.2], down: [8.0, 0.3], wave };
                vec![Patch { panel: 0, ..self.patch([80.0, 120.0], force) }]
            }
            "drift" => {
                let nothing =
                    Force::Plateau { newtons: 0.0, up: [0.0, 0.1], down: [8.0, 0.1], wave: [0.0, 1.0] };
                vec![self.hand(nothing)]
            }
            "stab" => {
                let force = self.pulses([35.0, 80.0], [0.012, 0.03], 1, [0.0, 0.1]);
                vec![self.patch([9.0, 5.0], force)]
            }
            "poke" => {
                let force = self.plateau([18.0, 24.0], [0.05, 0.12], [0.05, 0.3]);
                vec![self.patch([8.5, 7.5], force)]
            }
            "slap of 30 N" => {
                let force = self.pulses([28.0, 34.0], [0.009, 0.018], 1, [0.0, 0.1]);
                vec![self.hand(force)]
            }
            "slap of 80 N" => {
                let force = self.pulses([70.0, 90.0], [0.009, 0.02], 1, [0.0, 0.1]);
                vec![self.hand(force)]
            }
            "punch" => {
                let force = self.pulses([50.0, 160.0], [0.01, 0.03], 1, [0.0, 0.1]);
                vec![self.patch([38.0, 28.0], force)]
            }
            "lash" => {
                let force = self.pulses([20.0, 60.0], [0.007, 0.015], 1, [0.0, 0.1]);
                let half = [self.within(75.0, 120.0), self.within(7.0, 14.0)];
                vec![Patch { angle: self.within(1.2, 1.9), ..self.patch(half, force) }]
            }
            "push" => {
                let force = self.plateau([45.0, 120.0], [0.12, 0.3], [0.2, 0.6]);
                vec![self.hand(force)]
            }
            other => unreachable!("{other} is no family"),
        }
    }
}

/// Taxels of unequal gain, which creep under a load and hum.
struct Cloth {
    panels: Vec<(usize, usize, usize, [f64; 2])>,
    rest: Vec<f64>,
    gain: Vec<f64>,
    creep: Vec<f64>,
    /// Share of a force by which a taxel creeps.
    memory: f64,
    drift: f64,
    /// Shares of the pitch by which every touch lies farther along x and y.
    landing: [f64; 2],
    newtons: Vec<f64>,
    rng: Rng,
    before_s: f64,
}

impl Cloth {
    fn new(garment: &Garment, make: Make, drift: f64, mut rng: Rng) -> Cloth {
        let layout = Layout::build(garment, 2048, 4095).expect("the garment is good");
        let mut first = 0;
        let panels = garment.panels.iter().map(|panel| {
            let (columns, rows) = (usize::from(panel.columns), usize::from(panel.rows));
            first += columns * rows;
            (first - columns * rows, columns, rows, panel.pitch_um.map(|um| f64::from(um) / 1e3))
        });
        let panels = panels.collect();
        let uneven = if make == Make::Uneven { 1.0 } else { 0.0 };
        let (count, spread) = (layout.taxels(), uneven * 0.2 * rng.f64());
        let mut many = |middle: f64, width: f64| -> Vec<f64> {
            (0..count).map(|_| middle + width * (rng.f64() - 0.5)).collect()
        };
        let (rest, gain, creep) = (many(110.0, 40.0), many(1.0, spread), vec![0.0; count]);
        Cloth {
            panels,
            rest,
            gain,
            creep,
            memory: uneven * 0.04,
            drift,
            landing: [0.0; 2],
            newtons: vec![0.0; count],
            rng,
            before_s: 0.0,
        }
    }

    /// Codes of a scan that starts `start_s` after the first force began, and takes 5 ms.
    fn scan(&mut self, start_s: f64, patches: &[Patch], codes: &mut [u16]) {
        self.newtons.fill(0.0);
        for patch in patches {
            self.press(patch, start_s);
        }
        let passed = (start_s - self.before_s).clamp(0.0, 0.1);
        self.before_s = start_s;
        for (index, code) in codes.iter_mut().enumerate().take(self.rest.len()) {
            let force = self.newtons[index];
            self.creep[index] += (self.memory * force - self.creep[index]) * passed / 0.8;
            self.rest[index] += self.drift * (0.5 + self.gain[index].fract()) * passed;
            let hum = 8.0 * (self.rng.f64() + self.rng.f64() - 1.0);
            let signal = 1000.0 * self.gain[index] * (force + self.creep[index]);
            *code = (self.rest[index] + signal + hum).round().clamp(0.0, 4095.0) as u16;
        }
    }

    fn press(&mut self, patch: &Patch, start_s: f64) {
        let (first, columns, rows, pitch) = self.panels[patch.panel % self.panels.len()];
        let side = [columns as f64 * pitch[0], rows as f64 * pitch[1]];
        let centre = [0, 1].map(|axis| {
            let way = self.landing[axis] * pitch[axis] + patch.speed[axis] * start_s.max(0.0);
            patch.at[axis] * side[axis] + way
        });
        // The integral of 1 - r^4 over the ellipse is two thirds of its area.
        let whole = std::f64::consts::PI * patch.half[0] * patch.half[1] * 2.0 / 3.0;
        let (sin, cos) = patch.angle.sin_cos();
        let reach = patch.half[0].max(patch.half[1]);
        for row in 0..rows {
            let force = patch.force.at(start_s + 0.005 * row as f64 / rows as f64);
            let y = (row as f64 + 0.5) * pitch[1] - centre[1];
            if force < 1e-4 || y.abs() > reach + pitch[1] {
                continue;
            }
            for column in 0..columns {
                let x = (column as f64 + 0.5) * pitch[0] - centre[0];
                let inside = (0..16).map(|point| {
                    let (i, j) = (f64::from(point % 4), f64::from(point / 4));
                    let (x, y) = (x + (i - 1.5) / 4.0 * pitch[0], y + (j - 1.5) / 4.0 * pitch[1]);
                    let (u, v) = ((x * cos + y * sin) / patch.half[0], (y * cos - x * sin) / patch.half[1]);
                    (1.0 - (u * u + v * v).powi(2)).max(0.0)
                });
                let share = inside.sum::<f64>() / 16.0 * pitch[0] * pitch[1] / whole;
                self.newtons[first + row * columns + column] += force * share;
            }
        }
    }
}
