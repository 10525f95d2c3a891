//! Impulses on the reference garment, from the code of a taxel to the contact: none where each is one frame
//! long and alone, and how many where nothing keeps them apart.

use crate::random::Noise;
use crate::tracking::rig::FRAME_US;
use taxel_core::capacity::TAXELS;
use taxel_core::condition::{Condition, ConditionState, Sampled};
use taxel_core::contact::{ContactState, Contacts};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};
use taxel_core::scene::Scene;

const REST: u16 = 100;
const FULL: u16 = 4095;

/// Conditioning and contacts of the shipped scene.
struct Dressed {
    layout: Layout,
    condition: Condition,
    contacts: Contacts,
    image: Box<ConditionState<TAXELS>>,
    state: Box<ContactState<32, 1024>>,
    frame: u64,
    /// Id of the youngest contact.
    newest: u32,
}

impl Dressed {
    fn new() -> Dressed {
        let scene = Scene::shipped();
        let layout = Layout::build(&Garment::reference(), TAXELS, FULL).unwrap();
        let mut image = Box::new(ConditionState::new());
        image.reset(&layout, Code(REST));
        let (condition, contacts) = (scene.condition.build().unwrap(), scene.contact.build().unwrap());
        Dressed { layout, condition, contacts, image, state: Box::default(), frame: 0, newest: 0 }
    }

    /// How many contacts begin in a frame.
    fn begin(&mut self, codes: &[Code]) -> u32 {
        let now = Micros(self.frame * FRAME_US);
        let sampled = Sampled { codes, falling: false, panels: 0xf, now };
        let image = self.condition.process(&mut self.image, &self.layout, &sampled, self.state.feedback());
        let touches = self.contacts.process(&mut self.state, &self.layout, &image, now);
        let newest = touches.present.iter().map(|contact| contact.id).max().unwrap_or(0).max(self.newest);
        self.frame += 1;
        newest - std::mem::replace(&mut self.newest, newest)
    }
}

/// Noise of 3 counts on every taxel.
fn idle(noise: &mut Noise, codes: &mut [Code]) {
    codes.iter_mut().for_each(|code| code.0 = (f64::from(REST) + 3.0 * noise.normal()).round() as u16);
}

/// 10,000 frames, or 100,000 in a campaign. In each, one taxel in a hundred is hit where it and its
/// neighbours rested for 8 frames.
#[test]
fn impulses_of_one_frame_begin_no_contact() {
    let frames = if crate::is_campaign() { 100_000 } else { 10_000 };
    let (mut dressed, mut noise, mut rng) = (Dressed::new(), Noise(1), Noise(7));
    let mut codes = vec![Code(REST); TAXELS];
    let areas = dressed.layout.areas().to_vec();
    // When each taxel and its neighbours rest again.
    let mut rests = vec![0u32; TAXELS];
    let mut impulses = 0;
    for frame in 0..frames {
        idle(&mut noise, &mut codes);
        for _ in 0..TAXELS / 100 {
            let mut below = |count: u16| (rng.unit() * f64::from(count)) as u16;
            let area = &areas[usize::from(below(areas.len() as u16))];
            let (row, column, height) = (below(area.rows), below(area.columns), below(FULL - REST - 20));
            let rows = row.saturating_sub(1)..=(row + 1).min(area.rows - 1);
            let columns = column.saturating_sub(1)..=(column + 1).min(area.columns - 1);
            let taxel = |row: u16, column: u16| usize::from(area.base + row * area.columns + column);
            if rests[taxel(row, column)] > frame {
                continue;
            }
            for (row, column) in rows.flat_map(|row| columns.clone().map(move |column| (row, column))) {
                rests[taxel(row, column)] = frame + 9;
            }
            codes[taxel(row, column)] = Code(FULL - height);
            impulses += 1;
        }
        assert_eq!(dressed.begin(&codes), 0, "frame {frame}");
    }
    println!("{frames} frames, {impulses} impulses: no contact");
    assert!(impulses > 5 * frames);
}

/// Contacts that independent impulses begin in a frame, to first order: on 2,048 taxels two frames running,
/// and on one of the 7,624 pairs of neighbours at once.
fn expected(part: f64) -> f64 {
    (2048.0 + 7624.0) * part * part
}

/// The table of `docs/evidence/bounds.md`. Some contacts have several causes, so that fewer begin than to first
/// order.
#[test]
fn independent_impulses_begin_as_many_contacts_as_is_reported() {
    let (part, frames) = (0.01, 4_000u32);
    let (mut dressed, mut noise) = (Dressed::new(), Noise(3));
    let mut codes = vec![Code(REST); TAXELS];
    let mut begun = 0;
    for _ in 0..frames {
        codes.fill(Code(REST));
        let hit = codes.iter_mut().filter(|_| noise.unit() < part);
        hit.for_each(|code| code.0 = FULL);
        begun += dressed.begin(&codes);
    }
    let (expected, measured) = (expected(part), f64::from(begun) / f64::from(frames));
    let line = format!("{:6} % {frames:10} {expected:14.6} {measured:12.6}", 100.0 * part);
    println!("impulses     frames   contacts begun a frame: expected, measured\n{line}");
    let reported = include_str!("../../../../docs/evidence/bounds.md");
    assert!(reported.contains(&line), "docs/evidence/bounds.md does not hold this line");
    assert!((0.8..1.0).contains(&(measured / expected)));
}
