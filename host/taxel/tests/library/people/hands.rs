//! A second family of touches, with other time courses and footprints. The shipped map's weights were chosen
//! with the results of both in view.
//!
//! | kind | where | newtons | how |
//! |---|---|--:|---|
//! | pat | hand | 2 to 14 | one to four pulses, 35 to 80 ms to the peak |
//! | stroke | hand or three fingertips, along an arc, 60 to 200 mm/s | 1 to 8 | 0.6 to 1.8 s |
//! | tap | one or two fingertips | 0.8 to 5 | one to six pulses, 12 to 40 ms to the peak |
//! | hold | hand | 24 to 70 | minimum jerk in 0.2 to 0.5 s, tremor, 1 to 2.5 s |
//! | grab | hand | 24 to 60 | minimum jerk in 0.13 to 0.3 s, up to 30 % too far, 0.3 to 0.9 s |
//! | slap | hand | 24 to 90 | a sharp pulse in 7 to 18 ms, weight after it |
//! | punch | fist | 40 to 160 | a sharp pulse in 8 to 22 ms, weight after it |
//! | lash | bent strap, landing end after end | 20 to 60 | a pulse, 5 to 15 ms to the peak |

use crate::people::course::Course;
use crate::people::kind::{Act, Kind, Session};
use crate::people::print::Print;
use crate::people::skin::Skin;
use fastrand::Rng;
use taxel_core::garment::Garment;

/// A person who touches one of two garments, with hands of an individual size and an individual tempo.
pub struct Person {
    garment: Garment,
    skin: Skin,
    acts: Vec<Act>,
    touches: Vec<Touch>,
    newtons: Vec<f64>,
}

/// One touch.
struct Touch {
    panel: usize,
    print: Print,
    course: Course,
    newtons: f64,
    begin_s: f64,
    /// Initial centre, mm; speed, mm/s; turning rate of the path, radians per second.
    at: [f64; 2],
    speed: [f64; 2],
    turning: f64,
}

/// Habits of a person.
struct Habit {
    size: f64,
    tempo: f64,
    rng: Rng,
}

impl Habit {
    fn pick(&mut self, low: f64, high: f64) -> f64 {
        low + self.rng.f64() * (high - low)
    }

    /// A duration in this person's tempo.
    fn time(&mut self, low: f64, high: f64) -> f64 {
        self.pick(low, high) * self.tempo
    }
}

impl Person {
    /// Person `number`, who does everything `of_each` times, in random order.
    pub fn new(number: u64, of_each: usize) -> Person {
        let mut rng = Rng::with_seed(0xface_0000 ^ number.wrapping_mul(0x9e37_79b9));
        let garment = if number.is_multiple_of(2) { Garment::reference() } else { Garment::mat() };
        let skin = Skin::new(&garment, rng.fork());
        let mut kinds = Kind::ALL.repeat(of_each);
        rng.shuffle(&mut kinds);
        let mut habit = Habit { size: 0.82 + 0.36 * rng.f64(), tempo: 0.8 + 0.4 * rng.f64(), rng };
        let (mut begin_s, mut acts, mut touches) = (0.5, Vec::new(), Vec::new());
        for kind in kinds {
            let touch = habit.touch(kind, begin_s, &skin);
            let end_s = begin_s + touch.course.length_s();
            let note = format!("of person {number}: {:.1} N, {:?}", touch.newtons, touch.course);
            acts.push(Act { kind, span: ((begin_s * 1e6) as u64, (end_s * 1e6) as u64), note });
            begin_s = end_s + habit.pick(0.95, 2.0);
            touches.push(touch);
        }
        let newtons = vec![0.0; skin.panels.iter().map(|(_, columns, rows, _)| columns * rows).sum()];
        Person { garment, skin, acts, touches, newtons }
    }
}

impl Habit {
    fn touch(&mut self, kind: Kind, begin_s: f64, skin: &Skin) -> Touch {
        let (newtons, course) = self.course(kind);
        let print = self.print(kind);
        let panel = self.rng.usize(..skin.panels.len());
        let (_, columns, rows, pitch) = skin.panels[panel];
        let side = [columns as f64 * pitch[0], rows as f64 * pitch[1]];
        let at = [self.pick(0.4, 0.6) * side[0], self.pick(0.35, 0.65) * side[1]];
        let fast = if kind == Kind::Stroke { self.pick(60.0, 200.0) } else { 0.0 };
        // Back and forth from the middle: a stroke of a second and a half stays on the panel.
        let speed = [self.pick(-0.3, 0.3) * fast, if at[1] > side[1] / 2.0 { -fast } else { fast }];
        Touch { panel, print, course, newtons, begin_s, at, speed, turning: self.pick(-1.0, 1.0) }
    }

    fn course(&mut self, kind: Kind) -> (f64, Course) {
        let newtons = match kind {
            Kind::Pat => self.pick(2.0, 14.0),
            Kind::Stroke => self.pick(1.0, 8.0),
            Kind::Tap => self.pick(0.8, 5.0),
            Kind::Hold => self.pick(24.0, 70.0),
            Kind::Grab => self.pick(24.0, 60.0),
            Kind::Slap => self.pick(24.0, 90.0),
            Kind::Punch => self.pick(40.0, 160.0),
            Kind::Lash => self.pick(20.0, 60.0),
        };
        let course = match kind {
            Kind::Pat => {
                let (peak_s, n) = (self.time(0.035, 0.08), self.pick(2.0, 4.0));
                Course::rhythm(self.rng.u32(1..=4), peak_s, n, [0.02, 0.25], &mut self.rng)
            }
            Kind::Tap => {
                let (peak_s, n) = (self.time(0.012, 0.04), self.pick(1.5, 4.0));
                Course::rhythm(self.rng.u32(1..=6), peak_s, n, [0.03, 0.2], &mut self.rng)
            }
            Kind::Stroke => Course::Glide {
                length_s: self.time(0.6, 1.8),
                edge_s: self.pick(0.04, 0.15),
                wave: (self.pick(0.0, 0.25), self.pick(1.0, 6.0)),
            },
            Kind::Hold => self.grip([0.2, 0.5], 0.05, [1.0, 2.5]),
            Kind::Grab => self.grip([0.13, 0.3], 0.3, [0.3, 0.9]),
            Kind::Slap => self.blow([0.007, 0.018], [0.025, 0.05]),
            Kind::Punch => self.blow([0.008, 0.022], [0.03, 0.06]),
            Kind::Lash => {
                let (peak_s, n) = (self.pick(0.005, 0.015), self.pick(1.5, 4.0));
                Course::Pulses { peak_s, n, each: vec![(0.0, 1.0)] }
            }
        };
        (newtons, course)
    }

    fn grip(&mut self, rise: [f64; 2], over: f64, length: [f64; 2]) -> Course {
        let rise_s = self.time(rise[0], rise[1]);
        Course::Grip {
            rise_s,
            over: self.pick(0.0, over),
            tremor: (self.pick(0.01, 0.06), self.pick(6.0, 12.0)),
            release_s: (rise_s + self.pick(length[0], length[1]), self.pick(0.1, 0.3)),
        }
    }

    fn blow(&mut self, sharp: [f64; 2], broad: [f64; 2]) -> Course {
        Course::Blow {
            sharp_s: self.pick(sharp[0], sharp[1]),
            broad_s: self.pick(broad[0], broad[1]),
            part: self.pick(0.0, 0.6),
        }
    }

    fn print(&mut self, kind: Kind) -> Print {
        let angle = self.pick(0.0, std::f64::consts::TAU);
        match kind {
            Kind::Tap => Print::fingertips(self.rng.u32(1..=2), self.size, angle),
            Kind::Stroke if self.rng.bool() => Print::fingertips(3, self.size, angle),
            Kind::Punch => Print::fist(self.size, angle),
            Kind::Lash => {
                let (length, width) = (self.pick(140.0, 240.0), self.pick(14.0, 32.0));
                let lands_s = self.pick(0.003, 0.012);
                // Roughly along the panel.
                let angle = std::f64::consts::FRAC_PI_2 + self.pick(-0.5, 0.5);
                Print::strap(length, width, angle, lands_s, &mut self.rng)
            }
            _ => Print::hand(self.size, angle, &mut self.rng),
        }
    }
}

impl Touch {
    /// Centre at a time after the begin, mm: the path is an arc.
    fn centre(&self, t: f64) -> [f64; 2] {
        let (sin, cos) = (self.turning * t).sin_cos();
        let turned = [self.speed[0] * cos - self.speed[1] * sin, self.speed[0] * sin + self.speed[1] * cos];
        [self.at[0] + turned[0] * t, self.at[1] + turned[1] * t]
    }

    /// Adds the force on each taxel of a scan that starts at a time and takes 5 ms, N.
    fn add(&self, start_s: f64, skin: &Skin, newtons: &mut [f64]) {
        let (first, columns, rows, pitch) = skin.panels[self.panel];
        let [x, y] = self.centre(start_s - self.begin_s);
        let span = |centre: f64, pitch: f64, count: usize| {
            let low = ((centre - self.print.reach) / pitch - 1.0).max(0.0) as usize;
            low..((((centre + self.print.reach) / pitch + 2.0).max(0.0)) as usize).min(count)
        };
        for row in span(y, pitch[1], rows) {
            let t = start_s - self.begin_s + 0.005 * row as f64 / rows as f64;
            let force = |late: f64| self.newtons * self.course.at(t - late);
            for column in span(x, pitch[0], columns) {
                // Four points stand for the taxel.
                let points = [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)];
                let felt: f64 = points
                    .into_iter()
                    .map(|(a, b)| {
                        let at = [(column as f64 + a) * pitch[0] - x, (row as f64 + b) * pitch[1] - y];
                        self.print.pressure(at[0], at[1], force)
                    })
                    .sum();
                newtons[first + row * columns + column] += felt / 4.0 * pitch[0] * pitch[1];
            }
        }
    }
}

impl Session for Person {
    fn garment(&self) -> Garment {
        self.garment.clone()
    }

    fn acts(&self) -> &[Act] {
        &self.acts
    }

    fn frame(&mut self, start_us: u64, codes: &mut [u16]) {
        self.newtons.fill(0.0);
        for (touch, act) in self.touches.iter().zip(&self.acts) {
            if (act.span.0.saturating_sub(10_000)..act.span.1 + 30_000).contains(&start_us) {
                touch.add(start_us as f64 / 1e6, &self.skin, &mut self.newtons);
            }
        }
        self.skin.codes(&self.newtons, codes);
    }
}
