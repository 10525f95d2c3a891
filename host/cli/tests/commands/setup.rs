//! Setup by touch of random wirings by a simulated user: right, or not sure, but never wrong.
//!
//! `TAXEL_CAMPAIGN=1` takes 1,000 wirings of the reference garment instead of 50.

use fastrand::Rng;
use taxel::sim::{Decoder, rewire};
use taxel_cli::commands::garment::setup::{Bundle, Found, Next, Solver, User};
use taxel_core::garment::{Circuit, Garment, Layout, Pins};

/// A random wiring, one in four with a dead input, and the result of its setup.
fn set_up(template: &Garment, seed: u64) -> (Garment, Option<u8>, Result<Found, String>) {
    let mut rng = Rng::with_seed(seed);
    let wired = rewire(template, &mut rng);
    let mut solver = Solver::new(template).unwrap();
    let inputs = &solver.bundle().inputs;
    let one_panel_each = template.panels.len() == inputs.len();
    let dead = (one_panel_each && rng.u8(..4) == 0).then(|| inputs[rng.usize(..inputs.len())]);
    let mut user = User::new(&wired, solver.bundle(), dead, rng).unwrap();
    loop {
        match solver.what_next() {
            Next::Ask(ask) => solver.take(user.touch(&ask)),
            Next::Found(found) => return (wired, dead, Ok(*found)),
            Next::NotSure(why) => return (wired, dead, Err(why)),
        }
    }
}

/// True if every address shows the same taxel; addresses of a dead input show none.
fn is_right(bundle: &Bundle, wired: &Garment, dead: Option<u8>, found: &Garment) -> bool {
    let (truth, guess) = (Decoder::build(wired), Decoder::build(found));
    let layout = Layout::build(found, 2048, 4095).unwrap();
    Circuit::build(found, &layout, Pins::ANY).unwrap();
    (0..bundle.addresses()).all(|address| {
        let input = bundle.split(address).0;
        let shown = |decoder: &Decoder, garment: &Garment| {
            decoder.taxel(decoder.address(bundle.levels(address, garment)).unwrap(), input)
        };
        Some(bundle.inputs[input]) == dead || shown(&truth, wired) == shown(&guess, found)
    })
}

/// Numbers of right and of "not sure" results.
fn campaign(template: &Garment, seeds: std::ops::Range<u64>) -> (usize, usize) {
    let bundle = Bundle::of(template).unwrap();
    let (mut right, mut unsure, mut touches, mut margins) = (0, 0, 0, Vec::new());
    for seed in seeds {
        match set_up(template, seed) {
            (wired, dead, Ok(found)) => {
                assert!(is_right(&bundle, &wired, dead, &found.garment), "wiring {seed} was found wrong");
                let buried: Vec<u8> = found.dead.iter().map(|(_, input)| *input).collect();
                assert_eq!(buried, Vec::from_iter(dead), "wiring {seed}");
                right += 1;
                touches += found.touches;
                margins.push(found.margin);
            }
            (.., Err(why)) => {
                unsure += 1;
                println!("{}: wiring {seed}: not sure: {why}", template.name);
            }
        }
    }
    margins.sort_by(f64::total_cmp);
    println!(
        "{}: {right} wirings found right, {unsure} not sure, 0 wrong; {:.1} touches each, margin {:.2} (least {:.2})",
        template.name,
        f64::from(touches) / right.max(1) as f64,
        margins[margins.len() / 2],
        margins[0]
    );
    (right, unsure)
}

#[test]
fn random_wirings_are_found_right_or_not_at_all() {
    let count = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 1_000 } else { 50 };
    let (right, _) = campaign(&Garment::reference(), 0..count);
    assert!(right * 100 >= count as usize * 99, "{right} of {count}");
}

#[test]
fn a_panel_of_many_inputs_is_found_too() {
    let (right, _) = campaign(&Garment::mat(), 0..10);
    assert!(right >= 9, "{right} of 10");
}

#[test]
fn a_stroke_the_wrong_way_round_is_no_garment() {
    // Each stroke down begins at the last row: the corner contradicts it.
    for seed in 0..5 {
        let template = Garment::reference();
        let mut rng = Rng::with_seed(seed);
        let wired = rewire(&template, &mut rng);
        let mut solver = Solver::new(&template).unwrap();
        let mut user = User::new(&wired, solver.bundle(), None, rng).unwrap();
        let why = loop {
            match solver.what_next() {
                Next::Ask(ask) => {
                    let mut touch = user.touch(&ask).unwrap();
                    if ask.panel == 2
                        && matches!(ask.gesture, taxel_cli::commands::garment::setup::Gesture::Down { .. })
                    {
                        let last = touch.moments.last().unwrap().time;
                        touch.moments.reverse();
                        touch.moments.iter_mut().for_each(|moment| moment.time = last - moment.time);
                    }
                    solver.take(Some(touch));
                }
                Next::Found(_) => panic!("found with a stroke the wrong way round"),
                Next::NotSure(why) => break why,
            }
        };
        assert!(why.contains("Panel left arm: press") && why.contains("taxels from there"), "{why}");
    }
}
