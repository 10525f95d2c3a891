//! Kernels that are measured besides the chain, by number. Each takes 2,048 codes and returns a word.

use crate::activation::{Activation, CONCEPTS, Maps, PLAIN};
use crate::chain::TAXELS;
use crate::copies;
use crate::dense::Dense;
use crate::folds::FOLDS;
use crate::measure::Measure;
use crate::windows::{AREA, SIDE, WINDOWS};
use core::hint::black_box;
use taxel_core::fold::{FoldState, FoldTable};
use taxel_core::format::Code;
use taxel_core::gesture::{Model, ShippedModel, TouchClassifier, TouchState};
use taxel_core::intent::{Inference, Outcome};
use taxel_core::pipeline::{Probe, Stage};
use taxel_core::shape::{DIMENSIONS, Exemplar, GALLERY_PROTOTYPES, Gallery, MEASURES, Patch, descriptor};

/// A kernel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kernel {
    /// Reads each code.
    Read,
    /// Reads each code and compares it with one limit.
    Compare,
    /// The plain chain.
    Dense,
    /// Measures eight windows in a number format.
    Measure(Measure),
    /// One step of the map in a number format.
    Activate(Activation),
    /// An inference of the shipped map from its inputs until it settles.
    Infer,
    /// Takes a frame of a touch on a panel of 512 taxels.
    Touch,
    /// Classifies the touch so far.
    Decide,
    /// Computes the descriptors of eight windows of 16 x 16 taxels.
    Describe,
    /// Finds the nearest of 200 prototypes.
    Nearest,
    /// Copies packets of bytes between all positions in a word.
    Copy,
    /// Subtracts what folds are expected to press from all that the left arm's taxels feel, or from what they
    /// feel beyond their levels.
    Subtract {
        /// True if a value is what a taxel feels beyond its level.
        beyond_levels: bool,
    },
}

/// Number of taxels of a panel of the reference garment.
const PANEL: usize = 512;

/// Angle of the elbow whose folds are subtracted, hundredths of a degree: all taxels are pressed.
const ELBOW: i16 = 4700;

/// Work space of the kernels.
pub struct Bench {
    dense: Dense,
    maps: Option<Maps>,
    inferred: Inference<CONCEPTS>,
    gestures: Option<TouchClassifier<'static>>,
    touch: TouchState,
    gallery: Gallery<GALLERY_PROTOTYPES>,
    folds: FoldState,
}

impl Default for Bench {
    #[inline(never)] // out of line: its stack is needed only during the call
    fn default() -> Bench {
        let model = Model::read(ShippedModel::Gestures.bytes()).ok();
        let gestures = model.map(|model| TouchClassifier::new(model, 32, 16));
        Bench {
            dense: Dense::new(),
            maps: Maps::shipped(),
            inferred: Inference { state: [0; CONCEPTS], steps: 0, outcome: Outcome::Unsettled },
            gestures,
            touch: const { TouchState::new() },
            gallery: gallery(),
            folds: const { FoldState::new() },
        }
    }
}

impl Kernel {
    /// All kernels; the emulated board gets their indices in this order.
    pub fn all() -> impl Iterator<Item = Kernel> {
        let plain = [Kernel::Read, Kernel::Compare, Kernel::Dense];
        let measures = Measure::ALL.map(Kernel::Measure);
        let activations = Activation::ALL.map(Kernel::Activate);
        plain.into_iter().chain(measures).chain(activations).chain([
            Kernel::Infer,
            Kernel::Touch,
            Kernel::Decide,
            Kernel::Describe,
            Kernel::Nearest,
            Kernel::Copy,
            Kernel::Subtract { beyond_levels: false },
            Kernel::Subtract { beyond_levels: true },
        ])
    }

    /// Runs the kernel. Returns a word that depends on its whole result. The work lies between the marks
    /// [`Stage::Idle`] and [`Stage::Scan`].
    pub fn run(self, bench: &mut Bench, codes: &[Code; TAXELS], probe: &mut impl Probe) -> u32 {
        probe.begin(Stage::Idle);
        match self {
            Kernel::Read => done(probe, read(codes)),
            Kernel::Compare => done(probe, compare(codes, black_box(200))).into(),
            Kernel::Dense => bench.dense(codes, probe),
            Kernel::Measure(measure) => {
                let mut found = [[0; 4]; WINDOWS];
                for (raw, window) in found.iter_mut().zip(codes.chunks(AREA)) {
                    *raw = measure.of(window);
                }
                fold(done(probe, found).into_iter().flatten())
            }
            Kernel::Activate(activation) => {
                let state = state(codes, PLAIN);
                let Some(maps) = &bench.maps else { return 0 };
                fold(done(probe, activation.step(maps, &state)).into_iter())
            }
            Kernel::Infer => bench.infer(codes, probe).unwrap_or(0),
            Kernel::Touch => bench.touch(codes, probe).unwrap_or(0),
            Kernel::Decide => bench.decide(probe).unwrap_or(0),
            Kernel::Describe => done(probe, describe(codes)),
            Kernel::Nearest => bench.nearest(codes, probe),
            Kernel::Copy => copy(codes, probe),
            Kernel::Subtract { beyond_levels } => bench.subtract(codes, beyond_levels, probe).unwrap_or(0),
        }
    }
}

impl Bench {
    fn dense(&mut self, codes: &[Code; TAXELS], probe: &mut impl Probe) -> u32 {
        let contacts = done(probe, self.dense.process(codes));
        let words = contacts.iter().flat_map(|c| {
            let ([x, y], [xx, yy, xy]) = (c.first, c.second);
            [c.m, x, y, xx, yy, xy]
        });
        fold(words.map(|word| word as u32))
    }

    fn infer(&mut self, codes: &[Code], probe: &mut impl Probe) -> Option<u32> {
        // Four inputs; the others start at 0.
        let start: [i32; PLAIN] = state(codes, 4);
        self.maps.as_ref()?.infer(&start, &mut self.inferred);
        probe.begin(Stage::Scan);
        let Inference { state, steps, .. } = &self.inferred;
        Some(fold(state.iter().map(|value| *value as u32).chain([u32::from(*steps)])))
    }

    fn touch(&mut self, codes: &[Code], probe: &mut impl Probe) -> Option<u32> {
        let gestures = self.gestures.as_ref()?;
        prepare(probe);
        let mut image = [0; PANEL];
        image.iter_mut().zip(codes).for_each(|(value, code)| *value = code.0);
        begin(probe);
        gestures.process(&mut self.touch, &image);
        probe.begin(Stage::Scan);
        Some(fold(gestures.decide(&self.touch).scores.into_iter().map(|score| score as u32)))
    }

    fn decide(&self, probe: &mut impl Probe) -> Option<u32> {
        let decision = done(probe, self.gestures.as_ref()?.decide(&self.touch));
        Some(fold(decision.scores.into_iter().map(|score| score as u32).chain([decision.lead])))
    }

    fn nearest(&self, codes: &[Code], probe: &mut impl Probe) -> u32 {
        let mut measures = [0; MEASURES];
        measures.iter_mut().zip(codes).for_each(|(measure, code)| *measure = code.0 as i16);
        let found = done(probe, self.gallery.recognise(&measures));
        let words = [found.distance.into(), found.class.unwrap_or(99).into(), found.share.0 as u32];
        fold(words.into_iter())
    }

    #[inline(never)] // out of line: its stack is needed only during the call
    fn subtract(
        &mut self,
        codes: &[Code; TAXELS],
        beyond_levels: bool,
        probe: &mut impl Probe,
    ) -> Option<u32> {
        // To put a table in force takes longer than the work.
        prepare(probe);
        let mut values = codes.map(|code| code.0);
        self.folds.pose(FoldTable::view(&FOLDS.0)?, &[ELBOW]).ok()?;
        begin(probe);
        self.folds.subtract(&mut values, beyond_levels);
        probe.begin(Stage::Scan);
        Some(fold(values.into_iter().map(u32::from)))
    }
}

fn describe(codes: &[Code]) -> u32 {
    let mut values = [0; AREA];
    let mut hash = 0;
    for window in codes.chunks(AREA) {
        values.iter_mut().zip(window).for_each(|(value, code)| *value = code.0);
        let measures = descriptor(&Patch::new(&values, SIDE));
        hash ^= fold(measures.into_iter().map(|measure| measure as u32));
    }
    hash
}

fn copy(codes: &[Code], probe: &mut impl Probe) -> u32 {
    prepare(probe);
    let mut from: copies::CopySpace = [0; _];
    from.iter_mut().zip(codes).for_each(|(byte, code)| *byte = code.0 as u8);
    let mut to = from;
    begin(probe);
    copies::packets(&from, &mut to);
    probe.begin(Stage::Scan);
    fold(to.into_iter().chain(copies::all(&from)).map(u32::from))
}

/// Marks that what follows, up to [`begin`], is no part of the work.
fn prepare(probe: &mut impl Probe) {
    probe.begin(Stage::Scan);
}

/// Marks the beginning of the work.
fn begin(probe: &mut impl Probe) {
    probe.begin(Stage::Idle);
}

/// Marks the end of the work; returns its result.
fn done<T>(probe: &mut impl Probe, found: T) -> T {
    probe.begin(Stage::Scan);
    found
}

/// A full gallery of random prototypes.
fn gallery() -> Gallery<GALLERY_PROTOTYPES> {
    let mut gallery = Gallery::new();
    let mut random = 1u32;
    let mut next = || {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (random >> 20) as i16
    };
    for _ in 0..DIMENSIONS {
        let _ = gallery.space.weights.push(core::array::from_fn(|_| next() >> 6));
    }
    (gallery.space.shift, gallery.k, gallery.reject) = (8, 9, u16::MAX);
    for class in 0..GALLERY_PROTOTYPES {
        let at = core::array::from_fn(|_| next());
        let _ = gallery.prototypes.push(Exemplar { class: class as u8 % 8, at });
    }
    gallery
}

/// The first `count` codes as activations from 0 to 1.
fn state<const N: usize>(codes: &[Code], count: usize) -> [i32; N] {
    let mut state = [0; N];
    for (value, code) in state.iter_mut().zip(codes).take(count) {
        *value = i32::from(code.0) << 3;
    }
    state
}

/// Reads every code: the least cost of a frame.
#[inline(never)]
fn read(codes: &[Code]) -> u32 {
    codes.iter().fold(0, |sum, code| sum | u32::from(code.0))
}

/// True if any code is above a limit.
#[inline(never)]
fn compare(codes: &[Code], limit: u16) -> bool {
    let limit = i32::from(limit);
    codes.iter().fold(0, |over, code| over | (limit - i32::from(code.0))) < 0
}

/// FNV-1a by words.
fn fold(words: impl Iterator<Item = u32>) -> u32 {
    words.fold(0x811c_9dc5, |hash, word| (hash ^ word).wrapping_mul(0x0100_0193))
}
