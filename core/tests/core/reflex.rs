//! The reflex: who begins it, how late, and who never does.

use crate::random::Noise;
use taxel_core::acquire::{Depth, Fields, Plan, Reflex};
use taxel_core::board::{BoardInfo, Setup};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros, name};
use taxel_core::garment::{Circuit, Garment, Layout};
use taxel_core::react::{Cause, ReactionConfig};
use taxel_core::reflex::{Agree, Early};
use taxel_core::scene::Scene;

const COLUMNS: usize = 16;
/// Taxels of a panel of the reference garment.
const PANEL: usize = 512;
/// Code at rest, and of a taxel that is pressed beyond the level of 1,000 counts.
const REST: u16 = 100;
const PRESSED: u16 = 2_000;
/// Time of a sub-field, us.
const FIELD_US: u64 = 640;

fn rows(agree: Agree) -> Vec<ReactionConfig> {
    let row = |region: &str, pin| ReactionConfig {
        name: name(region),
        cause: Cause::Reflex(agree),
        region: name(region),
        level: 1_000,
        hysteresis: 0,
        hold_ms: 0,
        output: Some(taxel_core::garment::Line { pin, inverted: pin == 19 }),
    };
    vec![row("chest", 18), row("back", 19)]
}

fn scene(agree: Agree) -> Scene {
    let mut scene = Scene::shipped();
    scene.plan.depth = Depth::Interlaced;
    scene.react = rows(agree).into_iter().collect();
    scene
}

/// A scan of the reference garment and its reflex.
struct ReflexRig {
    reflex: Box<Reflex<TAXELS>>,
    setup: Setup,
    /// By the order of the scan.
    taxels: Vec<Vec<usize>>,
    frame: Box<[Code; TAXELS]>,
    /// Sub-fields that were checked.
    fields: u64,
}

fn circuit_of(garment: &Garment) -> Circuit {
    let layout = Layout::build(garment, TAXELS, 4095).unwrap();
    Circuit::build(garment, &layout, taxel_core::garment::Pins::ANY).unwrap()
}

impl ReflexRig {
    fn new(agree: Agree, falling: bool) -> ReflexRig {
        let mut garment = Garment::reference();
        garment.wiring.falling = falling;
        let info = BoardInfo::feather("test");
        let setup = Setup::build(&info, garment, scene(agree), TAXELS).unwrap();
        let circuit = circuit_of(&setup.garment);
        let plan = Plan { depth: Depth::Interlaced, ..Plan::default() };
        let fields = Fields::of(&circuit, &plan).unwrap();
        let mut reflex = Box::new(Reflex::new());
        reflex.begin(fields.clone(), falling);
        let mut taxels = vec![vec![Vec::new(); fields.inputs().len()]; fields.count()];
        fields.each(&circuit, &plan, |field, _, read| {
            reflex.order(field, taxels[field][0].len(), read);
            let there = read.iter().flatten().zip(&mut taxels[field]);
            there.for_each(|(taxel, of)| of.push(usize::from(*taxel)));
        });
        let taxels = taxels.into_iter().map(|inputs| inputs.concat()).collect();
        let mut rig = ReflexRig { reflex, setup, taxels, frame: Box::new([Code(0); TAXELS]), fields: 0 };
        (0..TAXELS / 64).for_each(|_| rig.watch(0, &[]));
        rig
    }

    /// What the board does with each frame; some taxels are silenced.
    fn watch(&mut self, active: u8, silenced: &[usize]) {
        let reflexes = self.setup.pipeline.reactions().reflexes();
        let falling = self.setup.circuit.falling();
        let quiet = if falling { 4095 - REST - 999 } else { REST + 999 };
        let last = if falling { 0 } else { u16::MAX };
        self.reflex.watch(Some(reflexes), active, |taxel| {
            reflexes.row_of(taxel)?;
            Some(if silenced.contains(&usize::from(taxel)) { last } else { quiet })
        });
    }

    /// Reads the next sub-field of a garment with these pressures.
    fn field(&mut self, pressure: &[u16]) -> u8 {
        let falling = self.setup.circuit.falling();
        let field = (self.fields % 8) as usize;
        self.fields += 1;
        let code = |taxel: &usize| Code(if falling { 4095 - pressure[*taxel] } else { pressure[*taxel] });
        let codes: Vec<Code> = self.taxels[field].iter().map(code).collect();
        let begun =
            self.reflex.check(field, &codes, self.frame.as_mut_slice(), Micros(self.fields * FIELD_US));
        for taxel in &self.taxels[field] {
            assert_eq!(self.frame[*taxel], code(taxel));
        }
        begun
    }
}

/// A garment at rest but for a footprint.
fn touched(corner: usize, side: usize) -> Vec<u16> {
    let mut pressure = vec![REST; TAXELS];
    for at in 0..side * side {
        pressure[corner + at / side * COLUMNS + at % side] = PRESSED;
    }
    pressure
}

#[test]
fn a_footprint_is_met_at_once_and_agrees_soon() {
    let corners = (0..2 * PANEL).filter(|taxel| taxel % PANEL / COLUMNS < 30 && taxel % COLUMNS < 14);
    for (agree, most) in [(Agree::One, 1), (Agree::Two, 3)] {
        let mut rig = ReflexRig::new(agree, false);
        let mut latest = 0;
        for corner in corners.clone() {
            // From another sub-field on each time.
            (0..8 + corner % 3).for_each(|_| assert_eq!(rig.field(&touched(0, 0)), 0));
            let pressure = touched(corner, 3);
            let begun = (1..=8).find(|_| rig.field(&pressure) != 0).unwrap();
            latest = latest.max(begun);
            let (row, pin) = if corner < PANEL { (0, (18, true)) } else { (1, (19, false)) };
            assert!(rig.reflex.pins(1 << row).eq([pin]));
            let early = rig.reflex.take_early().unwrap();
            assert_eq!((early.index, early.time), (row, Micros(rig.fields * FIELD_US)));
            assert_eq!((early.code, early.other.is_some()), (Code(PRESSED), agree == Agree::Two));
            assert!(
                [Some(early.taxel), early.other]
                    .into_iter()
                    .flatten()
                    .all(|taxel| pressure[usize::from(taxel)] == PRESSED)
            );
            assert_eq!(rig.reflex.take_early(), None);
            // It begins once, and again when its pin was put to rest.
            assert!((0..8).all(|_| rig.field(&pressure) == 0));
            rig.reflex.driven(pin.0, pin.1);
            assert!((0..8).all(|_| rig.field(&pressure) == 0));
            rig.reflex.driven(pin.0, !pin.1);
            assert!((0..8).any(|_| rig.field(&pressure) == 1 << row));
            rig.reflex.take_early().unwrap();
            rig.reflex.driven(pin.0, !pin.1);
        }
        assert_eq!(latest, most, "{agree:?}");
    }
}

#[test]
fn what_is_silenced_unwatched_or_not_tared_begins_nothing() {
    for falling in [false, true] {
        let mut rig = ReflexRig::new(Agree::One, falling);
        // Panel 2 and 3 are arms, which no row watches.
        assert!((0..16).all(|_| rig.field(&touched(2 * PANEL + 40, 3)) == 0));
        let corner = 5 * COLUMNS + 5;
        let silenced: Vec<usize> = (0..9).map(|at| corner + at / 3 * COLUMNS + at % 3).collect();
        (0..TAXELS / 16).for_each(|_| rig.watch(0, &silenced));
        assert!((0..16).all(|_| rig.field(&touched(corner, 3)) == 0));
        // The limits follow within 128 frames.
        (0..TAXELS / 16).for_each(|_| rig.watch(0, &[]));
        assert!((0..8).any(|_| rig.field(&touched(corner, 3)) == 1));
        rig.reflex.driven(18, false);
        rig.reflex.watch(None, 0, |_| Some(0));
        assert!((0..16).all(|_| rig.field(&touched(corner, 3)) == 0));
    }
}

#[test]
fn other_rows_forget_what_was_begun() {
    let mut rig = ReflexRig::new(Agree::One, false);
    assert!((0..8).any(|_| rig.field(&touched(100, 3)) == 1));
    rig.setup =
        Setup::build(&BoardInfo::feather("test"), Garment::reference(), scene(Agree::Two), TAXELS).unwrap();
    rig.watch(0, &[]);
    assert_eq!(rig.reflex.take_early(), None::<Early>);
    assert!((0..8).all(|_| rig.field(&touched(100, 3)) == 0), "the limits are not all set");
    (0..TAXELS / 64).for_each(|_| rig.watch(0, &[]));
    assert!((0..8).any(|_| rig.field(&touched(100, 3)) == 1));
}

/// Impulses of a hundredth of the taxels, of any height, each one frame long; and none again on a taxel or
/// its neighbours within 8 frames, nor within 5 x 5 taxels of another one of its frame, if they are `apart`.
/// How many rows began in so many frames.
fn false_reflexes(agree: Agree, apart: bool, frames: usize) -> usize {
    let mut rig = ReflexRig::new(agree, false);
    let mut random = Noise(9);
    let mut hit = vec![usize::MAX; TAXELS];
    let mut began = 0;
    let mut pressure = vec![REST; TAXELS];
    for frame in 8..frames + 8 {
        // Noise of 3.4 counts rms: the sum of four numbers of 0 to 5, each as likely.
        pressure
            .iter_mut()
            .for_each(|p| *p = REST - 10 + (0..4).map(|_| random.below(6) as u16).sum::<u16>());
        let mut here: Vec<usize> = Vec::new();
        for _ in 0..TAXELS / 100 {
            let taxel = random.below(TAXELS as u64) as usize;
            let near = |other: usize, reach: usize| {
                taxel / PANEL == other / PANEL
                    && (taxel / COLUMNS).abs_diff(other / COLUMNS) <= reach
                    && (taxel % COLUMNS).abs_diff(other % COLUMNS) <= reach
            };
            let around = [taxel.saturating_sub(COLUMNS + 1), taxel.saturating_sub(1), taxel + COLUMNS - 1];
            let rows = around.map(|first| first..(first + 3).min(TAXELS));
            let mut recent = rows.into_iter().flatten().filter(|other| near(*other, 1));
            if apart
                && (here.iter().any(|other| near(*other, 2))
                    || recent.any(|other| hit[other] != usize::MAX && hit[other] + 8 >= frame))
            {
                continue;
            }
            hit[taxel] = frame;
            here.push(taxel);
            pressure[taxel] = REST + random.below(4_096 - u64::from(REST)) as u16;
        }
        for _ in 0..8 {
            let begun = rig.field(&pressure);
            began += begun.count_ones() as usize;
            while rig.reflex.take_early().is_some() {}
            [(18, false), (19, true)].into_iter().for_each(|(pin, level)| rig.reflex.driven(pin, level));
        }
    }
    began
}

/// The figures of docs/concepts/reflex.md, with `TAXEL_CAMPAIGN=1`; else of fewer frames.
/// `cargo test -p taxel-core --test core -- reflex::impulses --nocapture`
#[test]
fn impulses() {
    let second = |began: usize, frames: usize| began as f64 * 195.3 / frames as f64;
    let frames = if crate::is_campaign() { 100_000 } else { 20_000 };
    let two = false_reflexes(Agree::Two, true, frames);
    println!("two that agree, impulses apart: {two} reflexes in {frames} frames");
    let alone = false_reflexes(Agree::Two, false, 20_000);
    println!("two that agree, impulses independent: {:.2} a second", second(alone, 20_000));
    let one = false_reflexes(Agree::One, true, 2_000);
    println!("one taxel's word, impulses apart: {:.0} a second", second(one, 2_000));
    assert_eq!(two, 0);
    // They do find what is near each other, and one taxel's word is no protection.
    assert!(alone > 0 && one > 2_000);
}
