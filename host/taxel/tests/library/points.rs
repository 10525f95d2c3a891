//! Small hard objects in the shipped scene: the share of their force that is reported at any position, and
//! the delay.

use taxel::files::scripts;
use taxel::sim::{FRAME_PERIOD_US, Player};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};
use taxel_core::pipeline::{Pipeline, PipelineState};
use taxel_core::scene::Scene;

/// Frames averaged by the tare, and the frame in which the object begins to press.
const TARE: u16 = 16;
const BEGIN: u64 = 40;
/// Counts per newton.
const COUNTS: f64 = 1000.0;

/// For each frame of an object pressed on the chest: the total of all contacts, N, and the largest code.
fn reported(size_mm: f64, force_n: f64, at: [f64; 2], rise_s: f64, frames: u64) -> Vec<(f64, u16)> {
    let start_s = (BEGIN * FRAME_PERIOD_US) as f64 / 1e6;
    let text = format!(
        "duration_s = 2\nseed = 5\n[[touch]]\npanel = \"chest\"\nshape = \"finger\"\nsize_mm = {size_mm}\n\
         at = [{}, {}]\nforce_n = {force_n}\nstart_s = {start_s}\nrise_s = {rise_s}\nhold_s = 1\n",
        at[0], at[1]
    );
    let (script, garment) = (scripts::parse(&text, "point.toml").unwrap(), Garment::reference());
    let layout = Layout::build(&garment, TAXELS, 4095).unwrap();
    let pipeline = Pipeline::build(&Scene::shipped(), &layout).unwrap();
    let mut state = Box::new(PipelineState::<TAXELS, { TAXELS / 2 }>::default());
    state.reset(&layout, false, 4095);
    state.condition.tare(TARE);
    let mut player = Player::new(&script, &garment).unwrap();
    let mut raw = vec![0u16; TAXELS];
    let mut frame = |number: u64| {
        player.frame(number * FRAME_PERIOD_US, &mut raw);
        let codes: Vec<Code> = raw.iter().map(|code| Code(*code)).collect();
        let now = Micros(number * FRAME_PERIOD_US);
        let percept = pipeline.process(&mut *state, &layout, &codes, false, now, &mut ());
        let total: u32 = percept.present.iter().map(|placed| placed.contact.total).sum();
        (f64::from(total) / COUNTS, raw.iter().copied().max().unwrap_or(0))
    };
    (0..BEGIN + frames).map(&mut frame).collect()
}

/// Positions over the area of a taxel in the middle of the chest.
fn places() -> impl Iterator<Item = [f64; 2]> {
    (0..36).map(|place| [8.0 + f64::from(place % 6) / 6.0, 15.0 + f64::from(place / 6) / 6.0])
}

#[test]
fn the_force_of_small_things_is_reported_wherever_they_land() {
    println!("size, mm   force, N   reported, N: least, greatest");
    for (size_mm, force_n) in
        [8.0, 12.0, 16.0].into_iter().flat_map(|size| [1.0, 2.0, 3.5].map(|f| (size, f)))
    {
        let (mut least, mut greatest) = (f64::MAX, 0f64);
        for at in places() {
            let (force, code) = reported(size_mm, force_n, at, 0.03, 40).pop().unwrap();
            assert!(code < 4095, "no taxel is full");
            (least, greatest) = (least.min(force), greatest.max(force));
        }
        println!("{size_mm:8} {force_n:10} {least:18.3} {greatest:9.3}");
        assert!(least >= 0.9 * force_n && greatest <= 1.1 * force_n, "{size_mm} mm, {force_n} N");
        assert!(greatest <= 1.15 * least, "{size_mm} mm, {force_n} N");
    }
}

/// The first frame is that in which a single taxel would begin a contact.
#[test]
fn a_needle_is_felt_within_three_frames() {
    let high = Scene::shipped().contact.high;
    for (at, rise_s) in places().flat_map(|at| [0.001, 0.02, 0.08].map(|rise_s| (at, rise_s))) {
        let reported = reported(4.0, 8.0, at, rise_s, 40);
        let rest = reported[usize::from(TARE)..BEGIN as usize].iter().map(|it| it.1).max().unwrap();
        let shows = reported.iter().position(|(_, code)| *code >= rest + high).unwrap();
        let felt = reported.iter().position(|(force, _)| *force > 0.0).unwrap();
        assert!(felt < shows + 3, "at {at:?}: shown in frame {shows}, felt in {felt}");
        // A taxel saturates at 4 N.
        assert!(reported.last().unwrap().0 >= 3.8, "at {at:?}: {:?}", reported.last());
    }
}
