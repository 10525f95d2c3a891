//! The bytes of every message, frozen: a changed byte is a changed wire.
//!
//! `golden/wire.txt` holds a line for each: its name, then postcard in hex. A new message adds a line, a new
//! field bytes at the end of one.

use heapless::Vec;
use std::fmt::Write;
use taxel_core::body::Placed;
use taxel_core::boot::{Aside, Boot, BootCause};
use taxel_core::condition::Certificate;
use taxel_core::contact::{Contact, Phase};
use taxel_core::fold::{Doubt, JointAngle, Posture};
use taxel_core::format::{Celsius, Fixed16, Fixed24, Micros, Q15, Turn, name};
use taxel_core::garment::{Garment, Place, Rect};
use taxel_core::health::TaxelHealth;
use taxel_core::intent::{Feed, Leading, Outcome};
use taxel_core::react::{Cause, Reaction};
use taxel_core::scene::Scene;
use taxel_core::selftest::{Fault, Findings, PinFault};
use taxel_core::shape::{Class, ConfidenceTable, GalleryHead, MEASURES, Shape, Space};
use taxel_core::surface::{
    BodyDirection, InBase, Landed, LinkName, RegionPhase, RegionSymbol, SurfacePoint, Uncertainty, Wrench,
};
use taxel_core::symbol::{Extent, RegionState, Span, Strength, Symbol, Words};
use taxel_core::wire::*;

fn pushed(base: Option<InBase>) -> Landed {
    let spot = SurfacePoint { link: 1, at: [-150_000, 20, 300_000], normal: [0, -16_384, 5] };
    Landed { id: 7, spot, force: [-3, 4_000, 0], base }
}

fn based() -> InBase {
    InBase { at: [1, -1, 1_000_000], normal: [16_384, 0, 0], force: [-4_000, 3, 0] }
}

fn wrench() -> Wrench {
    Wrench {
        link: 1,
        name: LinkName::try_from("forearm").unwrap(),
        force: [-3, 4_000, 0],
        moment: [-1_200_000, 0, 77],
        pressed: 4_100,
        center: [-150_000, 20, 300_000],
    }
}

fn placed() -> Placed {
    let contact = Contact {
        id: 7,
        phase: Phase::Held,
        panel: 1,
        total: 70_000,
        peak: 4095,
        peak_at: Place { panel: 1, row: 30, column: 2 },
        area: 40,
        perimeter: 20,
        edge: 300,
        bounds: Rect { panel: 1, top: 28, bottom: 31, left: 0, right: 5 },
        x: Fixed16(-1),
        y: Fixed16(0x1d_8000),
        azimuth: Some(Turn(-0x2000_0000)),
        anisotropy: Q15(8192),
        breadth: 412,
        dx: Fixed16(65_536),
        dy: Fixed16(-65_536),
        vx: Fixed16(300),
        vy: Fixed16(-300),
        slip: true,
        onset: Micros(1_000_000),
        duration_ms: 250,
        peak_total: 80_000,
        peak_breadth: 500,
    };
    let shape = Shape {
        nmi: Fixed24(1000),
        nmi_peak: Fixed24(6_690_000),
        nmi_s2: Fixed24(6_000_000),
        class: Class::ROUND,
        confidence: Q15::ONE,
    };
    Placed { contact, shape, region: 1 }
}

fn one<T, const N: usize>(item: T) -> Vec<T, N> {
    [item].into_iter().collect()
}

/// Of all messages that have one.
const FRAME: u32 = 300;
const TIME: Micros = Micros(5_000_000_000);

fn symbols() -> SymbolList {
    let words = Words {
        strength: Strength::Firm,
        extent: Extent::Wide,
        span: Span::Short,
        moving: true,
        class: Class::RECTANGLE,
    };
    let event =
        Symbol { contact: 7, phase: Phase::Released, region: 1, words, peak_total: 80_000, duration_ms: 250 };
    let region = RegionState { region: 1, contacts: 2, total: 70_000, peak: 4095, moving: true, since: TIME };
    SymbolList { frame: FRAME, time: TIME, events: one(event), regions: one(region) }
}

fn health() -> Health {
    Health {
        time: TIME,
        scans: 1,
        failed: 2,
        overruns: 3,
        thinned_frames: 4,
        thinned_contacts: 5,
        lost: 6,
        refused: 7,
        scan_us: 7_628,
        process_us: 3_200,
    }
}

fn budget() -> Budget {
    Budget {
        frame: FRAME,
        time: TIME,
        frames: 195,
        scan_us: 5_120,
        process_us: 2_010,
        encode_us: 590,
        send_us: 700,
        overruns: 3,
        thinned_frames: 4,
    }
}

fn hello() -> Hello<'static> {
    Hello {
        magic: MAGIC,
        protocol: PROTOCOL,
        garment: &[1, 2],
        firmware: b"taxel 0.1.0",
        clock: &[3],
        scene: &[4, 5, 6],
        calibration: &[],
        chip: b"E6614C311B7A8D2F",
        boot: Some(Boot { cause: BootCause::Watchdog, resets: 3, aside: Aside::Resets }),
    }
}

fn findings() -> Findings {
    let lines =
        [(2, Fault::StuckHigh), (3, Fault::StuckLow), (6, Fault::Bridged(7)), (26, Fault::Open)].into_iter();
    let faults = lines.chain([(27, Fault::Grounded), (28, Fault::Supplied)]);
    let faults = faults.map(|(pin, fault)| PinFault { pin, fault }).collect();
    Findings { lines: 9, inputs: 4, faults }
}

fn gesture() -> GestureReport {
    GestureReport {
        frame: FRAME,
        time: TIME,
        touch: 3,
        panel: 1,
        class: 2,
        name: name("pat"),
        score: -262_144,
        lead: 65_536,
        observed_ms: 1500,
        ended: true,
        confidence: Some(Q15(24_576)),
    }
}

fn intent() -> IntentReport {
    IntentReport {
        frame: FRAME,
        time: TIME,
        leading: Leading::Attack,
        outcome: Outcome::Cycle(2),
        steps: 6,
        concepts: [Q15(0), Q15(32_768), Q15(-32_768)].into_iter().collect(),
    }
}

fn regions() -> RegionsReport {
    let region = RegionSymbol {
        phase: RegionPhase::Moving,
        way: BodyDirection::Down,
        contacts: 2,
        strength: Strength::Firm,
        extent: Extent::Patch,
        class: Class(3),
        since: Micros(4_000_000_000),
    };
    RegionsReport { frame: FRAME, time: TIME, regions: one(region) }
}

fn pressing() -> PressingReport {
    let uncertain = Uncertainty { saturated: 2, faulty: 1, less: 300, more: 70_000, off: 1_500 };
    PressingReport {
        frame: FRAME,
        time: TIME,
        posed: Some(Micros(70)),
        contacts: [pushed(None), pushed(Some(based()))].into_iter().collect(),
        links: one(wrench()),
        contact_bounds: one((300, uncertain)),
        link_bounds: one((1, uncertain)),
        pose_errors: one((1, 4_500)),
    }
}

fn folds() -> FoldsReport {
    FoldsReport {
        frame: FRAME,
        time: TIME,
        posed: Some(Micros(70)),
        followed: true,
        taxels: 300,
        total: 70_000,
        doubt: 9_000,
        contacts: one(Doubt { id: 300, doubt: 150 }),
    }
}

fn contacts() -> ContactList {
    ContactList {
        frame: FRAME,
        time: TIME,
        dropped: 1,
        contacts: one(placed()),
        unsure: one(7),
        form_ages: one((7, 255)),
    }
}

fn reports() -> [Report<'static>; 23] {
    let (frame, time) = (FRAME, TIME);
    let reaction = Reaction { index: 1, name: name("flinch"), active: true, value: -1 };
    let faulty = FaultyTaxels { first: 700, count: 2, health: TaxelHealth::Stuck };
    [
        Report::Hello(hello()),
        Report::Sync(SyncReport { token: 9, received: time, sent: Micros(5_000_000_100) }),
        Report::StartOfFrame(StartOfFrame { number: 2047, noticed: time, late_us: 20 }),
        Report::SelfTest(SelfTestReport { time, findings: findings() }),
        Report::Answer(Answer { request: 2, refusal: Some("no") }),
        Report::Reflex(ReflexReport { frame, time, index: 1, taxel: 700, value: 3_700, other: Some(684) }),
        Report::Reaction(ReactionReport { frame, time, reaction }),
        Report::Shapes(ShapesReport { prototypes: 20, names: one(name("ball")) }),
        Report::Contacts(contacts()),
        Report::Symbols(symbols()),
        Report::Intent(intent()),
        Report::Gesture(gesture()),
        Report::Log(Log { time, level: Level::Warn, text: "pin 9" }),
        Report::HealthMap(HealthMap { time, first: 0, end: 2048, taxels: one(faulty) }),
        Report::Health(health()),
        Report::Budget(budget()),
        Report::Temperature(Temperature { time, celsius: Celsius(-1234) }),
        Report::RegionNames(RegionNames { names: one(LinkName::try_from("left forearm, outer").unwrap()) }),
        Report::Regions(regions()),
        Report::Pressing(pressing()),
        Report::Folds(folds()),
        Report::Frame(Frame { frame, time, base: Some(299), sum: 0xdead_beef, data: &[5, 1, 20] }),
        Report::Raw(Raw { frame, time, data: &[0, 1, 2] }),
    ]
}

fn requests() -> [Request<'static>; 19] {
    let concept = name("warmth");
    let feed = Feed { concept, value: Q15(-16_384), age_ms: 20, timeout_ms: 500, default: Q15(0) };
    let certificate =
        Certificate { id: 0xdead_beef, taxels: 2048, year: 2026, month: 11, day: 21, error: 125 };
    let posture = Posture { joints: one(JointAngle { joint: 1, centidegrees: -4500 }) };
    [
        Request::Start,
        Request::Stop,
        Request::Sync { token: 1_000_000 },
        Request::KeyFrame,
        Request::Stream { raw_hz: 10, budget_hz: 65_535 },
        Request::SetGarment(&[1, 2, 3]),
        Request::SetScene(&[4, 5]),
        Request::SetTable(&[1, 2, 3]),
        Request::SetShapes(&[6, 7]),
        Request::AddShapes(&[1, 0, 2]),
        Request::SetGain { first: 2000, gains: [4096, 5000].into_iter().collect() },
        Request::SetCalibration(certificate),
        Request::Tare { frames: 300 },
        Request::SelfTest,
        Request::Save,
        Request::ResetSettings { undo: true },
        Request::Posture(posture),
        Request::SetPoses(&[6, 7]),
        Request::Feed(feed),
    ]
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        write!(text, "{byte:02x}").expect("a string takes all");
        text
    })
}

#[test]
fn every_message_has_its_golden_bytes() {
    let mut table = String::new();
    let mut line = |kind: &str, name: &str, bytes: &[u8]| {
        writeln!(table, "{kind} {name} {}", hex(bytes)).expect("a string takes all");
    };
    assert_eq!((reports().len(), requests().len()), (REPORTS.len(), REQUESTS.len()));
    for (number, (report, (name, _))) in reports().iter().zip(REPORTS).enumerate() {
        let bytes = postcard::to_allocvec(&(5u32, report)).expect("it fits");
        assert_eq!(bytes[..2], [5, number as u8], "seq, then the number of the variant");
        assert_eq!(decode::<(u32, Report)>(&bytes).expect("it is read again"), (5, report.clone()));
        line("report", name, &bytes);
    }
    for (number, (request, name)) in requests().iter().zip(REQUESTS).enumerate() {
        let bytes = postcard::to_allocvec(request).expect("it fits");
        assert_eq!((bytes[0], request.number()), (number as u8, number as u8));
        assert_eq!(decode::<Request>(&bytes).expect("it is read again"), *request);
        line("request", name, &bytes);
    }
    let mut block = Garment::block();
    // Its settling has changed since its bytes were frozen; the form has not.
    block.wiring.settle_ns = 3_000;
    line("garment", "block-4x16", &postcard::to_allocvec(&block).expect("it fits"));
    line("garment", "reference", &postcard::to_allocvec(&Garment::reference()).expect("it fits"));
    let scene = postcard::to_allocvec(&Scene::shipped()).expect("it fits");
    assert_eq!(decode::<Scene>(&scene).expect("it is read again"), Scene::shipped());
    let mut frame = [0; 64];
    let frame = encode(&Request::Tare { frames: 300 }, &mut frame).expect("it fits");
    line("frame", "Tare", frame);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/core/golden/wire.txt");
    if std::env::var_os("TAXEL_BLESS").is_some() {
        std::fs::write(path, &table).expect("it can be written");
    }
    let golden = std::fs::read_to_string(path).expect("golden/wire.txt");
    for (new, old) in table.lines().zip(golden.lines()) {
        assert_eq!(new, old);
    }
    assert_eq!(table.lines().count(), golden.lines().count());
}

/// What a version 2.1 might add to a report: a number, an option and a list.
const ADDED: &[u8] = &[7, 1, 9, 2, 5, 6];

#[test]
fn a_later_board_is_understood_and_so_is_an_earlier_one() {
    for (report, (name, _)) in reports().into_iter().zip(REPORTS) {
        let bytes = postcard::to_allocvec(&(5u32, &report)).expect("it fits");
        assert_eq!(decode::<(u32, Report)>(&[&bytes, ADDED].concat()), Ok((5, report)), "{name}");
    }
    let bytes = postcard::to_allocvec(&(5u32, Report::Budget(budget()))).expect("it fits");
    type Later = (u32, u32, Budget, u32, Option<u8>, Vec<u8, 4>);
    let read = |bytes: &[u8]| {
        decode::<Later>(bytes).map(|(_, _, known, spare, one, list)| (known, spare, one, list))
    };
    assert_eq!(read(&bytes), Ok((budget(), 0, None, Vec::new())));
    let list = Vec::from_slice(&[5, 6]).expect("it fits");
    assert_eq!(read(&[&bytes, ADDED].concat()), Ok((budget(), 7, Some(9), list)));
}

#[test]
fn a_later_host_is_understood_and_so_is_an_earlier_one() {
    for (request, name) in requests().into_iter().zip(REQUESTS) {
        let bytes = postcard::to_allocvec(&request).expect("it fits");
        assert_eq!(decode::<Request>(&[&bytes, ADDED].concat()), Ok(request), "{name}");
    }
    let tare = postcard::to_allocvec(&Request::Tare { frames: 300 }).expect("it fits");
    assert_eq!(decode::<(u8, u16, Option<u8>)>(&tare), Ok((12, 300, None)));
    // A request that this version does not know is none.
    assert_eq!(decode::<Request>(&[200, 1]), Err(WireError::Message));
}

#[test]
fn a_hello_of_any_version_says_which_it_is() {
    let body = postcard::to_allocvec(&hello()).expect("it fits");
    assert_eq!(Hello::protocol_of(&body), Some(PROTOCOL));
    assert_eq!(Hello::protocol_of(b"TAXL\x81\x01 whatever follows"), Some(129));
    for cut in [&b""[..], b"TAX", b"TAXI\x02"] {
        assert_eq!(Hello::protocol_of(cut), None);
    }
}

/// Words and keys of files that differ from the names in the code.
#[test]
fn files_keep_their_words() {
    assert_eq!(serde_json::to_string(&Cause::Faulty).unwrap(), r#""faulty""#);
    assert_eq!(serde_json::from_str::<Cause>(r#""faulty""#).unwrap(), Cause::Faulty);
    let head = GalleryHead {
        names: Vec::new(),
        space: Space { origin: [0; MEASURES], weights: Vec::new(), shift: 0 },
        k: 1,
        reject: 0,
        confidence: ConfidenceTable::default(),
        prototypes: 1,
    };
    let head = serde_json::to_value(&head).unwrap();
    assert!(head.get("sureness").is_some_and(|table| table.is_object()), "{head}");
}
