//! The family of touches on which the map was tuned: the simulator's scripts, half-cosines and plain
//! footprints.

use crate::people::kind::{Act, Kind, Session};
use fastrand::Rng;
use taxel::files::scripts;
use taxel::sim::{Player, Script, Shape, Touch};
use taxel_core::garment::Garment;

/// A person who touches the reference garment.
pub struct Person {
    acts: Vec<Act>,
    player: Player,
}

impl Person {
    /// Person `number`, who does everything `of_each` times, in random order.
    pub fn new(number: u64, of_each: usize) -> Person {
        let mut rng = Rng::with_seed(0x5c41 + number);
        let mut kinds = Kind::ALL.repeat(of_each);
        rng.shuffle(&mut kinds);
        let (mut start_s, mut acts, mut touches) = (0.6, Vec::new(), Vec::new());
        for kind in kinds {
            let touch = touch(kind, start_s, &mut rng);
            let span = [start_s, touch.end_s()].map(|s| (s * 1e6) as u64);
            let note = format!(
                "{:.1} N, rise {:.0} ms, {:?} {:?}",
                touch.force_n,
                touch.rise_s * 1e3,
                touch.shape,
                touch.size()
            );
            acts.push(Act { kind, span: (span[0], span[1]), note });
            start_s = touch.end_s() + between(&mut rng, 0.95, 1.8);
            touches.push(touch);
        }
        let script = Script { touches, seed: number + 1, ..empty(start_s) };
        let player = Player::new(&script, &Garment::reference()).expect("the script is good");
        Person { acts, player }
    }
}

impl Session for Person {
    fn garment(&self) -> Garment {
        Garment::reference()
    }

    fn acts(&self) -> &[Act] {
        &self.acts
    }

    fn frame(&mut self, start_us: u64, codes: &mut [u16]) {
        self.player.frame(start_us, codes);
    }
}

fn between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + rng.f64() * (high - low)
}

/// A script without touches.
fn empty(duration_s: f64) -> Script {
    scripts::parse(&format!("duration_s = {duration_s}"), "people.toml").expect("it is short")
}

/// Parameters of a kind of touch: shape, newtons, size in mm, seconds of rise, hold and fall.
type Form = (Shape, [f64; 2], [[f64; 2]; 2], [f64; 2], [f64; 2], [f64; 2]);

fn form(kind: Kind) -> Form {
    use Shape::{Ball, Finger, Palm, Strap};
    let palm = [[85.0, 115.0], [65.0, 95.0]];
    match kind {
        Kind::Pat => (Palm, [3.0, 14.0], palm, [0.03, 0.09], [0.02, 0.12], [0.03, 0.09]),
        Kind::Stroke => (Palm, [2.0, 8.0], palm, [0.05, 0.15], [0.5, 1.2], [0.05, 0.15]),
        Kind::Tap => (Finger, [1.0, 5.0], [[12.0, 20.0]; 2], [0.01, 0.04], [0.0, 0.1], [0.01, 0.04]),
        Kind::Hold => (Palm, [25.0, 70.0], palm, [0.12, 0.4], [0.8, 2.0], [0.1, 0.3]),
        Kind::Grab => (Palm, [25.0, 60.0], palm, [0.1, 0.25], [0.2, 0.6], [0.08, 0.2]),
        Kind::Slap => (Palm, [22.0, 90.0], palm, [0.006, 0.02], [0.01, 0.04], [0.01, 0.04]),
        Kind::Punch => (Ball, [40.0, 160.0], [[60.0, 90.0]; 2], [0.008, 0.03], [0.01, 0.05], [0.01, 0.05]),
        Kind::Lash => {
            (Strap, [20.0, 60.0], [[150.0, 280.0], [14.0, 30.0]], [0.006, 0.02], [0.0, 0.04], [0.01, 0.02])
        }
    }
}

fn touch(kind: Kind, start_s: f64, rng: &mut Rng) -> Touch {
    let (shape, force, [length, width], rise, hold, fall) = form(kind);
    let mut pick = |[low, high]: [f64; 2]| between(rng, low, high);
    let (force_n, rise_s, hold_s, fall_s) = (pick(force), pick(rise), pick(hold), pick(fall));
    let size = [pick(length), pick(width)];
    let speed = if kind == Kind::Stroke { pick([6.0, 16.0]) } else { 0.0 };
    let way = speed * (rise_s + hold_s + fall_s);
    let at = [pick([6.0, 9.0]), pick([8.0, 23.0 - way.min(14.0)])];
    let angle_deg = if shape == Shape::Strap { pick([50.0, 130.0]) } else { pick([0.0, 180.0]) };
    let gap = pick([0.05, 0.2]);
    let repeat = if matches!(kind, Kind::Pat | Kind::Tap) { rng.u32(1..=4) } else { 1 };
    let panel = ["chest", "back", "left arm", "right arm"][rng.usize(..4)];
    let text = format!("panel = \"{panel}\"\nshape = \"palm\"\nforce_n = 1\nstart_s = {start_s}");
    let plain: Touch = toml::from_str(&text).expect("it is short");
    Touch {
        shape,
        force_n,
        at: Some(at),
        size_mm: Some(taxel::sim::Size::Both(size)),
        angle_deg,
        rise_s,
        hold_s,
        fall_s,
        velocity: [0.0, speed],
        repeat,
        period_s: Some(rise_s + hold_s + fall_s + gap),
        ..plain
    }
}
