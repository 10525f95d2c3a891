//! Median 3x3, Sobel, threshold, labels and moments of a panel: by the core, and by imageproc.

use crate::scenes::{COLUMNS, ROWS, THRESHOLD};
use image::GrayImage;
use imageproc::contrast::{ThresholdType, threshold};
use imageproc::filter::median_filter;
use imageproc::gradients::sobel_gradients;
use imageproc::region_labelling::{Connectivity, connected_components};
use taxel_core::condition::{Condition, ConditionConfig, ConditionState, Filter, Sampled};
use taxel_core::contact::{ContactConfig, ContactState, Contacts};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};

/// A contact as both report it: sum f, sum x f, sum y f.
pub type Sums = (u64, i64, i64);

const TAXELS: usize = ROWS * COLUMNS;

/// The core's stage condition, and of the stage contact what finds and measures. Their Sobel operator is
/// applied where it is used, on the contours; what they do besides (baseline, gain, peaks, bounds) is timed
/// with it.
pub struct Ours {
    layout: Layout,
    condition: Condition,
    contact: Contacts,
    state: (Box<ConditionState<TAXELS>>, Box<ContactState<64, { TAXELS / 2 }>>),
    frame: u64,
}

impl Default for Ours {
    /// Before the first frame, with the panel at rest.
    fn default() -> Ours {
        let layout =
            Layout::build(&Garment::recorded(ROWS as u16, COLUMNS as u16), TAXELS, u16::MAX).unwrap();
        let condition = ConditionConfig { floor: 1, filter: Filter::Median, ..Default::default() };
        let threshold = u16::from(THRESHOLD);
        let contact = ContactConfig { low: threshold, high: threshold, ..Default::default() };
        let mut state = (Box::new(ConditionState::new()), Box::new(ContactState::new()));
        state.0.reset(&layout, Code(0));
        Ours {
            layout,
            condition: condition.build().unwrap(),
            contact: contact.build().unwrap(),
            state,
            frame: 0,
        }
    }
}

impl Ours {
    /// One frame, and the sums of what it found.
    pub fn segment(&mut self, codes: &[Code]) -> impl Iterator<Item = Sums> {
        let (condition, contact) = &mut self.state;
        let sampled = Sampled { codes, falling: false, panels: 1, now: Micros(0) };
        let image = self.condition.process(condition, &self.layout, &sampled, contact.feedback());
        let found = self.contact.segment(contact, &self.layout, &image);
        found.iter().map(|found| (found.moments.m, found.moments.sx, found.moments.sy))
    }

    /// One frame with all that the stages do: axes, ids, velocities, slip. How many contacts it has.
    pub fn follow(&mut self, codes: &[Code]) -> usize {
        self.frame += 1;
        let (condition, contact) = &mut self.state;
        let now = Micros(self.frame * 5128);
        let sampled = Sampled { codes, falling: false, panels: 1, now };
        let image = self.condition.process(condition, &self.layout, &sampled, contact.feedback());
        self.contact.process(contact, &self.layout, &image, now).present.len()
    }
}

/// imageproc's functions, and the sums by label in one pass.
pub fn imageproc(image: &GrayImage) -> Vec<Sums> {
    let smooth = median_filter(image, 1, 1);
    std::hint::black_box(sobel_gradients(&smooth));
    let touched = threshold(&smooth, THRESHOLD - 1, ThresholdType::Binary);
    let labels = connected_components(&touched, Connectivity::Eight, image::Luma([0]));
    let mut sums: Vec<Sums> = Vec::new();
    for (x, y, label) in labels.enumerate_pixels() {
        let Some(index) = label.0[0].checked_sub(1) else { continue };
        if sums.len() <= index as usize {
            sums.resize(index as usize + 1, (0, 0, 0));
        }
        let (sum, value) = (&mut sums[index as usize], smooth.get_pixel(x, y).0[0]);
        sum.0 += u64::from(value);
        sum.1 += i64::from(x) * i64::from(value);
        sum.2 += i64::from(y) * i64::from(value);
    }
    sums
}

/// Both in the order of their sums.
pub fn found(scene: &[u8]) -> (Vec<Sums>, Vec<Sums>) {
    let codes: Vec<Code> = scene.iter().map(|value| Code(u16::from(*value))).collect();
    let (mut ours, mut theirs): (Vec<Sums>, _) =
        (Ours::default().segment(&codes).collect(), imageproc(&panel(scene)));
    ours.sort_unstable();
    theirs.sort_unstable();
    (ours, theirs)
}

/// As imageproc takes it.
pub fn panel(scene: &[u8]) -> GrayImage {
    GrayImage::from_raw(COLUMNS as u32, ROWS as u32, scene.to_vec()).unwrap()
}
