//! How deep the stack of the firmware gets on the emulated board, over what needs most of it.
//! `cargo xtask test --only emulator-stack`.

use crate::board::Emulated;
use fastrand::Rng;
use taxel_core::capacity::TAXELS;
use taxel_core::condition::Filter;
use taxel_core::format::{Name, name};
use taxel_core::garment::{Absent, Block, Garment, Line, Panel, Seam, SeamEdge, Side};
use taxel_core::intent::{CONCEPTS, Edge as Link, Map, MapInput, Source, Threshold};
use taxel_core::react::{Cause, ReactionConfig};
use taxel_core::scene::{Friendliness, Scene};
use taxel_core::wire::{Hello, IntentReport, LONGEST_REQUEST, Report, Request};

/// What must stay free of the 48 KiB that memory.x sets aside: bytes.
const MARGIN: u64 = 30 * 1024;
/// Columns of a panel of the reference garment.
const COLUMNS: usize = 16;
/// Different frames, and how often they are shown, each time with other random numbers.
const KINDS: u32 = 4;
const ROUNDS: u32 = 40;
/// Inputs of the greatest map, each a cause of others, and the most steps of an inference.
const INPUTS: usize = 8;
const STEPS: u16 = 64;
/// Code at rest.
const REST: u16 = 90;

/// Rounds of a saturated frame with texture, noise over the full scale, forty contacts and a checkerboard.
fn codes() -> Vec<u16> {
    let mut random = Rng::with_seed(1);
    let mut codes = Vec::new();
    for _ in 0..ROUNDS {
        codes.extend((0..TAXELS).map(|_| 2048 + random.u16(..2048)));
        codes.extend((0..TAXELS).map(|_| random.u16(..4096)));
        codes.extend((0..TAXELS).map(|taxel| {
            let (row, column) = (taxel / COLUMNS % 32, taxel % COLUMNS);
            let touched = row % 6 < 3 && row < 30 && column % 8 < 3;
            REST + if touched { 800 + random.u16(..200) } else { random.u16(..6) }
        }));
        codes.extend((0..TAXELS).map(|taxel| {
            let touched = (taxel / COLUMNS + taxel).is_multiple_of(2);
            REST + if touched { 900 + random.u16(..200) } else { 0 }
        }));
    }
    codes
}

/// As many sixteen-letter names as a list holds.
fn names<const N: usize>(of: &str) -> heapless::Vec<Name, N> {
    (0..N).map(|index| name(&format!("{of:-<14}{index:02}"))).collect()
}

/// The wiring of the reference garment, with everything in it that a garment can have.
fn greatest_garment() -> Garment {
    let mut garment = Garment::reference();
    // The lines form the same address: its upper four bits choose a block, the next its row.
    let row = garment.wiring.row.lines.remove(0);
    garment.wiring.block.lines.insert(0, row).unwrap();
    garment.wiring.block.lines.swap(0, 1);
    garment.wiring.enable = [20, 24, 25].map(|pin| Line { pin, inverted: true }).into_iter().collect();
    garment.wiring.settle_ns = 1000;
    let panel = |(title, region)| Panel {
        name: title,
        link: name("sixteen-letters-"),
        region,
        rows: 16,
        columns: 16,
        pitch_um: [u16::MAX.into(), u16::MAX.into()],
    };
    garment.panels = names::<8>("panel").into_iter().zip(names::<8>("region")).map(panel).collect();
    let block = |index: u8| Block {
        panel: index / 8,
        row: u16::from(index % 8) * 2,
        rows: 2,
        input: 26 + index / 16,
        select: u16::from(index % 16),
        ..garment.blocks[0].clone()
    };
    garment.blocks = (0..64).map(block).collect();
    // Along both flanks of two panels, as on the torso.
    let edge = |panel, side| SeamEdge { panel, side, start: 0 };
    let seam = |index: u8| {
        let (one, other) =
            if index.is_multiple_of(2) { (Side::Left, Side::Right) } else { (Side::Right, Side::Left) };
        let panel = index / 2 * 2;
        Seam { a: edge(panel, one), b: edge(panel + 1, other), length: 16, reversed: false }
    };
    garment.seams = (0..8).map(seam).collect();
    let absent = |index: u8| Absent {
        panel: index % 8,
        row: u16::from(index / 8) * 4,
        column: 15,
        rows: 1,
        columns: 1,
    };
    garment.absent = (0..32).map(absent).collect();
    garment
}

/// A scene for it with everything in it that a scene can have; what is touched is not filtered.
fn greatest_scene() -> Scene {
    let mut scene = Scene { name: name("sixteen-letters-"), ..Scene::shipped() };
    scene.condition.filter = Filter::Off;
    let intent = scene.intent.as_mut().unwrap();
    intent.steps = STEPS;
    let map = &mut intent.map;
    // As many as there may be, by names with which they fit into a request.
    map.concepts = (0..map.concepts.capacity()).map(|index| name(&format!("c{index:02}"))).collect();
    for (intention, place) in ["kindness", "threat", "attack"].into_iter().zip(&mut map.concepts[8..]) {
        *place = name(intention);
    }
    map.decimals = 4;
    // Eight inputs, and each of the first is a cause of all others.
    let effects = map.concepts.len() as u8 - 8;
    let link = |k: u8| Link { from: k / effects, to: 8 + k % effects, weight: 10_000 - i16::from(k) * 70 };
    map.edges = (0..=u8::MAX).map(link).collect();
    assert!(map.edges.is_full() && map.concepts.is_full());
    map.thresholds = (0..64).map(|concept| Threshold { concept, value: -5000 }).collect();
    let sources =
        [Source::Press, Source::Breadth, Source::Friendliness, Source::Duration, Source::Speed, Source::Rise];
    let sources = sources.into_iter().chain((0..2).map(Source::Host));
    let input = |(source, concept)| MapInput {
        concept,
        source,
        low: 0,
        // A touch lasts longer in every frame, so that there is always something new to infer from.
        high: if source == Source::Duration { 1000 } else { i32::MAX },
        at_low: -10_000,
        at_high: 10_000,
    };
    map.inputs = sources.zip(0..).map(input).collect();
    scene.friendliness =
        names::<8>("region").into_iter().map(|region| Friendliness { region, percent: -100 }).collect();
    scene.joints = names("joint");
    let reaction = |(index, region): (u8, Name)| ReactionConfig {
        name: name(&format!("sixteen-letters{index}")),
        cause: Cause::Force,
        region,
        level: 1000,
        hysteresis: 500,
        hold_ms: 1,
        output: (index < 2).then_some(Line { pin: 18 + index, inverted: true }),
    };
    scene.react = (0u8..).zip(names::<8>("region")).map(reaction).collect();
    scene
}

/// Asks for something and waits for the answer; why it is refused.
fn refused(board: &mut Emulated, request: &Request<'_>) -> String {
    board.ask(request);
    loop {
        if let Report::Answer(answer) = board.receive().report() {
            return answer.refusal.expect("it is refused").to_string();
        }
    }
}

/// Whether a board reported just what this machine infers from the inputs that it reported.
fn agrees(report: &IntentReport, map: &Map) -> bool {
    let mut start = [0; CONCEPTS];
    let inputs = start.iter_mut().zip(&report.concepts).take(INPUTS);
    inputs.for_each(|(to, value)| *to = value.0);
    let run = map.infer(&start, STEPS);
    let reported = report.concepts.iter().map(|value| value.0);
    run.state.into_iter().take(map.len()).eq(reported)
        && (run.steps, run.outcome) == (report.steps, report.outcome)
}

/// Waits until all kinds of frames were shown twice; says how much was sent meanwhile. With a map, inferences
/// are compared.
fn watch(board: &mut Emulated, map: Option<&Map>) {
    let (mut first, mut bytes, mut inferred) = (None, 0, 0);
    loop {
        let message = board.receive();
        bytes += message.wire_bytes;
        let frame = match message.report() {
            Report::Frame(frame) => frame,
            Report::Intent(report) if map.is_some() => {
                assert!(map.is_some_and(|map| agrees(&report, map)), "{report:?}");
                inferred += 1;
                continue;
            }
            _ => continue,
        };
        let frames = frame.frame - *first.get_or_insert(frame.frame);
        if frames >= 2 * KINDS {
            assert!(map.is_none() || inferred > 0, "nothing is inferred");
            return println!(
                "{:>24} {:>6} bytes sent for each scan, {inferred} inferences compared",
                "",
                bytes / frames as usize
            );
        }
    }
}

/// What is reported first: the setup as it is, empty where it does not fit.
fn hello(board: &mut Emulated) -> (Vec<u8>, Vec<u8>) {
    loop {
        if let Report::Hello(Hello { garment, scene, .. }) = board.receive().report() {
            return (garment.to_vec(), scene.to_vec());
        }
    }
}

#[test]
fn the_stack_has_room() {
    let garment = postcard::to_allocvec(&greatest_garment()).unwrap();
    let scene = postcard::to_allocvec(&greatest_scene()).unwrap();
    let shipped = postcard::to_allocvec(&Scene::shipped()).unwrap();
    let mut board = Emulated::start(&Garment::reference(), &codes(), REST, &[]);
    let mut worst = 0;
    let mut free = |board: &mut Emulated, during: &str| {
        let seen = board.look("stack");
        let (used, size) = (seen["used"].as_u64().unwrap(), seen["size"].as_u64().unwrap());
        println!("{during:>24} {used:>6} of {size} bytes of stack");
        worst = worst.max(used);
        size - worst
    };
    hello(&mut board);
    free(&mut board, "start");
    board.obey(&Request::Tare { frames: 4 });
    board.obey(&Request::Start);
    board.play();
    free(&mut board, "tare");
    watch(&mut board, None);
    free(&mut board, "frames");
    board.obey(&Request::SetGarment(&garment));
    free(&mut board, "greatest garment");
    board.obey(&Request::SetScene(&scene));
    free(&mut board, "greatest scene");
    board.ask(&Request::Start);
    assert_eq!(hello(&mut board), (garment, scene), "they are reported whole");
    free(&mut board, "greatest hello");
    let map = Map::build(&greatest_scene().intent.unwrap().map).unwrap();
    watch(&mut board, Some(&map));
    free(&mut board, "frames, all of it on");
    let mut wrong = greatest_garment();
    wrong.blocks[63].select = 0;
    let wrong = postcard::to_allocvec(&wrong).unwrap();
    let why = refused(&mut board, &Request::SetGarment(&wrong));
    assert!(why.starts_with("garment: blocks"), "{why}");
    free(&mut board, "refused garment");
    refused(&mut board, &Request::SetScene(&vec![1; LONGEST_REQUEST - 16]));
    free(&mut board, "no scene");
    board.obey(&Request::SetScene(&shipped));
    watch(&mut board, None);
    let free = free(&mut board, "shipped scene, frames");
    println!("{free} bytes always free; {} us", board.look("stats")["emulated_us"]);
    assert!(free >= MARGIN);
    board.end();
}
