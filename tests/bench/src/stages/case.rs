//! A case: a garment, settings of a scene, and the codes of its frames; the same for the emulated board and
//! for this machine.

use anyhow::{Context, Result};
use std::ops::Range;
use std::path::Path;
use taxel::client::Client;
use taxel::files::arrays;
use taxel::files::bases::Base;
use taxel::session::setting::set_shapes;
use taxel_core::acquire::Depth;
use taxel_core::condition::Filter;
use taxel_core::fold::{JointAngle, Posture};
use taxel_core::format::Code;
use taxel_core::garment::Garment;
use taxel_core::gesture::GestureConfig;
use taxel_core::scene::Scene;
use taxel_core::wire::{LONGEST_REQUEST, Request, encode, frame_bound};
use taxel_suite::chain::{FULL_SCALE, TAXELS};
use taxel_suite::kernel::Kernel;
use taxel_suite::pattern::{COLUMNS, ROWS, TouchPattern};

/// Frames of the tare.
const TARE: u16 = 16;
/// Frames before the measured ones: contacts are tracked by then, and the images are differences.
const WARM: usize = 8;
/// Measured frames of a case, if it needs no more.
const MEASURED: usize = 16;

/// Recording, its posture and its first frame: a person lying still.
const RECORDING: (&str, &str, usize) = ("pmatdata/subject_01.npz", "posture_03", 40);

/// An input of the chain.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Step {
    /// The host sends these bytes.
    Receive(Vec<u8>),
    /// A finished scan with these codes.
    Scan(Vec<Code>),
    /// A table of folds is in force from now on, or none.
    Fold(bool),
    /// A kernel to run on these codes.
    Kernel(Kernel, Box<[Code; TAXELS]>),
}

/// One row of the table of the whole chain.
#[derive(Debug, Clone)]
pub struct Case {
    /// Name of the scene.
    pub name: &'static str,
    /// Variant of the chain.
    pub variant: Variant,
    /// Simulated pattern on the reference garment; none for a recording or another garment.
    pub pattern: Option<TouchPattern>,
    garment: Garment,
    scene: Scene,
    frames: Vec<Vec<Code>>,
}

/// Difference of a chain from the shipped one (12 bit, conservative filter).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variant {
    /// None.
    Shipped,
    /// No filter.
    Off,
    /// Median of nine.
    Median,
    /// The upper 8 bits of each code.
    EightBit,
    /// With gestures, decided as often as possible.
    Gestures,
    /// With a shipped base of shapes taught to the board.
    Taught,
    /// With a report of what presses on the robot for each frame.
    Pressing,
    /// With the left arm, all of which folds, all but still.
    Folds,
    /// With the left arm bending, by 4.8 degrees from one posture to the next, to where it was not before.
    Bending,
    /// With the left arm turning on and on with 1 rad/s, as far as from one knot to the next.
    Turning,
    /// With the left arm turning to and fro between two knots that it has been compared at: it comes to none.
    Swaying,
    /// With the left arm turning to and fro, at another of two such knots with each posture: all of it is
    /// compared each time.
    Comparing,
    /// One panel of 64 x 32 taxels.
    Columns32,
    /// One panel of 64 x 27 taxels.
    Columns27,
    /// One block of 4 x 16 taxels.
    Block,
}

impl Variant {
    /// Name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Variant::Shipped => "shipped",
            Variant::Off => "filter off",
            Variant::Median => "median",
            Variant::EightBit => "8 bit",
            Variant::Gestures => "gestures",
            Variant::Taught => "taught",
            Variant::Pressing => "pressing",
            Variant::Folds => "folds",
            Variant::Bending => "bending",
            Variant::Turning => "turning",
            Variant::Swaying => "swaying",
            Variant::Comparing => "comparing",
            Variant::Columns32 => "32 columns",
            Variant::Columns27 => "27 columns",
            Variant::Block => "4 x 16",
        }
    }

    /// Its garment.
    fn garment(self) -> Garment {
        match self {
            Variant::Columns32 => Garment::mat(),
            Variant::Columns27 => narrow(),
            Variant::Block => Garment::block(),
            _ => Garment::reference(),
        }
    }

    /// Taxels of a pattern in the order of the variant's garment. The four panels of the pattern lie two by
    /// two on a wide panel, cut at its right edge; a block is a cut through the first disc.
    fn taxels(self) -> Vec<usize> {
        let laid = |rows: Range<usize>, columns: usize| {
            let taxel = move |row: usize, column: usize| {
                (row / ROWS * 2 + column / COLUMNS) * ROWS * COLUMNS + row % ROWS * COLUMNS + column % COLUMNS
            };
            rows.flat_map(move |row| (0..columns).map(move |column| taxel(row, column))).collect()
        };
        match self {
            Variant::Columns32 => laid(0..64, 32),
            Variant::Columns27 => laid(0..64, 27),
            Variant::Block => laid(8..12, 16),
            _ => (0..TAXELS).collect(),
        }
    }

    fn scene(self) -> Scene {
        let mut scene = Scene::shipped();
        match self {
            Variant::Off => scene.condition.filter = Filter::Off,
            Variant::Median => scene.condition.filter = Filter::Median,
            Variant::EightBit => scene.plan.depth = Depth::Eight,
            _ => {}
        }
        scene
    }

    /// Requests that teach a base, if the variant has one.
    fn taught(self) -> Result<Vec<Step>> {
        let mut client = Client::new();
        client.request(&Request::SetShapes(&[]))?;
        if self == Variant::Taught {
            set_shapes(&mut client, &Base::open(Path::new("drawn"))?)?;
        }
        // The harness transfers at most 4,096 bytes.
        Ok(client.queued().chunks(1024).map(|bytes| Step::Receive(bytes.to_vec())).collect())
    }

    /// Angle of its elbow in posture number `n`, hundredths of a degree; none if nothing folds. The table has a
    /// knot each 9 degrees, and a play of 6: on the way back the sleeve is as much ahead of the joint as it is
    /// behind on the way there.
    fn bends(self, n: usize) -> Option<i16> {
        // The first two are at a knot each; the sleeve is then between them.
        let turning = |between: [i16; 4]| [0, 1500].into_iter().chain(between).nth(n);
        match self {
            Variant::Folds => Some(120 * n as i16),
            Variant::Bending => Some(480 * n as i16),
            // After its play is used up.
            Variant::Turning => Some(if n == 0 { 0 } else { 782 + 118 * n as i16 }),
            Variant::Swaying => turning([-100, 1200, -200, 1100]),
            Variant::Comparing => turning([-420, 1320, -420, 1320]),
            _ => None,
        }
    }

    /// Number of measured frames.
    const fn measured(self) -> usize {
        match self {
            Variant::Turning => 2 * MEASURED,
            _ => MEASURED,
        }
    }

    fn gestures(self) -> Option<GestureConfig> {
        let often = GestureConfig { decide_ms: 50, onset_ms: 0, ..GestureConfig::default() };
        (self == Variant::Gestures).then_some(often)
    }
}

/// A mat without its last five columns.
fn narrow() -> Garment {
    let mut garment = Garment::mat();
    let panel = &mut garment.panels[0];
    panel.columns = 27;
    for block in garment.blocks.iter_mut() {
        block.columns = block.columns.min((panel.columns - block.column) as u8);
    }
    garment
}

impl Case {
    /// All simulated cases.
    pub fn simulated() -> Vec<Case> {
        let shipped = TouchPattern::ALL.into_iter().filter(|pattern| *pattern != TouchPattern::Grid);
        let cases = shipped.map(|pattern| (pattern, Variant::Shipped)).chain([
            (TouchPattern::Grid, Variant::Off),
            (TouchPattern::Five, Variant::Off),
            (TouchPattern::Five, Variant::Median),
            (TouchPattern::Five, Variant::EightBit),
            (TouchPattern::Five, Variant::Gestures),
            (TouchPattern::Five, Variant::Taught),
            (TouchPattern::One, Variant::Pressing),
            (TouchPattern::Five, Variant::Pressing),
            (TouchPattern::Sixteen, Variant::Pressing),
            (TouchPattern::Forty, Variant::Pressing),
            (TouchPattern::Checkerboard, Variant::Pressing),
            (TouchPattern::Texture, Variant::Pressing),
            (TouchPattern::Empty, Variant::Folds),
            (TouchPattern::Five, Variant::Folds),
            (TouchPattern::Texture, Variant::Folds),
            (TouchPattern::Empty, Variant::Bending),
            (TouchPattern::Empty, Variant::Turning),
            (TouchPattern::Empty, Variant::Swaying),
            (TouchPattern::Empty, Variant::Comparing),
            (TouchPattern::Texture, Variant::Off),
            (TouchPattern::Texture, Variant::Median),
        ]);
        let wide = [Variant::Columns32, Variant::Columns27].into_iter().flat_map(|variant| {
            [TouchPattern::Empty, TouchPattern::Five, TouchPattern::Texture].map(|pattern| (pattern, variant))
        });
        let block = [TouchPattern::Empty, TouchPattern::One, TouchPattern::Texture]
            .map(|pattern| (pattern, Variant::Block));
        let cases = cases.chain(wide).chain(block);
        cases.map(|(pattern, variant)| Case::of(pattern, variant)).collect()
    }

    fn of(pattern: TouchPattern, variant: Variant) -> Case {
        let (scene, taxels) = (variant.scene(), variant.taxels());
        let rest = (0..u32::from(TARE)).map(|n| (TouchPattern::Empty, n));
        let touch = (u32::from(TARE)..).map(|n| (pattern, n)).take(WARM + variant.measured());
        let frames = rest.chain(touch).map(|(pattern, number)| {
            let mut codes = [Code(0); TAXELS];
            pattern.codes(number, &mut codes);
            taxels.iter().map(|taxel| Code(scene.plan.depth.keep(codes[*taxel].0))).collect()
        });
        let garment = variant.garment();
        Case {
            name: pattern.name(),
            variant,
            pattern: (garment == Garment::reference()).then_some(pattern),
            garment,
            frames: frames.collect(),
            scene,
        }
    }

    /// A person lying on a mat of 64 x 32 taxels, from the folder of recordings.
    pub fn recorded(data: &Path) -> Result<Case> {
        let (file, posture, first) = RECORDING;
        let recording = arrays::read(&data.join(file), Some(posture))?;
        let rest = vec![vec![Code(0); TAXELS]; usize::from(TARE)];
        let touch = recording.iter().skip(first).take(WARM + MEASURED);
        let touch = touch.map(|frame| frame.iter().map(|code| Code((*code).min(FULL_SCALE))).collect());
        let frames: Vec<Vec<Code>> = rest.into_iter().chain(touch).collect();
        let variant = Variant::Shipped;
        anyhow::ensure!(frames.len() == usize::from(TARE) + WARM + MEASURED, "{file}: too short");
        let (garment, scene) = (Garment::mat(), variant.scene());
        Ok(Case { name: "recorded", variant, pattern: None, garment, scene, frames })
    }

    /// Number of a measured frame, as counted by [`TouchPattern::pressure`].
    pub const fn number(measured: usize) -> u32 {
        TARE as u32 + (WARM + measured) as u32
    }

    /// Number of measured frames: the last ones.
    pub const fn measured(&self) -> usize {
        self.variant.measured()
    }

    /// Inputs in order; the last scans are the measured ones.
    pub fn steps(&self) -> Result<Vec<Step>> {
        let mut scene = self.scene.clone();
        scene.gestures = self.variant.gestures();
        scene.stream.pressing_hz = if self.variant == Variant::Pressing { u16::MAX } else { 0 };
        let [garment, scene] = [postcard::to_allocvec(&self.garment), postcard::to_allocvec(&scene)];
        let (garment, scene) = (garment?, scene?);
        let ask = |request: &Request<'_>| {
            let mut wire = [0; frame_bound(LONGEST_REQUEST)];
            let frame = encode(request, &mut wire).ok().context("a request too long")?;
            Ok(Step::Receive(frame.to_vec()))
        };
        let mut steps = [
            Request::Stop,
            Request::SetGarment(&garment),
            Request::SetScene(&scene),
            Request::Tare { frames: TARE },
        ]
        .iter()
        .map(ask)
        .collect::<Result<Vec<Step>>>()?;
        steps.extend(self.variant.taught()?);
        let pose = |centidegrees| {
            let angle = JointAngle { joint: 0, centidegrees };
            ask(&Request::Posture(Posture { joints: [angle].into_iter().collect() }))
        };
        steps.push(Step::Fold(self.variant.bends(0).is_some()));
        // The board still knows the last posture of the case before, and tares the arm as that bends it.
        if let Some(first) = self.variant.bends(0) {
            steps.push(pose(first)?);
        }
        let (rest, touch) = self.frames.split_at(TARE.into());
        steps.extend(rest.iter().cloned().map(Step::Scan));
        steps.push(ask(&Request::Start)?);
        for (number, codes) in (0usize..).zip(touch) {
            if let Some(centidegrees) = self.variant.bends(number / 4)
                && number % 4 == 0
            {
                steps.push(pose(centidegrees)?);
            }
            steps.push(Step::Scan(codes.clone()));
        }
        Ok(steps)
    }
}

#[cfg(test)]
mod tests {
    use super::Case;
    use taxel_core::board::{BoardInfo, Shipped};

    #[test]
    fn a_board_accepts_the_garment_and_the_scene_of_each_case() {
        for case in Case::simulated() {
            let taxels: usize =
                case.garment.panels.iter().map(|panel| usize::from(panel.rows * panel.columns)).sum();
            assert!(case.frames.iter().all(|frame| frame.len() == taxels), "{:?}", case.variant);
            let board = Shipped::new(BoardInfo::feather("test"), case.garment, case.scene);
            assert!(board.is_ok(), "{:?}: {:?}", case.variant, board.err());
        }
    }
}
