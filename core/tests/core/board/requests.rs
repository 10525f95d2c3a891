//! Requests: what is answered, refused, and waits.

use super::{BoardAndHost, FINGER, Small, TAXELS, info};
use taxel_core::acquire::{Depth, ScanError};
use taxel_core::board::Input;
use taxel_core::fold::{JointAngle, Posture};
use taxel_core::format::{Code, Micros, Q15, name};
use taxel_core::garment::{Garment, Line};
use taxel_core::intent::Feed;
use taxel_core::react::Cause;
use taxel_core::scene::Scene;
use taxel_core::wire::{self, Report, Request};

#[test]
fn says_hello_until_started_and_in_answer_to_start() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    let mut hellos = 0;
    for _ in 0..600 {
        bench.tick();
        bench.scan();
        bench.drain(usize::MAX, |report| {
            let Report::Hello(hello) = report else { panic!("{report:?} before Start") };
            assert_eq!((hello.magic, hello.protocol, hello.firmware), (*b"TAXL", 2, &b"test 1.0"[..]));
            assert_eq!(wire::decode::<Garment>(hello.garment).unwrap(), Garment::block());
            assert_eq!(wire::decode::<Scene>(hello.scene).unwrap(), Scene::shipped());
            hellos += 1;
        });
    }
    assert_eq!(hellos, 3, "one at the start and one a second for 3 s, the third second not over");
    bench.ask(&Request::Start);
    let mut first = Vec::new();
    bench.drain(usize::MAX, |report| first.push(format!("{report:?}")));
    assert!(first[0].starts_with("Hello") && first[1].starts_with("Answer"), "{first:?}");
}

#[test]
fn a_scene_that_is_set_is_said_before_the_answer_to_whoever_listens() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.ask(&Request::Start);
    bench.drain(usize::MAX, |_| ());
    let mut scene = Scene { name: name("other"), ..Scene::shipped() };
    for change in ["scene", "stream"] {
        scene.stream.contacts_hz = if change == "stream" { 7 } else { scene.stream.contacts_hz };
        bench.ask(&Request::SetScene(&postcard::to_allocvec(&scene).unwrap()));
        let (mut said, mut answered) = (None, None);
        bench.drain(usize::MAX, |report| match report {
            Report::Hello(hello) => said = Some(wire::decode::<Scene>(hello.scene).unwrap()),
            Report::Answer(answer) => answered = said.is_some().then_some(answer.refusal.is_none()),
            _ => {}
        });
        assert_eq!((said.as_ref(), answered), (Some(&scene), Some(true)), "another {change}");
    }
}

#[test]
fn every_wrong_request_is_refused_with_its_reason() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.drain(usize::MAX, |_| ());
    let mut twice = Garment::block();
    twice.wiring.row.lines[0].pin = twice.wiring.column.lines[0].pin;
    let twice = postcard::to_allocvec(&twice).unwrap();
    assert_eq!(bench.answer(&Request::SetGarment(&twice)).unwrap(), "garment: wiring: pin 9 is used twice");
    let large = postcard::to_allocvec(&Garment::mat()).unwrap();
    let why = bench.answer(&Request::SetGarment(&large)).unwrap();
    assert_eq!(why, "garment: panels: 2048 taxels, but only 64 fit");
    let mut scene = Scene::shipped();
    scene.contact.high = 1;
    let scene = postcard::to_allocvec(&scene).unwrap();
    let why = bench.answer(&Request::SetScene(&scene)).unwrap();
    assert_eq!(why, "scene: contact.high must not be below contact.low");
    assert!(bench.answer(&Request::SetScene(&scene[..9])).is_some());
    assert!(bench.answer(&Request::Tare { frames: 0 }).is_some());
    let concept = name("joy");
    let feed = Feed { concept, value: Q15(0), age_ms: 0, timeout_ms: 9, default: Q15(0) };
    let why = bench.answer(&Request::Feed(feed)).unwrap();
    assert_eq!(why, "feed.concept must be a concept of the map that the host feeds");
    let bent = |joint| Posture { joints: [JointAngle { joint, centidegrees: 4500 }].into_iter().collect() };
    assert_eq!(bench.answer(&Request::Posture(bent(1))), None);
    let why = bench.answer(&Request::Posture(bent(2))).unwrap();
    assert_eq!(why, "posture.joint must be a joint of the scene");
    let gains = [4096; 3].into_iter().collect();
    assert!(bench.answer(&Request::SetGain { first: 62, gains }).is_some());
    // The first tare is under no touch that the board could know of: without a baseline everything is pressure.
    bench.press(&FINGER, 100);
    bench.ask(&Request::Tare { frames: 1 });
    bench.scan();
    bench.press(&FINGER, 900);
    bench.scan();
    bench.drain(usize::MAX, |_| ());
    let why = bench.answer(&Request::Tare { frames: 4 }).unwrap();
    assert_eq!(why, "something touches the garment");
}

#[test]
fn a_scene_that_exceeds_the_link_or_a_pin_is_refused_by_name() {
    let refused = |edit: &dyn Fn(&mut Scene)| {
        let mut scene = Scene::shipped();
        edit(&mut scene);
        Small::new(info(), Garment::block(), scene).err().expect("it is refused").to_string()
    };
    let why = refused(&|scene| scene.stream.contacts_hz = 1000);
    assert_eq!(why, "scene: stream.contacts_hz must be lower: five contacts at this rate exceed the link");
    let why = refused(&|scene| {
        let line = scene.react[0].output.unwrap();
        scene.react[1].output = Some(Line { inverted: !line.inverted, ..line });
    });
    let twice = "must not be used twice, but by reactions that assert it at the same level";
    assert_eq!(why, format!("scene: react[1].output.pin {twice}"));
    let why = refused(&|scene| scene.react[0].output.as_mut().unwrap().pin = 9);
    assert_eq!(why, "scene: react[0].output.pin must not be a select line of the garment");
    let why = refused(&|scene| scene.react[0].output.as_mut().unwrap().pin = 26);
    assert_eq!(why, "scene: react[0].output.pin must be a free output of this board");
    let why = refused(&|scene| scene.friendliness[1].region = name("tail"));
    assert_eq!(why, "scene: friendliness[1].region must be a region of the garment");
    let why = refused(&|scene| scene.joints[1] = scene.joints[0].clone());
    assert_eq!(why, "scene: joints[1] must not be given twice");
    let why = refused(&|scene| scene.react[0].cause = Cause::Concept(name("joy")));
    assert_eq!(why, "scene: react[0].cause.concept must be a concept of the map");
}

#[test]
fn a_frame_that_outlasts_the_watchdog_is_refused_with_the_garment_and_with_the_scene() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    let mut garment = Garment::block();
    let mut scene = Scene::shipped();
    let bytes = |garment: &Garment| postcard::to_allocvec(garment).unwrap();
    // 64 addresses of one input, eight times for a mean of 8.
    garment.wiring.settle_ns = 500_000;
    assert_eq!(bench.answer(&Request::SetGarment(&bytes(&garment))), None);
    scene.plan.depth = Depth::MeanOf8;
    assert_eq!(bench.answer(&Request::SetScene(&postcard::to_allocvec(&scene).unwrap())), None);
    garment.wiring.settle_ns = 1_000_000;
    let why = bench.answer(&Request::SetGarment(&bytes(&garment))).unwrap();
    let asked = "lower wiring.settle_ns (1000000) or plan.depth (mean of 8)";
    assert_eq!(why, format!("a frame takes 515 ms, at most 500: {asked}"));
    scene.plan.depth = Depth::Twelve;
    assert_eq!(bench.answer(&Request::SetScene(&postcard::to_allocvec(&scene).unwrap())), None);
    assert_eq!(bench.answer(&Request::SetGarment(&bytes(&garment))), None);
    scene.plan.depth = Depth::MeanOf8;
    let why = bench.answer(&Request::SetScene(&postcard::to_allocvec(&scene).unwrap())).unwrap();
    assert_eq!(why, format!("a frame takes 515 ms, at most 500: {asked}"));
}

#[test]
fn a_scene_that_reads_nothing_or_names_two_reactions_alike_is_refused_by_name() {
    let refused = |change: &dyn Fn(&mut Scene)| {
        let mut scene = Scene::shipped();
        change(&mut scene);
        Small::new(info(), Garment::block(), scene).map(drop).unwrap_err().to_string()
    };
    let blocks = "scene: plan.blocks must leave a block of the garment to be read";
    assert_eq!(refused(&|scene| scene.plan.blocks = !1), blocks);
    let panels = "scene: plan.panels must leave a block of the garment to be read";
    assert_eq!(refused(&|scene| scene.plan.panels = 0), panels);
    let twice = "scene: react[1].name must not be given twice";
    assert_eq!(refused(&|scene| scene.react[1].name = scene.react[0].name.clone()), twice);
}

#[test]
fn a_tare_is_answered_when_it_is_done() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.drain(usize::MAX, |_| ());
    bench.codes = [Code(500); TAXELS];
    bench.ask(&Request::Tare { frames: 4 });
    let mut answers = Vec::new();
    for scan in 0..6 {
        bench.drain(usize::MAX, |report| {
            if let Report::Answer(answer) = report {
                answers.push((scan, answer.request, answer.refusal.is_none()));
            }
        });
        bench.scan();
    }
    assert_eq!(answers, [(4, 12, true)]);
    assert!(!bench.board.state().is_touched());
}

#[test]
fn garbage_is_counted_and_loses_no_request() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.drain(usize::MAX, |_| ());
    let noise: Vec<u8> = (0..5000u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    for round in 0..50 {
        bench.board.step(Micros(0), Input::Received(&noise[round..]), &mut ());
        bench.board.step(Micros(0), Input::Received(&[0]), &mut ());
        bench.drain(usize::MAX, |_| ());
        assert_eq!(bench.answer(&Request::KeyFrame), None);
    }
    assert!(bench.board.health().refused >= 50);
}

#[test]
fn a_change_waits_for_a_scan_and_what_is_no_change_does_not() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    let scene = postcard::to_allocvec(&Scene::shipped()).expect("it fits");
    let garment = postcard::to_allocvec(&Garment::block()).expect("it fits");
    // All but the last byte, which ends the message.
    let begun = |bench: &mut BoardAndHost, request: &Request<'_>| {
        let mut wire = [0; 4200];
        let (end, body) = wire::encode(request, &mut wire).expect("it fits").split_last().unwrap();
        bench.board.step(Micros(bench.now), Input::Received(body), &mut ());
        let takes = bench.board.takes_message(Micros(bench.now));
        bench.board.step(Micros(bench.now), Input::Received(&[*end]), &mut ());
        takes
    };
    assert!(begun(&mut bench, &Request::SetScene(&scene)));
    for change in [Request::SetScene(&scene), Request::SetGarment(&garment)] {
        assert!(!begun(&mut bench, &change), "nothing was scanned since");
        assert!(begun(&mut bench, &Request::Sync { token: 1 }) && begun(&mut bench, &Request::Start));
    }
    bench.scan();
    assert!(begun(&mut bench, &Request::SetGarment(&garment)));
    bench.board.step(Micros(bench.now), Input::Scanned(Err(ScanError::Conversion)), &mut ());
    assert!(!begun(&mut bench, &Request::SetScene(&scene)), "the fifth in a row");
    bench.scan();
    bench.now += 100_000;
    assert!(begun(&mut bench, &Request::SetScene(&scene)));
}
