//! Touches that the simulated garment and the board feel.

use super::displaced::{Case, cases, displaced_at_random, known, read, read_again, surface_of, worst};
use crate::random::Noise;
use taxel::body::fit::{FeltTouch, TouchGatherer};
use taxel::body::{DVec3, PatchOffset};
use taxel::client::Event;
use taxel::sim::{Player, Script};
use taxel::virtual_board::VirtualBoard;
use taxel_core::format::Micros;
use taxel_core::scene::Scene;
use taxel_core::wire::Request;

/// Presses of a fingertip, in taxels of panels, as the simulated garment and the board feel them.
fn felt(case: &Case, presses: &[(usize, f64, f64)], seed: u64) -> Vec<Option<FeltTouch>> {
    use std::fmt::Write;
    const EACH_S: f64 = 0.3;
    let layout = case.layout();
    let mut text = format!("duration_s = {}\nseed = {seed}\n", 1.0 + EACH_S * presses.len() as f64);
    for (number, (panel, x, y)) in presses.iter().enumerate() {
        let start = 0.6 + EACH_S * number as f64;
        let panel = &layout.areas()[*panel].name;
        let _ = write!(
            text,
            "[[touch]]\npanel = \"{panel}\"\nshape = \"finger\"\nforce_n = 5\nat = [{x:?}, {y:?}]\nstart_s = {start:?}\n\
             rise_s = 0.03\nhold_s = 0.06\nfall_s = 0.03\n"
        );
    }
    let script: Script = text.parse().unwrap();
    let mut player = Player::new(&script, &case.garment).unwrap();
    let mut board = VirtualBoard::new(case.garment.clone(), Scene::shipped()).unwrap();
    board.client().request(&Request::Tare { frames: 16 }).unwrap();
    let (mut gatherer, mut all) = (TouchGatherer::default(), vec![None; presses.len()]);
    let mut codes = vec![0; board.taxels()];
    let number = |time_us: u64| (((time_us as f64 * 1e-6 - 0.6) / EACH_S) as usize).min(presses.len() - 1);
    let frames = (1.0 + EACH_S * presses.len() as f64) / 0.01;
    for frame in 0..frames as u64 {
        let time = Micros(frame * 10_000);
        player.frame(time.0, &mut codes);
        let mut gathered = None;
        board
            .step(&codes, time, &mut |client, event| {
                if let Event::Frame { .. } = event {
                    gathered = gatherer.frame(time, client.contacts()).or(gathered);
                }
                Ok(())
            })
            .unwrap();
        if let Some(touch) = gathered {
            // It has ended in the pause after its press.
            all[number(time.0)] = Some(touch);
        }
    }
    all
}

/// A garment displaced by up to 20 mm and 5 degrees is found again from 100 touches that a board has felt,
/// of which a twentieth were somewhere else and others fall beside the garment.
#[test]
fn a_garment_that_is_displaced_is_found_again_by_a_hundred_touches() {
    let runs = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 40 } else { 1 };
    println!("Distance of the taxel that is farthest from where it truly is, mm");
    println!(
        "{:10} {:>5} {:>7} {:>7} {:>7} {:>12}",
        "body", "runs", "median", "95 %", "worst", "within 2 mm"
    );
    let (mut all, mut good) = (0, 0);
    for case in cases() {
        let layout = case.layout();
        let patches = case.patches();
        let mut offs = Vec::new();
        for run in 0..runs {
            let mut random = Noise(1 + 7919 * (run + 1000));
            let offsets: Vec<PatchOffset> = (0..patches).map(|_| displaced_at_random(&mut random)).collect();
            let truly = read_again(&case, &offsets);
            // Beside the edge, too: there a finger is felt in part, or not at all.
            let presses: Vec<(usize, f64, f64)> = (0..100)
                .map(|number| {
                    let area = &layout.areas()[number % patches];
                    let [x, y] =
                        [area.columns, area.rows].map(|count| random.unit() * f64::from(count) - 0.5);
                    (number % patches, x, y)
                })
                .collect();
            let mut touches = Vec::new();
            for ((panel, x, y), felt) in presses.iter().zip(felt(&case, &presses, run)) {
                let Some(felt) = felt else { continue };
                let area = &layout.areas()[*panel];
                let (inner_x, inner_y) =
                    (x.clamp(0.0, f64::from(area.columns - 1)), y.clamp(0.0, f64::from(area.rows - 1)));
                let at = |x, y| truly.at(&layout, *panel as u8, x, y).unwrap().at;
                // Straight on beyond the last taxel.
                let (edge, more) = (at(inner_x, inner_y), at(2.0 * inner_x - x, 2.0 * inner_y - y));
                let mut place = edge * 2.0 - more;
                place += DVec3::new(random.normal(), random.normal(), random.normal()) * 1e-3;
                if random.below(20) == 0 {
                    place += DVec3::new(random.normal(), random.normal(), random.normal()) * 0.05;
                }
                touches.push(known(&truly, &layout, felt, place));
            }
            let read = read(&case, &format!("sim-{run}"), &vec![PatchOffset::default(); patches]);
            let fit = read.fit(&case.garment, &layout, &touches).unwrap();
            let found = surface_of(&fit, &case);
            let off = (0..patches).map(|panel| worst(&found, &truly, &layout, panel)).fold(0.0, f64::max);
            offs.push(off * 1e3);
        }
        offs.sort_by(f64::total_cmp);
        let within = offs.iter().filter(|off| **off <= 2.0).count();
        let [median, most] = [offs[offs.len() / 2], offs[(offs.len() * 95).div_ceil(100) - 1]];
        let worst = offs[offs.len() - 1];
        println!("{:10} {runs:>5} {median:>7.2} {most:>7.2} {worst:>7.2} {within:>12}", case.name);
        (all, good) = (all + offs.len(), good + within);
    }
    assert!(good * 100 >= all * 95, "{good} of {all}");
}
