//! Touches that move over a seam between two boards: one simulated object laid across both panels, which two
//! boards of any rate scan at times of their own.
//!
//! A thousand passes with TAXEL_CAMPAIGN=1, others than the usual ones from TAXEL_SEED on.

use super::scanning::{self, BEGAN_US, Scanning};
use fastrand::Rng;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use taxel::robot::{BoardTouch, ReadRobot, RobotContact, RobotContacts, ScanReader};
use taxel_core::condition::Filter;
use taxel_core::contact::Phase;
use taxel_core::format::name;
use taxel_core::garment::{Garment, Seam, SeamEdge, Side};
use taxel_sim::{Script, World};

/// Rows and columns of each panel.
const WIDE: u16 = 32;
/// Pitches of the garments, um.
const PITCHES_UM: [u32; 2] = [5_000, 10_000];
const TAXELS: usize = WIDE as usize * WIDE as usize;
/// Passes of the ordinary test, and of a campaign.
const PASSES: [u64; 2] = [24, 1000];
/// Passes of which the force differed by more than 5 % while a touch was told at one time alone.
const ONCE_OFF: [u64; 7] = [20_099, 20_111, 20_612, 20_949, 40_490, 80_203, 120_989];
/// Begin of a touch, s: until then the boards tare.
const START_S: f64 = 0.25;
/// Greatest difference of the force on a seam.
const BAR: f64 = 0.05;
/// Time in which a touch reaches its force, s.
const RISE_S: f64 = 0.05;
/// Way from scan to scan, taxels, up to which a touch is slow.
const SLOW: f64 = 0.3;
const SIDES: [Side; 4] = [Side::Left, Side::Right, Side::Top, Side::Bottom];

/// The folder with a garment for each pitch.
static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("crossing");
    std::fs::create_dir_all(&folder).unwrap();
    for pitch_um in PITCHES_UM {
        let garment = toml::to_string(&panel(pitch_um)).unwrap();
        std::fs::write(folder.join(format!("{pitch_um}.toml")), garment).unwrap();
    }
    folder
});

/// A garment of one panel.
fn panel(pitch_um: u32) -> Garment {
    scanning::panel([WIDE, WIDE], [pitch_um; 2])
}

/// Where the panels of two boards are sewn together.
#[derive(Debug, Clone, Copy)]
struct Sewn {
    sides: [Side; 2],
    starts: [u16; 2],
    length: u16,
    reversed: bool,
}

impl Sewn {
    fn random(random: &mut Rng) -> Sewn {
        let length = random.u16(24..=WIDE);
        let starts = [0; 2].map(|_| random.u16(0..=WIDE - length));
        Sewn { sides: [0; 2].map(|_| SIDES[random.usize(0..4)]), starts, length, reversed: random.bool() }
    }

    /// Both panels as one garment, for the simulation.
    fn together(&self, pitch_um: u32) -> Garment {
        let mut both = panel(pitch_um);
        let mut second = both.panels[0].clone();
        (both.panels[0].name, second.name) = (name("one"), name("two"));
        both.panels.push(second).unwrap();
        for block in both.blocks.clone() {
            let block = taxel_core::garment::Block { panel: 1, select: block.select + 4, ..block };
            both.blocks.push(block).unwrap();
        }
        let edge = |at: usize| SeamEdge { panel: at as u8, side: self.sides[at], start: self.starts[at] };
        let seam = Seam { a: edge(0), b: edge(1), length: self.length, reversed: self.reversed };
        both.seams.push(seam).unwrap();
        both
    }

    /// The robot of two boards.
    fn robot(&self, pitch_um: u32) -> ReadRobot {
        let board = |name: &str| {
            format!("[[boards]]\nname = \"{name}\"\nsource = \"sim:press\"\ngarment = \"{pitch_um}.toml\"\n")
        };
        let edge = |at: usize| {
            let (side, start) = (format!("{:?}", self.sides[at]).to_lowercase(), self.starts[at]);
            let board = ["one", "two"][at];
            format!("{{ board = \"{board}\", panel = \"mat\", side = \"{side}\", start = {start} }}")
        };
        let text = format!(
            "name = \"two\"\n{}{}[[seams]]\na = {}\nb = {}\nlength = {}\nreversed = {}\n",
            board("one"),
            board("two"),
            edge(0),
            edge(1),
            self.length,
            self.reversed
        );
        ReadRobot::parse("crossing.toml".into(), text, &FOLDER).unwrap()
    }
}

/// A touch that moves over the seam.
#[derive(Debug, Clone)]
struct Pass {
    pitch_um: u32,
    sewn: Sewn,
    /// Panel on which it begins.
    from: usize,
    shape: &'static str,
    size_mm: f64,
    force_n: f64,
    /// Speed across the seam and along it, taxels/s.
    speed: [f64; 2],
    /// Taxels from the seam at which it begins and ends.
    away: f64,
    /// Taxels along the seam where it crosses.
    crosses: f64,
    /// Time between two scans of each board, and the first, us.
    periods_us: [u64; 2],
    first_us: [u64; 2],
}

impl Pass {
    fn random(seed: u64) -> Pass {
        let random = &mut Rng::with_seed(seed);
        let between = |random: &mut Rng, low: f64, high: f64| low + (high - low) * random.f64();
        let pitch_um = PITCHES_UM[random.usize(0..2)];
        let pitch_mm = f64::from(pitch_um) / 1000.0;
        let sewn = Sewn::random(random);
        let shape = ["finger", "ball", "palm", "box"][random.usize(0..4)];
        let taxels = between(random, 1.8, 8.0);
        let periods_us = [0; 2].map(|_| (1e6 / between(random, 50.0, 400.0)) as u64);
        // At most 15 mm, and two taxels, from scan to scan.
        let slowest_s = periods_us[0].max(periods_us[1]) as f64 / 1e6;
        let most = (15.0 / pitch_mm).min(2.0) / slowest_s;
        let speed = between(random, 4.0, 120.0).min(most);
        let slope = between(random, -0.5, 0.5);
        let away = (taxels / 2.0 + 4.0).ceil() + random.f64();
        let middle = f64::from(sewn.length) / 2.0;
        Pass {
            pitch_um,
            sewn,
            from: random.usize(0..2),
            shape,
            size_mm: taxels * pitch_mm,
            force_n: between(random, 0.3, 1.5) * taxels * taxels * 0.785,
            speed: [speed, slope * speed],
            away,
            crosses: middle + between(random, -3.0, 3.0),
            periods_us,
            first_us: periods_us.map(|period| random.u64(0..period)),
        }
    }

    fn hold_s(&self) -> f64 {
        2.0 * self.away / self.speed[0]
    }

    /// Time of the end, s.
    fn end_s(&self) -> f64 {
        START_S + 2.0 * RISE_S + self.hold_s()
    }

    /// Where it begins on its panel, `[x, y]`, and its velocity; `deeper`: so many taxels farther from the
    /// seam.
    fn path(&self, deeper: f64) -> [[f64; 2]; 2] {
        let (side, start) = (self.sewn.sides[self.from], f64::from(self.sewn.starts[self.from]));
        let last = f64::from(WIDE) - 1.0;
        let [fast, aside] = self.speed;
        // Half of the way along the seam lies before the crossing.
        let along = start + self.crosses - aside * (RISE_S + self.hold_s() / 2.0);
        let depth = self.away + fast * RISE_S - 0.5 + deeper;
        match side {
            Side::Left => [[depth, along], [-fast, aside]],
            Side::Right => [[last - depth, along], [fast, aside]],
            Side::Top => [[along, depth], [aside, -fast]],
            Side::Bottom => [[along, last - depth], [aside, fast]],
        }
    }

    fn script(&self, panel: &str, deeper: f64) -> Script {
        let [[x, y], [vx, vy]] = self.path(deeper);
        let text = format!(
            "name = \"pass\"\nduration_s = 60\n[idle]\nbase_code = 200\nnoise_counts = 2\n\
             [[touch]]\npanel = \"{panel}\"\nshape = \"{}\"\nsize_mm = {:.4}\nforce_n = {:.4}\nat = [{x:.5}, {y:.5}]\n\
             velocity = [{vx:.5}, {vy:.5}]\nstart_s = {START_S}\nrise_s = {RISE_S}\nhold_s = {:.5}\nfall_s = {RISE_S}\n",
            self.shape,
            self.size_mm,
            self.force_n,
            self.hold_s()
        );
        toml::from_str(&text).unwrap()
    }
}

/// What was told in the course of a pass: the host's time, us, and the contacts.
type Told = Vec<(u64, Vec<RobotContact>)>;

/// A board that scans a panel of a world.
fn scans<'a>(world: &'a World, panel_of: usize, pass: &Pass, number: usize, filter: Filter) -> Scanning<'a> {
    let reader = ScanReader::new(&pass.sewn.robot(pass.pitch_um), number);
    let times_us = [pass.first_us[number], pass.periods_us[number]];
    Scanning::new(world, panel_of * TAXELS, panel(pass.pitch_um), reader, filter, times_us)
}

fn told(pass: &Pass, filter: Filter) -> Told {
    let world =
        World::build(&pass.script(["one", "two"][pass.from], 0.0), &pass.sewn.together(pass.pitch_um));
    let world = world.unwrap();
    let mut boards = [0, 1].map(|number| scans(&world, number, pass, number, filter));
    let mut contacts = RobotContacts::new(&pass.sewn.robot(pass.pitch_um));
    let end_us = ((pass.end_s() + 0.2) * 1e6) as u64;
    let mut told = Vec::new();
    loop {
        let number = usize::from(boards[1].next_us < boards[0].next_us);
        let (time, scans) = boards[number].scan();
        if time > end_us {
            return told;
        }
        let now = BEGAN_US + time;
        told.extend(scans.iter().map(|scan| (now, contacts.scan(number, scan, now))));
    }
}

/// Totals of the same touch wholly inside a panel, by time, us, as the board of this number scans it.
fn inside(pass: &Pass, number: usize, filter: Filter) -> Vec<(u64, f64)> {
    let garment = panel(pass.pitch_um);
    // In the middle of its panel when it would be on the seam.
    let world = World::build(&pass.script("mat", f64::from(WIDE) / 2.0 - 1.0), &garment).unwrap();
    let mut board = scans(&world, 0, pass, number, filter);
    let mut totals = Vec::new();
    while board.next_us < (pass.end_s() * 1e6) as u64 {
        let (time, scans) = board.scan();
        let sum = |list: Vec<BoardTouch>| list.iter().map(|contact| f64::from(contact.total)).sum();
        let lists = scans.into_iter().filter_map(|scan| scan.contacts);
        totals.extend(lists.map(|list| (BEGAN_US + time, sum(list))));
    }
    totals
}

/// Seeds of the passes.
fn seeds() -> Vec<u64> {
    let first = std::env::var("TAXEL_SEED").map_or(0, |seed| seed.parse().unwrap());
    match std::env::var_os("TAXEL_CAMPAIGN") {
        Some(_) => (first..first + PASSES[1]).collect(),
        None => (first..first + PASSES[0]).chain(ONCE_OFF).collect(),
    }
}

/// Ids that were told, and those that were released.
fn ids(told: &Told) -> [BTreeSet<u32>; 2] {
    let all = || told.iter().flat_map(|(_, contacts)| contacts);
    let released = all().filter(|contact| contact.phase == Phase::Released);
    [all().map(|contact| contact.id).collect(), released.map(|contact| contact.id).collect()]
}

#[test]
fn a_touch_keeps_its_id_over_a_seam_between_boards() {
    let mut kept = 0;
    let passes = seeds().len();
    for seed in seeds() {
        let pass = Pass::random(seed);
        let told = told(&pass, Filter::default());
        let [all, released] = ids(&told);
        let boards: BTreeSet<usize> =
            told.iter().flat_map(|(_, c)| c).flat_map(|c| &c.touch.parts).map(|part| part.board).collect();
        let is_kept = all.len() == 1 && released == all && boards.len() == 2;
        if !is_kept {
            println!("seed {seed}: ids {all:?}, released {released:?}, boards {boards:?}, {pass:?}");
        }
        kept += usize::from(is_kept);
    }
    println!("the id is kept in {kept} of {passes}");
    assert_eq!(kept, passes);
}

/// Greatest of a share of values, sorted, in per cent.
fn share(sorted: &[f64], part: f64) -> f64 {
    100.0 * sorted[((sorted.len() - 1) as f64 * part) as usize]
}

/// What is told on the seam by both boards together: the host's time, us, the total, and what each board has of it
/// now.
fn on_seam(told: &Told) -> Vec<(u64, f64, [f64; 2])> {
    let mut lists = Vec::new();
    for (_, contacts) in told {
        let there: Vec<&RobotContact> = contacts.iter().filter(|c| c.touch.parts.len() == 2).collect();
        if let [RobotContact { touch, .. }] = there[..] {
            let of = |board: usize| {
                let parts = touch.parts.iter().filter(|part| part.board == board);
                parts.map(|part| f64::from(part.total)).sum()
            };
            lists.push((touch.host_us, f64::from(touch.total), [of(0), of(1)]));
        }
    }
    // A board that has told nothing new changes nothing.
    lists.dedup_by_key(|(time, ..)| *time);
    assert!(lists.is_sorted_by_key(|(time, ..)| *time));
    lists
}

/// What these scans tell of a time between two of them.
fn at(scans: &[(u64, f64)], time: u64) -> Option<f64> {
    let after = scans.partition_point(|(at, _)| *at <= time);
    let [(t0, a), (t1, b)] = scans.get(after.checked_sub(1)?..=after)? else { return None };
    Some(a + (b - a) * (time - t0) as f64 / (t1 - t0) as f64)
}

/// How far the force on a seam differs from that inside a panel, sorted: means of the passes, and single lists
/// of all touches and of slow ones.
///
/// What the filter takes inside a panel of a touch that is small and fast depends on where its board's scans
/// find it: the part of the touch that a board has is compared with what that board tells inside.
fn differences(filter: Filter) -> [Vec<f64>; 3] {
    let mut found = [Vec::new(), Vec::new(), Vec::new()];
    let [means, moments, slow] = &mut found;
    for seed in seeds() {
        let pass = Pass::random(seed);
        let inside = [0, 1].map(|number| inside(&pass, number, filter));
        let (mut sum, mut wanted, mut count) = (0.0, 0.0, 0);
        for (time, total, [one, two]) in on_seam(&told(&pass, filter)) {
            let (Some(want_one), Some(want_two)) = (at(&inside[0], time), at(&inside[1], time)) else {
                continue;
            };
            let want = (want_one * one + want_two * two) / (one + two);
            (sum, wanted, count) = (sum + total, wanted + want, count + 1);
            let difference = (total / want - 1.0).abs();
            moments.push(difference);
            let step = pass.speed[0] * pass.periods_us[0].max(pass.periods_us[1]) as f64 / 1e6;
            if step <= SLOW {
                slow.push(difference);
            }
        }
        assert!(count > 0, "seed {seed}: {pass:?}");
        let difference = sum / wanted - 1.0;
        if difference.abs() > BAR {
            println!("seed {seed}: {:.1} %, {count} lists, {pass:?}", 100.0 * difference);
        }
        means.push(difference.abs());
    }
    for (what, values) in ["passes", "lists", "slow lists"].iter().zip(&mut found) {
        values.sort_by(f64::total_cmp);
        let [median, most, worst] = [0.5, 0.99, 1.0].map(|part| share(values, part));
        let above = values.iter().filter(|difference| **difference > BAR).count();
        let all = values.len();
        println!(
            "{filter:?}, {all} {what}: median {median:.2} %, 99 % {most:.2} %, worst {worst:.2} %, {above} above 5 %"
        );
    }
    found
}

#[test]
fn the_force_on_a_seam_is_that_inside_a_panel() {
    let [means, _, slow] = differences(Filter::Off);
    assert!(means.iter().all(|difference| *difference <= BAR));
    assert!(share(&means, 0.5) <= 0.1 && share(&slow, 0.99) <= 2.0);
}

/// Inside a panel, the filter takes up to a sixth of a touch of two taxels that moves by two taxels from scan to
/// scan: on a seam it takes as much.
#[test]
fn a_filter_leaves_on_a_seam_what_it_leaves_inside_a_panel() {
    let [means, _, slow] = differences(Filter::default());
    assert!(means.iter().all(|difference| *difference <= BAR));
    assert!(share(&means, 0.5) <= 0.25 && share(&slow, 0.99) <= 3.0);
}
