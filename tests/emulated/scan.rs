//! The scan by DMA and PIO on the emulated board: every code of every frame, and how long it all takes.
//! `cargo xtask test --only emulator-scan`; TAXEL_CAMPAIGN=1 (`cargo xtask campaign`): 1,000 frames of the garment.

use crate::board::Emulated;
use serde_json::Value;
use taxel_core::acquire::{Depth, Plan, frame_us};
use taxel_core::capacity::TAXELS;
use taxel_core::format::name;
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::reflex::Agree;
use taxel_core::scene::{Scene, StreamConfig};
use taxel_core::wire::{Report, Request, decode_image};

/// Frames that are shown in turn, no two of them alike.
const FRAMES: usize = 61;

/// Frames of the whole garment that are compared: each that is shown, three times at least.
fn compared() -> u64 {
    if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 1_000 } else { 200 }
}

/// Cycles of the processor in a second.
const CLOCK: f64 = 125e6;

/// An empty garment: a level for each taxel that no neighbour has, and a noise of 7 counts.
fn codes() -> Vec<u16> {
    let level = |taxel: usize| 100 + (taxel * 1367 % TAXELS) as u16;
    let noise = |frame: usize, taxel: usize| ((frame * 7919 + taxel * 104_729) >> 3) as u16 % 7;
    (0..FRAMES * TAXELS).map(|at| level(at % TAXELS) + noise(at / TAXELS, at % TAXELS)).collect()
}

/// A board with an empty garment, whose codes are shown over and over, and knows it for empty.
fn tared(garment: &Garment, scene: &Scene) -> Emulated {
    let mut board = Emulated::start(garment, &codes(), 0, &["--loop"]);
    let garment = postcard::to_allocvec(garment).unwrap();
    let scene = postcard::to_allocvec(scene).unwrap();
    // It hears nothing before it has started.
    board.receive();
    board.obey(&Request::SetGarment(&garment));
    board.obey(&Request::SetScene(&scene));
    board.play();
    board.obey(&Request::Tare { frames: 16 });
    board.obey(&Request::Start);
    board
}

/// What was counted between two looks at a board.
struct Spent {
    frames: u64,
    taxels: u64,
    wrong: u64,
    unseen: u64,
    rate: f64,
    /// Cycles of the stage that scans, per frame.
    scan: u64,
}

/// Lets so many frames pass.
fn measure(board: &mut Emulated, frames: u64) -> Spent {
    let before = board.look("stats");
    let mut after = before.clone();
    let counted = |stats: &Value, what: &str| stats["check"][what].as_u64().unwrap();
    let mut bytes = 0;
    while counted(&after, "frames") < counted(&before, "frames") + frames {
        bytes += board.receive().wire_bytes as u64;
        after = board.look("stats");
    }
    let spent = |what| counted(&after, what) - counted(&before, what);
    let scan = |what| {
        let of = |stats: &Value| stats["marks"]["8"][what].as_u64().unwrap();
        of(&after) - of(&before)
    };
    let us = spent("last_us") as f64;
    let rate = spent("frames") as f64 * 1e6 / us;
    println!(
        "{rate:.2} frames/s over {} frames, {} codes wrong, {} scans unseen; {} cycles of scan and {} bytes sent \
         per frame; {} s emulated in {} s",
        spent("frames"),
        counted(&after, "wrong"),
        spent("unseen"),
        scan("cycles") / scan("count"),
        bytes / spent("frames"),
        after["emulated_us"].as_u64().unwrap() / 1_000_000,
        after["wall_ms"].as_u64().unwrap() / 1_000,
    );
    Spent {
        frames: spent("frames"),
        taxels: spent("taxels"),
        wrong: counted(&after, "wrong"),
        unseen: spent("unseen"),
        rate,
        scan: scan("cycles") / scan("count"),
    }
}

#[test]
fn the_whole_garment_at_the_limit_of_the_converter() {
    let mut board = tared(&Garment::reference(), &Scene::shipped());
    let spent = measure(&mut board, compared());
    board.end();
    assert_eq!((spent.wrong, spent.unseen), (0, 0));
    assert_eq!(spent.taxels, spent.frames * TAXELS as u64);
    assert!(spent.rate >= 195.0);
    assert!((spent.scan as f64) < 0.01 * CLOCK / spent.rate);
}

/// Put back into the order of the taxels, each frame is what the garment showed, in the time of a progressive
/// one.
#[test]
fn the_whole_garment_interlaced() {
    let mut board = tared(&Garment::reference(), &Scene::shipped().interlaced(Agree::Two));
    let spent = measure(&mut board, compared());
    board.end();
    assert_eq!((spent.wrong, spent.unseen), (0, 0));
    assert_eq!(spent.taxels, spent.frames * TAXELS as u64);
    assert!(spent.rate >= 195.0);
}

/// A wiring that a progressive chain cannot follow, as its taxels jump too often, is no matter to an
/// interlaced one.
#[test]
fn a_mirrored_panel_is_interlaced_by_the_chain() {
    let mut garment = Garment::reference();
    garment.blocks.iter_mut().filter(|b| b.panel == 3).for_each(|b| b.orientation.mirror_x = true);
    let mut board = tared(&garment, &Scene::shipped().interlaced(Agree::Two));
    let spent = measure(&mut board, 100);
    board.end();
    assert_eq!((spent.wrong, spent.unseen), (0, 0));
    assert!(spent.rate >= 195.0);
}

#[test]
fn one_panel_alone() {
    let mut scene = Scene::shipped();
    scene.plan.panels = 0b0100;
    let mut board = tared(&Garment::reference(), &scene);
    let spent = measure(&mut board, 300);
    board.end();
    assert_eq!(spent.wrong, 0);
    assert_eq!(spent.taxels, spent.frames * TAXELS as u64 / 4);
    assert!(spent.rate * (spent.frames + spent.unseen) as f64 / spent.frames as f64 >= 480.0);
}

/// Codes that go up and down by 4 from scan to scan: the mean of an even number of scans lies between.
#[test]
fn a_mean_of_scans() {
    let level = |taxel: usize| 100 + (taxel * 1367 % TAXELS) as u16;
    let codes: Vec<u16> = (0..2 * TAXELS).map(|at| level(at % TAXELS) + 4 * (at / TAXELS) as u16).collect();
    let mean: Vec<u16> = (0..TAXELS).map(|taxel| level(taxel) + 2).collect();
    let garment = Garment::reference();
    let mut scene = Scene::shipped();
    scene.stream = StreamConfig { frames_hz: 0, ..StreamConfig::default() };
    let mut board = Emulated::start(&garment, &codes, 0, &["--loop"]);
    board.receive();
    board.obey(&Request::SetGarment(&postcard::to_allocvec(&garment).unwrap()));
    board.play();
    board.obey(&Request::Stream { raw_hz: 10, budget_hz: 1 });
    for depth in [Depth::MeanOf2, Depth::MeanOf4, Depth::MeanOf8] {
        scene.plan.depth = depth;
        board.obey(&Request::SetScene(&postcard::to_allocvec(&scene).unwrap()));
        board.obey(&Request::Start);
        let mut reported = 0;
        while reported < 3 {
            let message = board.receive();
            match message.report() {
                Report::Raw(raw) => {
                    let mut have = vec![0; TAXELS];
                    decode_image(raw.data, None, &mut have).unwrap();
                    assert_eq!(have, mean, "{depth:?}, frame {}", raw.frame);
                    reported += 1;
                }
                Report::Health(health) => println!("{depth:?}: {} us a frame", health.scan_us),
                _ => {}
            }
        }
    }
    // The thermometer is read once a second, whatever the depth; the harness holds it at 27 degrees.
    let celsius = loop {
        if let Report::Temperature(now) = board.receive().report() {
            break now.celsius;
        }
    };
    assert!(celsius.0.abs_diff(2700) < 50, "{celsius:?}");
    board.end();
}

/// However many samples are lost, wherever in a frame: no code of any frame is another taxel's, and what is
/// lost is counted.
#[test]
fn a_chain_that_loses_samples_begins_anew() {
    for depth in [Depth::Twelve, Depth::Interlaced] {
        lose_samples(depth);
    }
}

fn lose_samples(depth: Depth) {
    let mut scene = Scene::shipped();
    scene.plan.depth = depth;
    let mut board = tared(&Garment::reference(), &scene);
    let counted = |board: &mut Emulated| loop {
        if let Report::Health(health) = board.receive().report() {
            return health;
        }
    };
    let before = counted(&mut board);
    let mut images = Vec::new();
    for round in 0..20 {
        // A prime number of frames' parts: never the same place.
        board.starve(1 + round % 7);
        let since = images.len();
        while images.len() < since + 6 {
            if let Report::Frame(image) = board.receive().report() {
                images.push(image.time.0);
            }
        }
    }
    let after = counted(&mut board);
    let stats = board.look("stats");
    board.end();
    let missing: u64 = images.windows(2).map(|pair| (pair[1] - pair[0] + 2_560) / 5_120 - 1).sum();
    let failed = after.failed - before.failed;
    println!(
        "20 losses of samples: {failed} frames refused, {} more lost, {missing} missing in between; {} of {} frames had a \
         wrong code",
        after.overruns - before.overruns,
        stats["check"]["wrong"],
        stats["check"]["frames"],
    );
    assert_eq!(stats["check"]["wrong"].as_u64(), Some(0));
    // A loss in a frame that the board does not take, because another is still on its way, refuses none.
    assert!((1..=20).contains(&failed));
    assert_eq!(u64::from(failed + after.overruns - before.overruns), missing);
}

#[test]
fn a_wiring_that_no_chain_follows_is_scanned_by_the_processor() {
    let mut garment = Garment::reference();
    garment.name = name("mirrored arm");
    garment.blocks.iter_mut().filter(|b| b.panel == 3).for_each(|b| b.orientation.mirror_x = true);
    let mut board = tared(&garment, &Scene::shipped());
    let spent = measure(&mut board, 50);
    board.end();
    assert_eq!((spent.wrong, spent.unseen), (0, 0));
    assert_eq!(spent.taxels, spent.frames * TAXELS as u64);
    // 2,048 conversions of 2 us and 512 times 3 us of settling.
    assert!(spent.scan as f64 > 5.632e-3 * CLOCK);
}

/// Time from frame to frame that a board shows, us: over so many frames, none of them missed.
fn period_us(board: &mut Emulated, frames: u32) -> f64 {
    let mut first = None;
    loop {
        let message = board.receive();
        let Report::Raw(raw) = message.report() else { continue };
        let (frame, time) = *first.get_or_insert((raw.frame, raw.time.0));
        if raw.frame >= frame + frames {
            return (raw.time.0 - time) as f64 / f64::from(raw.frame - frame);
        }
    }
}

/// What a garment asks for, what a scene asks for, and what a frame then takes, within 0.5 % of the one model.
#[test]
fn a_frame_takes_what_the_model_says() {
    const SETTLING: [u32; 8] = [500, 3_000, 4_000, 8_000, 15_000, 34_000, 60_000, 100_000];
    const DEPTHS: [Depth; 6] =
        [Depth::Eight, Depth::Twelve, Depth::MeanOf2, Depth::MeanOf4, Depth::MeanOf8, Depth::Interlaced];
    // A block's frame may be shorter than what the board does with it: some scans are missed then.
    const WHAT_ELSE_US: u64 = 1_000;
    let mut scene = Scene::shipped();
    scene.stream = StreamConfig { frames_hz: 0, ..StreamConfig::default() };
    for mut garment in [Garment::reference(), Garment::mat(), Garment::block()] {
        let layout = Layout::build(&garment, TAXELS, 4095).unwrap();
        let codes: Vec<u16> = (0..layout.taxels()).map(|taxel| 100 + (taxel % 900) as u16).collect();
        let mut board = Emulated::start(&garment, &codes, 0, &["--loop"]);
        board.receive();
        board.obey(&Request::Stream { raw_hz: u16::MAX, budget_hz: 1 });
        board.play();
        // The mat is wired as the reference garment is: it has all of the table in the campaign only.
        let is_sampled = garment.name == "mat-64x32" && std::env::var_os("TAXEL_CAMPAIGN").is_none();
        let settling = if is_sampled { &[500, 15_000] } else { &SETTLING[..] };
        for &settle_ns in settling {
            garment.wiring.settle_ns = settle_ns;
            let circuit = Circuit::build(&garment, &layout, Pins::ANY).unwrap();
            if frame_us(&circuit, &Plan::default()) < WHAT_ELSE_US {
                continue;
            }
            board.obey(&Request::SetGarment(&postcard::to_allocvec(&garment).unwrap()));
            let mut worst = (0.0, 0.0, 0.0);
            for depth in DEPTHS {
                scene.plan.depth = depth;
                board.obey(&Request::SetScene(&postcard::to_allocvec(&scene).unwrap()));
                board.obey(&Request::Start);
                let want = frame_us(&circuit, &scene.plan) as f64;
                let have = period_us(&mut board, 4);
                let off = have / want - 1.0;
                assert!(
                    off.abs() < 0.005,
                    "{}, {settle_ns} ns, {depth:?}: {have} us, not {want}",
                    garment.name
                );
                if f64::abs(off) >= f64::abs(worst.0) {
                    worst = (off, have, want);
                }
            }
            let (off, have, want) = worst;
            println!(
                "{:>10} {settle_ns:>6} ns: {have:.1} us a frame, model {want:.0}: {:+.3} % at worst of {} depths",
                garment.name.as_str(),
                100.0 * off,
                DEPTHS.len()
            );
        }
        board.end();
    }
}
