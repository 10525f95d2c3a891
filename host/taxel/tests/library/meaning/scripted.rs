//! Twenty families of touches by the author of the map: the simulator's scripts, with its footprints and
//! half-cosines.
//!
//! Forces are newtons, lengths mm, times seconds. Places, sizes and tempo are random; every second touch is
//! on the mat; the spread of gains, the hysteresis and the noise of the taxels differ between touches.

use crate::meaning::family::{Act, Expected, Family};
use fastrand::Rng;
use taxel::files::scripts;
use taxel::sim::{Player, Script, Shape, Size, Touch};
use taxel_core::garment::Garment;

/// The families, in the order of the table.
pub const FAMILIES: [Family; 20] = [
    Family { name: "hug", expected: Expected::Kind },
    Family { name: "handshake", expected: Expected::Kind },
    Family { name: "hearty pat", expected: Expected::Friendly },
    Family { name: "caress", expected: Expected::Kind },
    Family { name: "tickle", expected: Expected::Friendly },
    Family { name: "pat", expected: Expected::Kind },
    Family { name: "rucksack", expected: Expected::Friendly },
    Family { name: "massage", expected: Expected::Friendly },
    Family { name: "leaning", expected: Expected::Friendly },
    Family { name: "clap", expected: Expected::Friendly },
    Family { name: "cushion", expected: Expected::Friendly },
    Family { name: "gentle chest", expected: Expected::Friendly },
    Family { name: "palm held", expected: Expected::Friendly },
    Family { name: "stab", expected: Expected::Attack },
    Family { name: "poke", expected: Expected::Harmful },
    Family { name: "pen", expected: Expected::Harmful },
    Family { name: "needle", expected: Expected::Harmful },
    Family { name: "slap of 30 N", expected: Expected::Harmful },
    Family { name: "slap of 80 N", expected: Expected::Attack },
    Family { name: "punch", expected: Expected::Attack },
];

/// Begin of the first touch, after the tare, s.
const BEGIN_S: f64 = 0.8;

/// Touch `number` of a family.
pub fn act(family: usize, number: u64) -> Act {
    let mut rng = Rng::with_seed(0x70_75c4 + 1000 * family as u64 + number);
    let garment = if number.is_multiple_of(2) { Garment::reference() } else { Garment::mat() };
    let Family { name, .. } = FAMILIES[family];
    let touches = Hand { rng: rng.fork(), garment: &garment }.does(name);
    let end_s = touches.iter().map(Touch::end_s).fold(0.0, f64::max);
    let note = touches.first().map(|touch| {
        format!(
            "{:.1} N, {:?} {:.0?} mm, rise {:.0} ms",
            touch.force_n,
            touch.shape,
            touch.size(),
            1e3 * touch.rise_s
        )
    });
    let script = script(end_s + 2.0, touches, &mut rng);
    let mut player = Player::new(&script, &garment).expect("the script is good");
    Act {
        family: FAMILIES[family],
        span: ((BEGIN_S * 1e6) as u64, (end_s * 1e6) as u64),
        period_us: [5_128, 10_000, 2_500][rng.usize(..3)],
        garment,
        note: note.unwrap_or_default(),
        codes: Box::new(move |start_us, codes| player.frame(start_us, codes)),
    }
}

/// A script on an imperfect garment.
fn script(duration_s: f64, touches: Vec<Touch>, rng: &mut Rng) -> Script {
    let mut script =
        scripts::parse(&format!("duration_s = {duration_s}"), "families.toml").expect("it is short");
    script.seed = rng.u64(1..1 << 40);
    script.idle.noise_counts = between(rng, 2.0, 3.5);
    script.sensor.gain_spread = between(rng, 0.0, 0.12);
    script.sensor.hysteresis = between(rng, 0.0, 0.2);
    script.sensor.noise = between(rng, 0.0, 0.02);
    script.touches = touches;
    script
}

fn between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + rng.f64() * (high - low)
}

/// A simulated toucher.
struct Hand<'a> {
    rng: Rng,
    garment: &'a Garment,
}

/// Newtons, and seconds of rise, hold and fall.
type Course = ([f64; 2], [f64; 2], [f64; 2], [f64; 2]);

impl Hand<'_> {
    fn pick(&mut self, [low, high]: [f64; 2]) -> f64 {
        between(&mut self.rng, low, high)
    }

    /// A touch with this shape, size, place (shares of the panel) and course.
    fn touch(&mut self, panel: usize, shape: Shape, size: [f64; 2], at: [f64; 2], course: Course) -> Touch {
        let panel = &self.garment.panels[panel % self.garment.panels.len()];
        let mm =
            |axis: usize, count: u16| f64::from(panel.pitch_um[axis]) / 1e3 * f64::from(count) * at[axis];
        let at_mm = [mm(0, panel.columns), mm(1, panel.rows)];
        let text = format!("panel = \"{}\"\nshape = \"palm\"\nforce_n = 1\nstart_s = {BEGIN_S}", panel.name);
        let plain: Touch = toml::from_str(&text).expect("it is short");
        Touch {
            shape,
            at_mm: Some(at_mm),
            size_mm: Some(Size::Both(size)),
            force_n: self.pick(course.0),
            rise_s: self.pick(course.1),
            hold_s: self.pick(course.2),
            fall_s: self.pick(course.3),
            ..plain
        }
    }

    /// A touch near the middle of a panel, in any direction.
    fn middle(&mut self, shape: Shape, size: [f64; 2], course: Course) -> Touch {
        let (panel, at) = (self.rng.usize(..4), [self.pick([0.4, 0.6]), self.pick([0.35, 0.65])]);
        let angle_deg = self.pick([0.0, 180.0]);
        Touch { angle_deg, ..self.touch(panel, shape, size, at, course) }
    }

    /// A palm of random size.
    fn palm(&mut self, course: Course) -> Touch {
        let size = [self.pick([85.0, 115.0]), self.pick([70.0, 95.0])];
        self.middle(Shape::Palm, size, course)
    }

    fn again(&mut self, touch: Touch, times: std::ops::RangeInclusive<u32>, pause: [f64; 2]) -> Touch {
        let period_s = Some(touch.once_s() + self.pick(pause));
        Touch { repeat: self.rng.u32(times), period_s, ..touch }
    }

    fn does(&mut self, name: &str) -> Vec<Touch> {
        use Shape::{Ball, Finger, Forearm, Palm, Strap};
        match name {
            "hug" => {
                let course = ([8.0, 50.0], [0.3, 1.0], [1.5, 3.0], [0.3, 0.8]);
                let back = self.touch(1, Forearm, [150.0, 60.0], [0.5, 0.3], course);
                let late = self.pick([0.0, 0.15]);
                let second = self.touch(1, Forearm, [140.0, 60.0], [0.5, 0.6], course);
                let chest = self.touch(0, Palm, [150.0, 180.0], [0.5, 0.75], course);
                vec![back, Touch { start_s: BEGIN_S + late, ..second }, chest]
            }
            "handshake" => {
                let mut grip = self.palm(([10.0, 35.0], [0.15, 0.35], [0.05, 0.1], [0.2, 0.4]));
                grip.rise_s = self.pick([0.1, 0.16]);
                let low = self.pick([0.4, 0.7]);
                grip.levels = [1.0, low].repeat(self.rng.usize(2..5));
                vec![grip]
            }
            "hearty pat" => {
                let pat = self.palm(([15.0, 25.0], [0.03, 0.07], [0.02, 0.08], [0.03, 0.08]));
                vec![self.again(pat, 2..=4, [0.1, 0.25])]
            }
            "caress" => {
                let touch = self.palm(([1.5, 6.0], [0.1, 0.25], [0.8, 1.5], [0.1, 0.25]));
                let speed = self.pick([4.0, 8.0]) * if self.rng.bool() { 1.0 } else { -1.0 };
                vec![Touch { velocity: [0.0, speed], ..touch }]
            }
            "tickle" => {
                let tip =
                    self.middle(Finger, [14.0; 2], ([0.8, 3.0], [0.02, 0.05], [0.0, 0.05], [0.02, 0.05]));
                let (x, y) = (self.pick([-6.0, 6.0]), self.pick([-6.0, 6.0]));
                let mut beside = tip.clone();
                beside.at_mm = tip.at_mm.map(|[a, b]| [a + 25.0, b + 12.0]);
                beside.start_s += 0.05;
                [tip, beside]
                    .map(|tip| Touch { velocity: [x, y], ..self.again(tip, 8..=14, [0.0, 0.05]) })
                    .into()
            }
            "pat" => {
                let pat = self.palm(([3.0, 12.0], [0.04, 0.09], [0.03, 0.1], [0.04, 0.09]));
                vec![self.again(pat, 2..=4, [0.1, 0.25])]
            }
            "rucksack" => {
                let course = ([10.0, 30.0], [0.4, 1.2], [3.0, 4.0], [0.4, 1.0]);
                let width = self.pick([35.0, 60.0]);
                let strap = |hand: &mut Self, x| hand.touch(0, Strap, [180.0, width], [x, 0.4], course);
                [0.25, 0.75].map(|x| Touch { angle_deg: 90.0, ..strap(self, x) }).into()
            }
            "massage" => {
                let size = self.pick([35.0, 80.0]);
                let knead = self.middle(Ball, [size; 2], ([8.0, 30.0], [0.25, 0.5], [0.1, 0.3], [0.25, 0.5]));
                vec![self.again(knead, 3..=5, [0.0, 0.1])]
            }
            "leaning" => {
                let size = [self.pick([120.0, 180.0]), self.pick([110.0, 160.0])];
                vec![self.middle(Palm, size, ([20.0, 70.0], [0.6, 1.5], [2.0, 4.0], [0.4, 1.0]))]
            }
            "clap" => vec![self.palm(([10.0, 22.0], [0.025, 0.05], [0.02, 0.1], [0.03, 0.08]))],
            "cushion" => {
                let size = [self.pick([150.0, 190.0]), self.pick([180.0, 300.0])];
                vec![self.middle(Palm, size, ([10.0, 50.0], [0.06, 0.3], [0.3, 2.0], [0.2, 0.5]))]
            }
            "gentle chest" => {
                let size = [self.pick([100.0, 170.0]), self.pick([90.0, 200.0])];
                vec![self.middle(Palm, size, ([4.0, 18.0], [0.2, 0.8], [1.0, 2.5], [0.2, 0.6]))]
            }
            "palm held" => vec![self.palm(([2.0, 10.0], [0.15, 0.5], [1.5, 4.0], [0.2, 0.5]))],
            "stab" => {
                let size = [self.pick([12.0, 20.0]), self.pick([8.0, 14.0])];
                vec![self.middle(Finger, size, ([30.0, 80.0], [0.008, 0.025], [0.02, 0.2], [0.02, 0.1]))]
            }
            "poke" => {
                let size = self.pick([13.0, 17.0]);
                vec![self.middle(Finger, [size; 2], ([8.0, 40.0], [0.03, 0.1], [0.05, 0.3], [0.03, 0.1]))]
            }
            "pen" => {
                let size = self.pick([8.0, 10.0]);
                vec![self.middle(Finger, [size; 2], ([5.0, 60.0], [0.02, 0.1], [0.1, 0.5], [0.03, 0.1]))]
            }
            "needle" => {
                vec![self.middle(Finger, [4.0; 2], ([8.0, 12.0], [0.02, 0.08], [0.1, 0.4], [0.03, 0.1]))]
            }
            "slap of 30 N" => vec![self.palm(([28.0, 34.0], [0.006, 0.018], [0.01, 0.04], [0.01, 0.04]))],
            "slap of 80 N" => vec![self.palm(([70.0, 90.0], [0.006, 0.02], [0.01, 0.04], [0.01, 0.04]))],
            "punch" => {
                let size = self.pick([60.0, 90.0]);
                vec![self.middle(Ball, [size; 2], ([50.0, 160.0], [0.008, 0.03], [0.01, 0.05], [0.02, 0.05]))]
            }
            other => unreachable!("{other} is no family"),
        }
    }
}
