//! Objects that a limb probes, simulated: an arm swings into them until they press back, and holds.
//!
//! Two makers of objects with other laws: the map was tuned on the first, and is judged by the second.

use fastrand::Rng;
use std::path::Path;
use taxel::body::{self, DVec3, TaxelPlace, robot};
use taxel::mind::{HostInputLine, VirtualRobot};
use taxel::robot::ReadRobot;

/// Time from scan to scan, and from reading to reading of the joints, us.
const SCAN_US: u64 = 5_000;
const JOINTS_US: u64 = 10_000;
/// How late joints are sent, ms, and how far they are off, rad.
const LATE_MS: u32 = 8;
const READ_RAD: f64 = 5e-5;
/// Time before the arm moves, and after it has stopped, us.
const REST_US: u64 = 300_000;
const HOLD_US: u64 = 900_000;
/// Way from the begin to the object, rad.
const WAY_RAD: f64 = 0.1;
/// Taxels from first to last of the left arm.
const ARM: std::ops::Range<usize> = 1024..1536;
const JOINT: &str = "left_shoulder_pitch";

/// What an object is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Object {
    Soft,
    Hard,
    Sharp,
    Moving,
}

impl Object {
    pub const ALL: [Object; 4] = [Object::Soft, Object::Hard, Object::Sharp, Object::Moving];

    /// Concept of the map, and what is to be done.
    pub fn names(self) -> [&'static str; 2] {
        match self {
            Object::Soft => ["soft", "hold"],
            Object::Hard => ["hard", "explore"],
            Object::Sharp => ["sharp", "avoid"],
            Object::Moving => ["moving", "avoid"],
        }
    }
}

/// Newtons by depth, mm; pressure by distance from the middle, mm, along and across; and its own motion.
pub struct Thing {
    pub force: Box<dyn Fn(f64) -> f64>,
    pub pressure: Box<dyn Fn(f64, f64, f64) -> f64>,
    /// Way along the arm, mm, and depth that is added, mm, at a time since it is met, s.
    pub moves: Box<dyn Fn(f64) -> [f64; 2]>,
    pub note: String,
}

fn within(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.f64()
}

fn still() -> Box<dyn Fn(f64) -> [f64; 2]> {
    Box::new(|_| [0.0; 2])
}

/// The objects on which the map was tuned: springs with round footprints; a hand that slides, or breathes.
pub fn tuned(object: Object, rng: &mut Rng) -> Thing {
    let spring = |stiffness: f64, wide: [f64; 2]| -> Thing {
        let [radius, grows] = wide;
        Thing {
            force: Box::new(move |depth| stiffness * depth),
            pressure: Box::new(move |x, y, depth| {
                let radius = radius + grows * depth;
                (1.0 - (x * x + y * y) / (radius * radius)).max(0.0)
            }),
            moves: still(),
            note: format!("{stiffness:.2} N/mm, {radius:.0} mm"),
        }
    };
    match object {
        Object::Soft => {
            let stiffness = within(rng, 0.3, 1.2);
            spring(stiffness, [within(rng, 18.0, 30.0), within(rng, 0.5, 2.0)])
        }
        Object::Hard => spring(within(rng, 6.0, 25.0), [within(rng, 18.0, 40.0), 0.0]),
        Object::Sharp => spring(within(rng, 1.0, 8.0), [within(rng, 2.0, 5.0), 0.0]),
        Object::Moving => {
            let (stiffness, radius) = (within(rng, 0.5, 10.0), within(rng, 18.0, 30.0));
            let thing = spring(stiffness, [radius, 0.0]);
            let (speed, hz) = (within(rng, 70.0, 180.0), within(rng, 1.0, 2.5));
            let part = within(rng, 0.3, 0.6);
            let moves: Box<dyn Fn(f64) -> [f64; 2]> = match rng.bool() {
                true => Box::new(move |t| [25.0 * (speed / 25.0 * t).sin(), 0.0]),
                false => {
                    let deep = 6.0 / stiffness;
                    Box::new(move |t| {
                        [0.0, -part * deep * (0.5 - 0.5 * (std::f64::consts::TAU * hz * t).cos())]
                    })
                }
            };
            Thing { moves, note: format!("{}, {speed:.0} mm/s or {hz:.1} Hz", thing.note), ..thing }
        }
    }
}

/// Other objects, by other laws: foam that stiffens, balls of Hertz, straight edges, cones, blades; what
/// rolls, pulls away or beats.
pub fn other(object: Object, rng: &mut Rng) -> Thing {
    let flat = |x: f64, y: f64, [a, b]: [f64; 2]| f64::from(u8::from(x.abs() <= a && y.abs() <= b));
    match object {
        Object::Soft => {
            let (first, full) = (within(rng, 0.25, 0.9), within(rng, 12.0, 25.0));
            let ball = within(rng, 50.0, 120.0);
            Thing {
                force: Box::new(move |depth| first * full * ((depth / full).exp() - 1.0)),
                pressure: Box::new(move |x, y, depth| {
                    let reach = 2.0 * ball * (depth + 2.0);
                    (-(x * x + y * y) / reach).exp()
                }),
                moves: still(),
                note: format!("foam of {first:.2} N/mm, ball of {ball:.0} mm"),
            }
        }
        Object::Hard => {
            let (modulus, radius) = (within(rng, 5.0, 20.0), within(rng, 60.0, 150.0));
            let edge = rng.bool().then(|| [within(rng, 6.0, 9.0), within(rng, 25.0, 45.0)]);
            Thing {
                force: Box::new(move |depth| modulus * depth.powf(1.5)),
                pressure: Box::new(move |x, y, depth| match edge {
                    Some(half) => flat(x, y, half),
                    None => (1.0 - (x * x + y * y) / (2.0 * radius * (depth + 1.5))).max(0.0).sqrt(),
                }),
                moves: still(),
                note: format!("{modulus:.1} N/mm^1.5, ball of {radius:.0} mm or edge {edge:.0?}"),
            }
        }
        Object::Sharp => {
            let (cone, blade) = (within(rng, 0.8, 4.0), within(rng, 1.5, 3.5));
            let long = within(rng, 2.0, 5.0);
            let is_cone = rng.bool();
            Thing {
                force: Box::new(move |depth| if is_cone { cone * depth * depth } else { 3.0 * cone * depth }),
                pressure: Box::new(move |x, y, depth| match is_cone {
                    true => (-(x * x + y * y).sqrt() / (1.0 + 0.4 * depth)).exp(),
                    false => flat(x, y, [blade, long]),
                }),
                moves: still(),
                note: format!("cone {is_cone} of {cone:.1} N/mm2, blade {blade:.1} x {long:.1} mm"),
            }
        }
        Object::Moving => {
            let still_one = if rng.bool() { Object::Soft } else { Object::Hard };
            let thing = other(still_one, rng);
            let (speed, late) = (within(rng, 60.0, 150.0), within(rng, 0.15, 0.4));
            let part = within(rng, 0.35, 0.7);
            let deep = (0..2000).map(|step| f64::from(step) / 100.0).find(|deep| (thing.force)(*deep) >= 5.0);
            let deep = deep.unwrap_or(10.0);
            let which = rng.usize(..3);
            let moves: Box<dyn Fn(f64) -> [f64; 2]> = Box::new(move |t| match which {
                // It rolls along, there and back.
                0 => [speed * ((t + 0.2).rem_euclid(0.8) - 0.4).abs() - 0.2 * speed, 0.0],
                // It pulls away.
                1 => [0.0, -part * deep * ((t - late) / 0.25).clamp(0.0, 1.0)],
                // It beats.
                _ => [0.0, -part * deep * f64::from(u8::from((3.0 * t).fract() > 0.6))],
            });
            Thing { moves, note: format!("moves {which} of {}", thing.note), ..thing }
        }
    }
}

/// What the robot made of an object.
pub struct Found {
    /// Concepts that hold at the end of the probe.
    pub holding: Vec<String>,
    /// What the limb has felt, to analyse a failure.
    pub note: String,
}

/// The robot of the probes, which carries the reference garment on its body.
pub fn prober() -> ReadRobot {
    let text = "name = \"prober\"\nurdf = \"reference\"\n[[boards]]\nname = \"board\"\nsource = \"sim:idle\"\n\
                garment = \"reference\"\nbody = \"reference\"\ntare = 32\n";
    ReadRobot::parse("prober.toml".into(), text.into(), Path::new(".")).unwrap()
}

/// Lets the left arm swing into an object.
pub fn probe(read: &ReadRobot, thing: &Thing, rng: &mut Rng) -> Found {
    let urdf = robot::read("reference").unwrap();
    let board_garment = read.boards[0].garment.as_ref().unwrap();
    let surface =
        body::read("reference").unwrap().surface(&board_garment.garment, &board_garment.layout).unwrap();
    let link = urdf.link("left_upper_arm").unwrap();
    let seen = |angle: f64, place: &TaxelPlace| {
        let poses = urdf.poses(&urdf.posture([(JOINT, angle)]).unwrap());
        place.seen_from(&poses.of(link, 0).unwrap())
    };
    // A taxel that the joint moves outwards, and far from the panel's edges.
    let start = within(rng, -0.4, 0.4);
    let inner: Vec<TaxelPlace> = (8..24)
        .flat_map(|row| (0..16).map(move |column| ARM.start + row * 16 + column))
        .filter_map(|taxel| surface.places()[taxel])
        .collect();
    let outwards = |place: &TaxelPlace, way: f64| {
        let (before, after) = (seen(start, place), seen(start + way, place));
        (after.at - before.at).dot(before.normal) / (after.at - before.at).length()
    };
    let way = if rng.bool() { WAY_RAD } else { -WAY_RAD };
    let facing: Vec<&TaxelPlace> = inner.iter().filter(|place| outwards(place, way) > 0.9).collect();
    let middle = *facing[rng.usize(..facing.len())];
    let met = start + way;
    let there = seen(met, &middle);
    let places: Vec<Option<TaxelPlace>> = surface.places().to_vec();
    // Directions across the normal in the link's frame: along the arm, and around it.
    let along = (DVec3::Z - middle.normal * middle.normal.z).normalize();
    let around = middle.normal.cross(along);
    let (rate, full) = (within(rng, 0.25, 0.8), within(rng, 4.0, 8.0));
    let (rest, gain): (Vec<f64>, Vec<f64>) =
        (0..2048).map(|_| (within(rng, 70.0, 110.0), within(rng, 0.85, 1.15))).unzip();
    let mut stepped = VirtualRobot::new(read).unwrap();
    let (mut angle, mut stopped, mut touched) = (start, None, None);
    let mut readings: Vec<(u64, f64)> = Vec::new();
    let mut now = 0;
    while stopped.is_none_or(|since| now < since + HOLD_US) && now < 4_000_000 {
        let depth = ((seen(angle, &middle).at - there.at).dot(there.normal) * 1e3).max(0.0);
        let since_s = touched.map_or(0.0, |from| (now - from) as f64 * 1e-6);
        let [slid, deeper] = touched.map_or([0.0; 2], |_| (thing.moves)(since_s));
        let pressed = (depth + deeper).max(0.0);
        let newtons = if depth > 0.0 { (thing.force)(pressed) } else { 0.0 };
        if depth > 0.0 {
            touched.get_or_insert(now);
        }
        if now > REST_US && stopped.is_none() {
            match newtons >= full || depth >= 12.0 {
                true => stopped = Some(now),
                false => angle += rate * way.signum() * SCAN_US as f64 * 1e-6,
            }
        }
        let shares: Vec<f64> = ARM
            .map(|taxel| {
                let Some(place) = places[taxel] else { return 0.0 };
                if place.normal.dot(middle.normal) < 0.2 {
                    return 0.0;
                }
                let away = (place.at - middle.at) * 1e3;
                let (x, y) = (away.dot(along) - slid, away.dot(around));
                // A taxel samples the pressure at nine points.
                let points = (0..9).map(|point| [f64::from(point % 3) - 1.0, f64::from(point / 3) - 1.0]);
                points.map(|[a, b]| (thing.pressure)(x + 3.5 * a, y + 3.0 * b, pressed)).sum()
            })
            .collect();
        let sum: f64 = shares.iter().sum();
        let codes: Vec<u16> = (0..2048)
            .map(|taxel| {
                let share = ARM.contains(&taxel).then(|| shares[taxel - ARM.start]).filter(|_| sum > 0.0);
                let force = share.map_or(0.0, |share| newtons * share / sum);
                let noise = 4.0 * (rng.f64() + rng.f64() - 1.0);
                (rest[taxel] + 1000.0 * gain[taxel] * force + noise).round().clamp(0.0, 4095.0) as u16
            })
            .collect();
        if now % JOINTS_US == 0 {
            readings.push((now, angle + READ_RAD * 3.4 * (rng.f64() - 0.5)));
        }
        while readings.first().is_some_and(|(at, _)| at + 1000 * u64::from(LATE_MS) <= now) {
            let (at, read) = readings.remove(0);
            let positions = [(JOINT.to_string(), read)].into();
            let line =
                HostInputLine { positions, age_ms: ((now - at) / 1000) as u32, ..HostInputLine::default() };
            stepped.mind().take_input(&line, now).unwrap();
        }
        stepped.step(0, &codes, now).unwrap();
        now += SCAN_US;
    }
    let mind = stepped.mind();
    let meaning = mind.meaning().unwrap();
    let name = |at: &usize| mind.map().concept[*at].name.clone();
    let touches: Vec<String> = taxel::mind::RobotTouchLine::all(mind)
        .iter()
        .map(|touch| format!("{} {:?} {:?}", touch.load, touch.mover, touch.probe))
        .collect();
    Found {
        holding: meaning.holding.iter().map(name).collect(),
        note: format!("{}: {touches:?}", thing.note),
    }
}
