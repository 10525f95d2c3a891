//! Contacts, symbols, intention and surface as a host knows them: those of the board, whatever is asked of the
//! board while something touches it.

use crate::board::{BoardAndHost, FINGER, flat};
use std::collections::BTreeSet;
use std::sync::LazyLock;
use taxel_core::board::TableKind;
use taxel_core::contact::Phase;
use taxel_core::garment::Garment;
use taxel_core::gesture::GestureConfig;
use taxel_core::intent::Leading;
use taxel_core::scene::Scene;
use taxel_core::wire::{ContactList, Report, Request, SymbolList};

/// Taxels under three fingertips.
const FINGERS: [[usize; 4]; 3] = [FINGER, [25, 26, 41, 42], [29, 30, 45, 46]];

static SURFACE: LazyLock<Vec<u8>> = LazyLock::new(flat);

/// A host that knows what it was sent.
#[derive(Default)]
struct Host {
    garment: Vec<u8>,
    contacts: BTreeSet<u32>,
    /// Contacts that have words.
    worded: BTreeSet<u32>,
    regions: BTreeSet<u8>,
    leading: Leading,
    /// Contacts that press on links, and those that touch regions of the surface.
    surface: [usize; 2],
    /// It has just sent `Start` or `Stop`.
    is_new: bool,
    refusals: Vec<(u8, bool)>,
}

impl Host {
    fn take(&mut self, report: &Report<'_>) {
        match report {
            Report::Hello(hello) => {
                let is_same = hello.garment == self.garment;
                assert!(is_same || self.contacts.is_empty(), "the next garment is reported before an end");
                self.garment = hello.garment.to_vec();
            }
            Report::Contacts(list) => self.list(list),
            Report::Symbols(list) => self.words(list),
            Report::Intent(report) => self.leading = report.leading,
            Report::Pressing(report) => self.surface[0] = report.contacts.len(),
            Report::Regions(report) => {
                self.surface[1] = report.regions.iter().map(|region| usize::from(region.contacts)).sum();
            }
            Report::Answer(answer) => self.refusals.push((answer.request, answer.refusal.is_some())),
            _ => {}
        }
    }

    fn list(&mut self, list: &ContactList) {
        let before = self.contacts.clone();
        for contact in list.contacts.iter().map(|placed| &placed.contact) {
            let was_known = match contact.phase {
                Phase::Released => self.contacts.remove(&contact.id),
                Phase::Onset | Phase::Held => !self.contacts.insert(contact.id),
            };
            assert!(was_known || contact.phase == Phase::Onset || self.is_new, "{contact:?}, {before:?}");
        }
        let listed = |id: &u32| list.contacts.iter().any(|placed| placed.contact.id == *id);
        if self.is_new {
            self.contacts.retain(listed);
        }
        assert!(self.contacts.iter().all(listed), "{before:?} without an end: {list:?}");
    }

    fn words(&mut self, list: &SymbolList) {
        for event in &list.events {
            match event.phase {
                Phase::Released => _ = self.worded.remove(&event.contact),
                Phase::Onset | Phase::Held => _ = self.worded.insert(event.contact),
            }
        }
        self.regions = list.regions.iter().map(|region| region.region).collect();
    }
}

/// A board, its host, and what was asked of the board.
struct Rig {
    bench: BoardAndHost,
    host: Host,
    random: fastrand::Rng,
    scene: Scene,
    streams: bool,
    doing: String,
}

impl Rig {
    fn new(seed: u64) -> Rig {
        let scene = scene(&mut fastrand::Rng::with_seed(seed));
        let (bench, random) = (BoardAndHost::new(scene.clone()), fastrand::Rng::with_seed(!seed));
        let mut rig =
            Rig { bench, host: Host::default(), random, scene, streams: false, doing: "start".into() };
        if rig.random.bool() {
            rig.bench.board.recall_table(TableKind::Surface, Some(&SURFACE[..]));
        }
        rig.ask(&Request::Start);
        rig
    }

    /// Up to `budget` bytes reach the host.
    fn read(&mut self, budget: usize) {
        self.bench.drain(budget, |report| self.host.take(report));
    }

    /// Asks, and reads the answer and all that comes with it.
    fn ask(&mut self, request: &Request<'_>) {
        let refused = (request.number(), true);
        self.host.refusals.clear();
        self.host.is_new = matches!(request, Request::Start | Request::Stop);
        self.bench.ask(request);
        self.read(usize::MAX);
        self.host.is_new = false;
        if self.host.refusals.contains(&refused) {
            return;
        }
        match request {
            Request::Start => self.streams = true,
            // What presses on links is reported while something is streamed.
            Request::Stop => (self.streams, self.host.surface) = (false, [0; 2]),
            Request::SetScene(bytes) => self.scene = postcard::from_bytes(bytes).unwrap(),
            _ => {}
        }
        self.agree();
    }

    /// Sends the scene with a change that ends nothing.
    fn adjust(&mut self, change: impl FnOnce(&mut Scene)) {
        let mut scene = self.scene.clone();
        change(&mut scene);
        self.ask(&Request::SetScene(&postcard::to_allocvec(&scene).unwrap()));
    }

    fn agree(&mut self) {
        let Rig { bench, host, scene, streams, doing, .. } = self;
        let present = || bench.board.state().present().iter().filter(|_| *streams);
        let ids: BTreeSet<u32> = present().map(|placed| placed.contact.id).collect();
        assert_eq!(host.contacts, ids, "contacts after {doing}");
        let has_words = *streams && scene.stream.symbols;
        let regions: BTreeSet<u8> = present().filter(|_| has_words).map(|placed| placed.region).collect();
        assert_eq!(host.regions, regions, "regions after {doing}");
        host.worded.retain(|_| has_words);
        assert!(host.worded.is_subset(&ids), "{doing}: words of {:?}, contacts {ids:?}", host.worded);
        let leading = bench.board.state().intent().leading();
        let leading = if *streams && scene.stream.intent { leading } else { Leading::None };
        assert_eq!(host.leading, leading, "intention after {doing}");
        let is_on_surface = bench.board.surface().is_some() && !ids.is_empty();
        assert!(is_on_surface || host.surface == [0; 2], "{:?} on the surface after {doing}", host.surface);
        assert_eq!(bench.board.health().lost, 0);
    }

    fn scan(&mut self, count: u32) {
        for _ in 0..count {
            self.bench.scan();
            self.bench.tick();
            // A slow link, or a fast one.
            let budget = if self.random.bool() { usize::MAX } else { self.random.usize(..80) };
            self.read(budget);
        }
    }

    fn step(&mut self) {
        let choice = self.random.u8(..100);
        self.doing = format!("{choice} at {} us", self.bench.now);
        let (hz, chance) = (self.random.choice([0, 20, u16::MAX]).unwrap(), self.random.bool());
        match choice {
            0..35 => {
                let count = self.random.u32(1..20);
                self.scan(count);
            }
            35..55 => {
                let code = self.random.choice([0, 400, 900, 3_500]).unwrap();
                self.bench.press(&FINGERS[self.random.usize(..3)], code);
            }
            55..65 => {
                let garment = postcard::to_allocvec(&garment(&mut self.random)).unwrap();
                self.ask(&Request::SetGarment(&garment));
            }
            65..75 => {
                let scene = postcard::to_allocvec(&scene(&mut self.random)).unwrap();
                self.ask(&Request::SetScene(&scene));
            }
            75..80 => {
                let (symbols, intent) = (self.random.bool(), self.random.bool());
                self.adjust(|scene| (scene.stream.symbols, scene.stream.intent) = (symbols, intent));
            }
            80..84 => self.ask(&Request::Start),
            84..87 => self.ask(&Request::Stop),
            87..90 => self.ask(&Request::Tare { frames: 2 }),
            90 => self.ask(&Request::SetGain { first: 16, gains: [9_000; 3].into_iter().collect() }),
            91 => self.ask(&Request::SetShapes(&[])),
            92 => self.adjust(|scene| scene.gestures = chance.then(GestureConfig::default)),
            93 => self.adjust(|scene| {
                (scene.contact.forms_in_frame, scene.stream.form_ages) = (2, chance);
            }),
            94 => self.ask(&Request::Stream { raw_hz: hz, budget_hz: hz }),
            95 => self.ask(&Request::KeyFrame),
            96 => self.ask(&Request::SelfTest),
            97 => {
                let table = chance.then_some(&SURFACE[..]);
                self.bench.board.recall_table(TableKind::Surface, table);
                let hz = self.random.choice([0, u16::MAX]).unwrap();
                self.adjust(|scene| scene.stream.pressing_hz = hz);
            }
            _ => self.ask(&Request::Sync { token: 1 }),
        }
    }

    /// Nothing touches any more, and nothing is asked to.
    fn end(&mut self) {
        FINGERS.iter().for_each(|finger| self.bench.press(finger, 0));
        self.doing = "the end".into();
        self.ask(&Request::Tare { frames: 1 });
        self.scan(8);
        self.ask(&Request::Sync { token: 2 });
        assert!(self.host.contacts.is_empty() && self.host.surface == [0; 2]);
    }
}

fn scene(random: &mut fastrand::Rng) -> Scene {
    let mut scene = Scene::shipped();
    scene.react.clear();
    scene.friendliness.clear();
    (scene.stream.symbols, scene.stream.intent) = (random.bool(), random.bool());
    scene.stream.contacts_hz = random.choice([0, 20, u16::MAX]).unwrap();
    scene.stream.pressing_hz = u16::MAX;
    scene.contact.high = random.choice([200, 600]).unwrap();
    if random.bool() {
        scene.intent = None;
    }
    if random.bool() {
        scene.shape = None;
    }
    scene
}

/// The block, the block under another name, or half of it, which the surface does not fit.
fn garment(random: &mut fastrand::Rng) -> Garment {
    let mut garment = Garment::block();
    match random.u8(..3) {
        0 => garment.name = taxel_core::format::name("other"),
        1 => {
            garment.panels[0].rows = 2;
            garment.blocks[0].rows = 2;
        }
        _ => {}
    }
    garment
}

#[test]
fn host_and_board_agree_on_what_is_present_after_each_answer() {
    let sequences = if crate::is_campaign() { 100_000 } else { 2_000 };
    for seed in 0..sequences {
        let mut rig = Rig::new(seed);
        (0..rig.random.usize(10..40)).for_each(|_| rig.step());
        rig.end();
    }
    println!("{sequences} sequences of requests and touches: host and board agree on what is present");
}
