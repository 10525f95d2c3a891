//! Forces by link of light and strong presses, in the noise of a real taxel, against what presses.

use crate::random::Noise;
use std::fmt::Write;
use taxel::body::{self, DVec3, Surface};
use taxel::client::{Event, SceneChange};
use taxel::files::scripts;
use taxel::session::setting;
use taxel::sim::{FRAME_PERIOD_US, World};
use taxel::virtual_board::VirtualBoard;
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout};
use taxel_core::scene::Scene;
use taxel_core::wire::{PressingReport, Request};

/// Noise of a taxel as docs/figures.md states it, counts rms.
const NOISE: f64 = 3.9;
/// Presses, one after the other; how long each is and how long nothing touches before it, s.
const PRESSES: usize = 40;
const EACH_S: f64 = 1.0;
/// Start of the first one: until then the board stores its table, and tares, s.
const FIRST_S: f64 = 5.5;
/// Most force on a taxel that does not saturate, N.
const MOST_N: f32 = 3.8;

/// A script of presses of 0.3 to 20 N anywhere on a garment, each second one of which moves.
fn presses(garment: &Garment) -> String {
    let mut random = Noise(63);
    let mut text =
        format!("duration_s = {}\n[idle]\nnoise_counts = {NOISE}\n", FIRST_S + PRESSES as f64 * EACH_S);
    for press in 0..PRESSES {
        let panel = &garment.panels[random.below(garment.panels.len() as u64) as usize];
        let shape = ["finger", "ball", "box"][random.below(3) as usize];
        let force = 0.3 * (20.0f64 / 0.3).powf(random.unit());
        let [x, y] = [panel.columns, panel.rows].map(|count| random.unit() * f64::from(count - 1));
        let velocity = if press % 2 == 0 { 0.0 } else { 6.0 * random.unit() - 3.0 };
        let start = FIRST_S + press as f64 * EACH_S;
        writeln!(
            text,
            "[[touch]]\npanel = \"{}\"\nshape = \"{shape}\"\nforce_n = {force}\nat = [{x}, {y}]\nvelocity = \
             [{velocity}, {velocity}]\nstart_s = {start}\nrise_s = 0.2\nhold_s = 0.4\nfall_s = 0.1",
            panel.name
        )
        .unwrap();
    }
    text
}

/// Force (N) on each link at the time of a report, and what the board says of it. Nothing of a scan in which a
/// taxel saturates.
fn compared(world: &World, surface: &Surface, report: &PressingReport) -> Vec<[f64; 2]> {
    let newtons: Vec<f32> =
        (0..world.taxels()).map(|taxel| world.newtons(taxel, report.time.0 * 1000)).collect();
    let mut forces = vec![DVec3::ZERO; surface.links().len()];
    if newtons.iter().any(|newtons| *newtons > MOST_N) {
        return Vec::new();
    }
    for (place, newtons) in surface.places().iter().zip(newtons) {
        if let Some(place) = place {
            forces[place.link] -= place.normal * f64::from(newtons);
        }
    }
    let reported = report.links.iter().map(|wrench| (usize::from(wrench.link), wrench.force));
    let along = |(link, force): (usize, [i32; 3])| {
        let force = DVec3::from(force.map(|counts| f64::from(counts) * 1e-3));
        [forces[link].length(), force.dot(forces[link].normalize_or_zero())]
    };
    reported.map(along).collect()
}

/// Without the taxels beside a contact, light presses read a tenth too low.
#[test]
fn a_force_is_all_that_presses() {
    let garment = Garment::reference();
    let layout = Layout::build(&garment, 2048, 4095).unwrap();
    let surface = body::read("reference").unwrap().surface(&garment, &layout).unwrap();
    let script = scripts::parse(&presses(&garment), "presses.toml").unwrap();
    let world = World::build(&script, &garment).unwrap();
    let mut board = VirtualBoard::new(garment, Scene::shipped()).unwrap();
    setting::set_body(board.client(), "reference", "reference").unwrap();
    let (mut codes, mut all) = (vec![0u16; layout.taxels()], Vec::new());
    for frame in 0..(script.duration_s * 1e6) as u64 / FRAME_PERIOD_US {
        let us = frame * FRAME_PERIOD_US;
        codes.iter_mut().enumerate().for_each(|(taxel, code)| *code = world.code(taxel, us * 1000));
        if frame == 800 {
            board.client().request(&Request::Tare { frames: 64 }).unwrap();
            board.client().change_scene(SceneChange::pressing(u16::MAX));
        }
        let mut reported = |_: &_, event: &Event| {
            if let Event::Pressing(report) = event
                // While it is held.
                && (0.2..0.6).contains(&((report.time.0 as f64 * 1e-6 - FIRST_S).rem_euclid(EACH_S)))
            {
                all.extend(compared(&world, &surface, report));
            }
            Ok(())
        };
        board.step(&codes, Micros(us), &mut reported).unwrap();
    }
    let mut medians = Vec::new();
    for (from, to) in [(0.3, 1.0), (1.0, 3.0), (3.0, 40.0)] {
        let within = all.iter().filter(|[want, _]| (from..to).contains(want));
        let mut errors: Vec<f64> = within.map(|[want, is]| is / want - 1.0).collect();
        errors.sort_by(f64::total_cmp);
        let close = errors.iter().filter(|error| error.abs() < 0.03).count() as f64 / errors.len() as f64;
        let median = errors[errors.len() / 2];
        println!(
            "{from} to {to} N: {} scans, median {:.2} %, within 3 % in {:.1} %",
            errors.len(),
            100.0 * median,
            100.0 * close
        );
        medians.push((median, close));
    }
    let [(light, _), (middle, _), (strong, close)] = medians[..] else { panic!() };
    assert!(light.abs() < 0.02 && middle.abs() < 0.01 && strong.abs() < 0.005, "{medians:?}");
    assert!(close > 0.95, "{close}");
}
