//! Boards receive maps of 64 concepts by request, and infer like the host.

use taxel::fcm::board::BoardMap;
use taxel::fcm::map::MapFile;
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{Board, BoardInfo, Input};
use taxel_core::format::{Code, Micros, name};
use taxel_core::garment::{Garment, Pins};
use taxel_core::intent::{CONCEPTS, EDGES, Edge, IntentConfig, MapConfig, Rule, Transfer, tactile};
use taxel_core::scene::Scene;
use taxel_core::wire::{IntentReport, LONGEST_REQUEST, Receiver, Report, Request, decode, encode};

const TAXELS: usize = 64;

/// A board of a single block, and its output.
struct Bench {
    board: Box<Board<TAXELS, 32>>,
    receiver: Box<Receiver<8192>>,
    /// Number of frames.
    frame: u64,
}

impl Bench {
    fn new() -> Bench {
        let info = BoardInfo {
            firmware: "",
            chip: "",
            pins: Pins::ANY,
            full_scale: 4095,
            link_bytes_per_s: 1_000_000,
        };
        let board = Board::new(info, Garment::block(), Scene::shipped()).unwrap();
        Bench { board: Box::new(board), receiver: Box::new(Receiver::new()), frame: 0 }
    }

    /// Passes on everything that the board sends at `now`.
    fn reported(&mut self, now: Micros, mut take: impl FnMut(Report<'_>)) {
        while let [byte, ..] = self.board.pending(now, &mut ()) {
            if let Some(body) = self.receiver.push(*byte) {
                take(decode::<(u32, Report<'_>)>(body.unwrap()).unwrap().1);
            }
            self.board.sent(1);
        }
    }

    /// Sends a request. Returns the refusal, if any.
    fn ask(&mut self, request: &Request<'_>) -> Option<String> {
        let mut wire = vec![0; 2 * LONGEST_REQUEST];
        let frame = encode(request, &mut wire).unwrap().to_vec();
        self.board.step(Micros(0), Input::Received(&frame), &mut ());
        let mut refusal = None;
        self.reported(Micros(0), |report| {
            if let Report::Answer(answer) = report {
                refusal = answer.refusal.map(String::from);
            }
        });
        refusal
    }

    /// Scans a frame with this pressure on each of twenty taxels.
    fn scan(&mut self, press: u16) {
        let pressed = |taxel: u16| if (4..9).contains(&(taxel % 16)) { press } else { 0 };
        let codes: Vec<Code> = (0..TAXELS as u16).map(|taxel| Code(90 + pressed(taxel))).collect();
        let report = ScanReport { start: self.now(), ..ScanReport::default() };
        self.frame += 1;
        self.board.step(report.start, Input::Scanned(Ok(Scan { codes: &codes, report })), &mut ());
    }

    fn now(&self) -> Micros {
        Micros(5_000 * self.frame)
    }

    /// Intentions reported during a touch that comes, grows and goes.
    fn touch(&mut self) -> Vec<IntentReport> {
        let mut reports = Vec::new();
        for frame in 0..60u16 {
            self.scan(if (10..50).contains(&frame) { 40 * (frame - 9) } else { 0 });
            self.reported(self.now(), |report| {
                if let Report::Intent(report) = report {
                    reports.push(report);
                }
            });
        }
        reports
    }

    /// Starts streaming, and tares with the next frames.
    fn start(&mut self) {
        assert_eq!(self.ask(&Request::Tare { frames: 4 }), None);
        assert_eq!(self.ask(&Request::Start), None);
    }
}

/// A map of 64 concepts: the inputs of the shipped map, which cause 57 others in many ways, three of them the
/// intentions.
fn large(edges: usize, rule: Rule, transfer: Transfer) -> MapConfig {
    let mut map = MapConfig { rule, transfer, lambda: 700, ..tactile() };
    map.concepts.truncate(7);
    map.inputs.retain(|input| input.concept < 4);
    map.concepts.extend((7..CONCEPTS).map(|at| name(&format!("c{at}"))));
    let effects = CONCEPTS - 4;
    // Each concept except for the inputs gets a cause among these first, then a second one, which is any
    // other, so that there are rings.
    let edge = |k: usize| {
        let (round, effect) = (k / effects, k % effects);
        let from = if round == 0 { k % 4 } else { 4 + (effect + 7 * round) % effects };
        Edge { from: from as u8, to: (4 + effect) as u8, weight: [100, -85, 60, 45, -30, 15][k % 6] }
    };
    map.edges = (0..edges).map(edge).collect();
    map
}

fn scene(map: MapConfig) -> Scene {
    let mut scene =
        Scene { intent: Some(IntentConfig { steps: 64, ..IntentConfig::new(map) }), ..Scene::shipped() };
    scene.react.clear();
    scene
}

#[test]
fn a_board_infers_maps_of_64_concepts_as_the_host_does() {
    let mut reported = 0;
    for (rule, transfer) in [
        (Rule::Kosko, Transfer::Tanh),
        (Rule::Mkosko, Transfer::Sigmoid),
        (Rule::Rescaled, Transfer::Sigmoid),
        (Rule::Kosko, Transfer::Trivalent),
    ] {
        let scene = scene(large(EDGES, rule, transfer));
        let bytes = postcard::to_allocvec(&scene).unwrap();
        assert!(bytes.len() + 3 <= LONGEST_REQUEST, "{} bytes", bytes.len());
        let mut bench = Bench::new();
        assert_eq!(bench.ask(&Request::SetScene(&bytes)), None);
        assert_eq!(bench.board.setup().scene, scene);
        bench.start();
        let host = BoardMap::build(&MapFile::from_config(&scene.intent.as_ref().unwrap().map)).unwrap();
        for report in bench.touch() {
            let value = |at: usize| report.concepts[at].0;
            let one = host.map.one();
            let mut start = [0; _];
            (0..4)
                .for_each(|at| start[at] = (f64::from(value(at)) * f64::from(one) / 32768.0).round() as i32);
            let run = host.map.infer(&start, 64);
            let wanted: Vec<i32> = run.state[..CONCEPTS].iter().map(|x| host.map.q15(*x).0).collect();
            assert_eq!(report.concepts.iter().map(|value| value.0).collect::<Vec<_>>(), wanted);
            assert_eq!((report.steps, report.outcome), (run.steps, run.outcome), "{rule:?} {transfer:?}");
            reported += usize::from(value(0) > 0);
        }
    }
    assert!(reported > 15, "{reported} reports of a touch");
}

/// Encoded scene with a map, after an edit.
fn changed(edit: impl Fn(&mut IntentConfig)) -> Vec<u8> {
    let mut scene = scene(tactile());
    edit(scene.intent.as_mut().unwrap());
    postcard::to_allocvec(&scene).unwrap()
}

#[test]
fn a_bad_map_is_refused_in_one_sentence_and_changes_nothing() {
    let mut bench = Bench::new();
    bench.start();
    let before = bench.touch();
    let good = postcard::to_allocvec(&Scene::shipped()).unwrap();
    let at = good.windows(8).position(|it| it == b"\x07tactile").unwrap() + 8;
    let mut many = good.clone();
    many[at] = 65;
    for (bytes, why) in [
        (
            changed(|it| it.map.edges[3].weight = 101),
            "scene: intent.map: W[press][grip] = 1.01 is outside [-1, 1]",
        ),
        (changed(|it| it.map.lambda = 0), "scene: intent.map: lambda = 0 makes every concept constant"),
        (changed(|it| it.map.decimals = 5), "scene: intent.map: decimals = 5 is outside 0 ..= 4"),
        (changed(|it| it.map.concepts.clear()), "scene: intent.map: the map has no concept"),
        (
            changed(|it| it.map.edges[0].to = 22),
            "scene: intent.map: edge 0 names concept 22, and there are 22",
        ),
        (
            changed(|it| it.map.inputs[0].concept = 200),
            "scene: intent.map: input 0 names concept 200, and there are 22",
        ),
        (changed(|it| it.map.concepts[1] = name("press")), "scene: intent.map: concept press is named twice"),
        (changed(|it| it.steps = 0), "scene: intent.map: steps = 0: an inference needs at least one"),
        (changed(|it| it.level = 1001), "scene: intent.map: level = 1001 thousandths is above 1"),
        (many, "scene: 65 intent.map.concepts, and there is room for 64"),
        (good[..at + 4].to_vec(), "scene: it ends within intent.map.concepts"),
        (good[..good.len() - 1].to_vec(), "scene: it ends within stream"),
        ([&good[..], &[0]].concat(), "scene: bytes after its end: 1"),
        (Vec::new(), "scene: it ends within name"),
    ] {
        assert_eq!(bench.ask(&Request::SetScene(&bytes)).as_deref(), Some(why));
        assert_eq!(bench.board.setup().scene, Scene::shipped());
    }
    // The previous map is still in use, as a whole.
    let mut fresh = Bench::new();
    fresh.start();
    assert_eq!(fresh.touch(), before);
    assert_eq!(bench.touch(), fresh.touch());
    assert!(before.iter().any(|report| report.concepts[0].0 != 0));
    assert_eq!(
        bench.ask(&Request::SetScene(&vec![0; LONGEST_REQUEST])).as_deref(),
        Some("the frame is longer than the receiver can hold")
    );
}

#[test]
fn what_the_old_map_meant_is_not_reported_as_the_new_one_s() {
    let mut bench = Bench::new();
    bench.start();
    bench.touch();
    // The link accepts nothing during a touch, and then the map changes.
    (0..40).for_each(|frame| bench.scan(90 * frame));
    let scene = scene(large(EDGES, Rule::Kosko, Transfer::Tanh));
    let mut wire = vec![0; 2 * LONGEST_REQUEST];
    let bytes = postcard::to_allocvec(&scene).unwrap();
    let frame = encode(&Request::SetScene(&bytes), &mut wire).unwrap().to_vec();
    bench.board.step(bench.now(), Input::Received(&frame), &mut ());
    (0..9).for_each(|_| bench.scan(3000));
    let mut concepts = Vec::new();
    bench.reported(bench.now(), |report| {
        if let Report::Intent(report) = report {
            concepts.push(report.concepts.len());
        }
    });
    assert!(!concepts.is_empty() && concepts.iter().all(|count| *count == CONCEPTS), "{concepts:?}");
}
