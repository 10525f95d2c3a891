//! The baseline follows drift and swallows no touch; noise is no touch.

use crate::random::Noise;
use taxel_core::condition::{Condition, ConditionState, Sampled};
use taxel_core::contact::{Contact, ContactState, Contacts};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};
use taxel_core::scene::Scene;

const FULL_SCALE: f64 = 4095.0;
/// At 195 frames/s.
const MINUTE: u32 = 195 * 60;
const HOUR: u32 = 60 * MINUTE;

/// Frames of drift: an hour in a campaign, else a quarter of it at the same pace.
fn drifting() -> u32 {
    if crate::is_campaign() { HOUR } else { HOUR / 4 }
}

/// A garment from its codes to its contacts.
struct BaselineRig {
    layout: Layout,
    condition: Condition,
    contacts: Contacts,
    calibration: Box<ConditionState<2048>>,
    tracks: Box<ContactState<32, 1024>>,
    codes: Vec<Code>,
    frame: u64,
}

impl BaselineRig {
    fn new(garment: &Garment, scene: &Scene) -> BaselineRig {
        let layout = Layout::build(garment, 2048, 4095).expect("it fits");
        let mut calibration = Box::new(ConditionState::new());
        calibration.reset(&layout, Code(0));
        BaselineRig {
            condition: scene.condition.build().expect("settings in range"),
            contacts: scene.contact.build().expect("settings in range"),
            codes: vec![Code(0); layout.taxels()],
            calibration,
            tracks: Box::default(),
            frame: 0,
            layout,
        }
    }

    /// Takes the codes that `code` says of each taxel; the contacts.
    fn frame(&mut self, mut code: impl FnMut(usize) -> f64) -> Vec<Contact> {
        for (taxel, held) in self.codes.iter_mut().enumerate() {
            *held = Code(code(taxel).round().clamp(0.0, FULL_SCALE) as u16);
        }
        self.frame += 1;
        let BaselineRig { layout, condition, contacts, calibration, tracks, codes, .. } = self;
        let now = Micros(self.frame * 5128);
        let sampled = Sampled { codes, falling: false, panels: 0xff, now };
        let image = condition.process(calibration, layout, &sampled, tracks.feedback());
        contacts.process(tracks, layout, &image, now).present.to_vec()
    }
}

/// Uniform noise of up to two counts, over and over: a prime number of values, so that no taxel sees a short
/// period.
fn small_noise() -> impl FnMut() -> f64 {
    let mut random = Noise(7);
    let values: Vec<f64> = (0..65_521).map(|_| random.unit() * 4.0 - 2.0).collect();
    let mut at = 0;
    move || {
        at = (at + 1) % values.len();
        values[at]
    }
}

/// Rows and columns 6 to 9 of a panel of 16 x 16.
fn held(taxel: usize) -> bool {
    (6..10).contains(&(taxel / 16)) && (6..10).contains(&(taxel % 16))
}

/// Holds 16 taxels at 1,000 counts for `frames` under a drift of so many counts per frame (which some taxels
/// do not make), then lets go; the largest error of the pressure.
fn hold(frames: u32, drift: f64, moves: impl Fn(usize) -> bool) -> f64 {
    let mut rig = BaselineRig::new(&Garment::recorded(16, 16), &Scene::shipped());
    let mut noise = small_noise();
    let base = |frame: u32, taxel: usize| 1500.0 + if moves(taxel) { drift * f64::from(frame) } else { 0.0 };
    rig.calibration.tare(64);
    for _ in 0..64 + 170 {
        assert!(rig.frame(|taxel| base(0, taxel) + noise()).is_empty());
    }
    let mut worst = 0.0f64;
    let mut id = None;
    for frame in 0..frames {
        let press = |taxel| if held(taxel) { 1000.0 } else { 0.0 };
        let contacts = rig.frame(|taxel| base(frame, taxel) + press(taxel) + noise());
        assert_eq!(contacts.len(), 1, "frame {frame}");
        assert_eq!(*id.get_or_insert(contacts[0].id), contacts[0].id, "frame {frame}");
        worst = worst.max((f64::from(contacts[0].total) / 16_000.0 - 1.0).abs());
    }
    for frame in 0..500 {
        let left = rig.frame(|taxel| base(frames, taxel) + noise());
        assert!(frame < 10 || left.is_empty(), "frame {frame} after release: {left:?}");
    }
    worst
}

#[test]
fn a_contact_held_for_half_an_hour_keeps_its_pressure_within_half_a_percent() {
    let worst = hold(30 * MINUTE, 0.0, |_| true);
    println!("largest error {:.3} %", worst * 100.0);
    assert!(worst <= 0.005);
}

#[test]
fn held_under_drift_within_two_percent_and_gone_ten_frames_after_release() {
    for sign in [1.0, -1.0] {
        let worst = hold(drifting(), sign * 0.2 * FULL_SCALE / f64::from(HOUR), |_| true);
        println!("largest error {:.3} %", worst * 100.0);
        assert!(worst <= 0.02);
    }
}

#[test]
fn frozen_taxels_follow_the_median_not_the_mean() {
    // A third of the panel is stuck; a mean would fall behind by a third of the drift, 91 of 1,000 counts.
    let stuck = |taxel: usize| taxel.is_multiple_of(3) && !held(taxel);
    let worst = hold(HOUR / 3, 0.2 * FULL_SCALE / f64::from(HOUR), |taxel| !stuck(taxel));
    println!("largest error {:.3} %", worst * 100.0);
    assert!(worst <= 0.02);
}

#[test]
fn idle_drift_leaves_no_contact() {
    // The reference garment has 128 rows: the longest turn.
    for drift in [1.0, -1.0].map(|sign| sign * 0.2 * FULL_SCALE / f64::from(HOUR)) {
        let mut rig = BaselineRig::new(&Garment::recorded(128, 2), &Scene::shipped());
        let mut noise = small_noise();
        rig.calibration.tare(64);
        for frame in 0..drifting() {
            let base = 1500.0 + drift * f64::from(frame);
            let contacts = rig.frame(|_| base + noise());
            assert!(contacts.is_empty(), "frame {frame}: {contacts:?}");
        }
        let (first, last) = (1500.0, f64::from(rig.calibration.baseline().expect("no tare")[0]));
        assert!((last - first - drift * f64::from(drifting())).abs() <= 4.0, "{last}");
    }
}

/// Two percent of full scale, as a standard deviation.
const NOISE: f64 = 0.02 * FULL_SCALE;

fn noisy() -> (BaselineRig, Noise) {
    let mut rig =
        BaselineRig::new(&Garment::reference(), &Scene::shipped().against_noise(NOISE.ceil() as u16));
    let mut random = Noise(0x5eed);
    rig.calibration.tare(64);
    for _ in 0..64 {
        noisy_frame(&mut rig, &mut random, |_| 0.0);
    }
    (rig, random)
}

fn noisy_frame(rig: &mut BaselineRig, random: &mut Noise, press: impl Fn(usize) -> f64) -> Vec<Contact> {
    rig.frame(|taxel| 800.0 + press(taxel) + NOISE * random.normal())
}

#[test]
fn noise_of_two_percent_begins_no_contact_in_24_000_frames() {
    let (mut rig, mut random) = noisy();
    for frame in 0..24_000 {
        let contacts = noisy_frame(&mut rig, &mut random, |_| 0.0);
        assert!(contacts.is_empty(), "frame {frame}: {contacts:?}");
    }
}

#[test]
fn under_that_noise_a_light_touch_is_found_within_two_frames_each_of_1_000_times() {
    let (mut rig, mut random) = noisy();
    let mut first = 0;
    for trial in 0..1_000 {
        let panel = random.below(4) as usize;
        let (row, column) = (random.below(31) as usize, random.below(15) as usize);
        let corner = panel * 512 + row * 16 + column;
        let touched = [corner, corner + 1, corner + 16, corner + 17];
        let mut found = false;
        for frame in 0..2 {
            let press = |taxel| if touched.contains(&taxel) { 0.1 * FULL_SCALE } else { 0.0 };
            let contacts = noisy_frame(&mut rig, &mut random, press);
            assert!(contacts.len() <= 1, "trial {trial}: {contacts:?}");
            let there = |contact: &Contact| {
                let (x, y) = (contact.x.to_f64(), contact.y.to_f64());
                usize::from(contact.panel) == panel
                    && (x - column as f64 - 0.5).abs() < 1.0
                    && (y - row as f64 - 0.5).abs() < 1.0
            };
            found |= contacts.iter().any(there);
            first += usize::from(found && frame == 0);
        }
        assert!(found, "trial {trial}");
        for frame in 0..12 {
            let left = noisy_frame(&mut rig, &mut random, |_| 0.0);
            assert!(frame < 10 || left.is_empty(), "trial {trial}, {frame} frames after release: {left:?}");
        }
    }
    println!("{first} of 1,000 in the first frame");
    assert!(first >= 990);
}
