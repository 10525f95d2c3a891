//! The board as a list of inputs: requests, refusals, what goes first, what is thinned, and what never is.

use std::collections::BTreeMap;
use taxel_core::acquire::{Depth, Scan, ScanError, ScanReport};
use taxel_core::board::{Board, BoardInfo, Input, Job, Part, Saved};
use taxel_core::boot::{Aside, Boot, BootCause};
use taxel_core::contact::Phase;
use taxel_core::fold::{JointAngle, Posture};
use taxel_core::format::{Code, Micros, Q15, name};
use taxel_core::garment::{Garment, Line};
use taxel_core::intent::Feed;
use taxel_core::react::{Cause, ReactionConfig};
use taxel_core::scene::Scene;
use taxel_core::wire::{self, Receiver, Report, Request, decode_image, image_sum};

const TAXELS: usize = 64;
type Small = Board<TAXELS, 32>;

/// A board in one hand and a host in the other.
pub struct Bench {
    pub board: Box<Small>,
    pub now: u64,
    codes: [Code; TAXELS],
    receiver: Box<Receiver<8192>>,
    next_seq: Option<u32>,
}

fn info() -> BoardInfo {
    BoardInfo::feather("test 1.0")
}

impl Bench {
    pub fn new(scene: Scene) -> Bench {
        let board = Small::new(info(), Garment::block(), scene).expect("garment and scene fit");
        Bench {
            board: Box::new(board),
            now: 0,
            codes: [Code(0); TAXELS],
            receiver: Box::new(Receiver::new()),
            next_seq: None,
        }
    }

    pub fn ask(&mut self, request: &Request<'_>) {
        let mut frame = [0; 4200];
        let frame = wire::encode(request, &mut frame).expect("it fits");
        // In uneven pieces, as a UART delivers them.
        for piece in frame.chunks(7) {
            assert_eq!(self.board.step(Micros(self.now), Input::Received(piece), &mut ()), None);
        }
    }

    /// One scan of the present codes, 5 ms later.
    pub fn scan(&mut self) {
        self.now += 5_000;
        let report =
            ScanReport { start: Micros(self.now), duration_us: 4_000, overruns: 0, temperature: None };
        let scan = Scan { codes: &self.codes, report };
        self.board.step(Micros(self.now), Input::Scanned(Ok(scan)), &mut ());
    }

    pub fn tick(&mut self) -> Option<Job> {
        self.board.step(Micros(self.now), Input::Tick, &mut ())
    }

    /// Takes up to `budget` bytes off the board and calls `told` for every message; seq must not jump.
    pub fn drain(&mut self, mut budget: usize, mut told: impl FnMut(&Report<'_>)) {
        while budget > 0 {
            let bytes = self.board.pending(Micros(self.now), &mut ()).to_vec();
            let taken = bytes.len().min(budget);
            if taken == 0 {
                break;
            }
            budget -= taken;
            self.board.sent(taken);
            for byte in &bytes[..taken] {
                let Some(frame) = self.receiver.push(*byte) else { continue };
                let (seq, report): (u32, Report) =
                    wire::decode(frame.expect("the board's frames are good")).expect("and its messages");
                assert_eq!(self.next_seq.replace(seq + 1).unwrap_or(seq), seq);
                told(&report);
            }
        }
    }

    /// What a request is answered with: none is yes.
    pub fn answer(&mut self, request: &Request<'_>) -> Option<String> {
        self.ask(request);
        let mut answer = None;
        self.drain(usize::MAX, |report| {
            if let Report::Answer(told) = report {
                assert_eq!(told.request, request.number());
                answer = Some(told.refusal.map(str::to_string));
            }
        });
        answer.expect("every request is answered")
    }

    pub fn press(&mut self, taxels: &[usize], code: u16) {
        for taxel in taxels {
            self.codes[*taxel] = Code(code);
        }
    }
}

/// Taxels under a fingertip.
pub const FINGER: [usize; 4] = [17, 18, 33, 34];

#[test]
fn says_hello_until_started_and_in_answer_to_start() {
    let mut bench = Bench::new(Scene::shipped());
    let mut hellos = 0;
    for _ in 0..600 {
        bench.tick();
        bench.scan();
        bench.drain(usize::MAX, |report| {
            let Report::Hello(hello) = report else { panic!("{report:?} before Start") };
            assert_eq!((hello.magic, hello.protocol, hello.firmware), (*b"TAXL", 1, &b"test 1.0"[..]));
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
fn every_wrong_request_is_refused_with_its_reason() {
    let mut bench = Bench::new(Scene::shipped());
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
    assert!(bench.answer(&Request::Concept { slot: 8, value: Q15(0) }).is_some());
    assert!(bench.answer(&Request::Concept { slot: 0, value: Q15(32769) }).is_some());
    assert_eq!(bench.answer(&Request::Concept { slot: 0, value: Q15(-32768) }), None);
    let concept = name("joy");
    let feed = Feed { concept, value: Q15(0), age_ms: 0, lasts_ms: 9, otherwise: Q15(0) };
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
    let mut bench = Bench::new(Scene::shipped());
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
fn frames_decode_to_the_image_of_the_board_alone_or_from_their_base() {
    let mut bench = Bench::new(Scene::shipped());
    bench.ask(&Request::Start);
    bench.drain(usize::MAX, |_| ());
    let (mut image, mut last, mut alone, mut differing) = ([0u16; TAXELS], None, 0, 0);
    for step in 0..500u16 {
        bench.press(&FINGER, if step % 100 < 50 { 600 + step } else { 0 });
        bench.scan();
        let mut copy = (image, last);
        bench.drain(usize::MAX, |report| {
            let Report::Frame(frame) = report else { return };
            let base = copy.0;
            match frame.base {
                Some(number) => {
                    assert_eq!(Some(number), copy.1);
                    differing += 1;
                }
                None => alone += 1,
            }
            decode_image(frame.data, frame.base.map(|_| &base[..]), &mut copy.0).unwrap();
            assert_eq!(image_sum(&copy.0), frame.sum);
            copy.1 = Some(frame.frame);
        });
        (image, last) = copy;
        assert_eq!(last, Some(u32::from(step) + 1));
        assert_eq!(image[17], if step % 100 < 50 { 600 + step } else { 0 });
    }
    assert!((3..=4).contains(&alone) && differing > 490, "{alone} key frames in 2.5 s, {differing} others");
}

/// A key frame takes longer to encode, so it avoids the frames that measure the form of a large contact.
#[test]
fn a_key_frame_is_one_that_measures_little() {
    let mut bench = Bench::new(Scene::shipped());
    bench.ask(&Request::Start);
    bench.ask(&Request::SetForms { in_frame: 1, ages: true });
    bench.drain(usize::MAX, |_| ());
    let large: Vec<usize> = (0..64).filter(|taxel| taxel % 16 < 5).collect();
    let (mut keys, mut measured) = (Vec::new(), Vec::new());
    for step in 0..4_000u16 {
        bench.press(&large, 900 + step % 7);
        [8, 11, 14].iter().for_each(|column| bench.press(&[16 + column, 32 + column], 600 + step % 100));
        bench.scan();
        let now = bench.now;
        let mut old = false;
        bench.drain(usize::MAX, |report| match report {
            // The large contact lies first, so its id is 1.
            Report::Forms(forms) => old = forms.ages.iter().any(|(contact, _)| *contact == 1),
            Report::Frame(frame) if frame.base.is_none() => keys.push((step, now)),
            _ => {}
        });
        measured.push(!old);
    }
    assert!(keys.len() > 10, "{} key frames", keys.len());
    for pair in keys.windows(2) {
        let gap = pair[1].1 - pair[0].1;
        assert!((937_500..=1_000_000).contains(&gap), "{gap} us between key frames");
    }
    let turns = measured.iter().filter(|large| **large).count();
    assert!((990..=1010).contains(&turns), "one form of four a frame: {turns}");
    for (step, _) in &keys[1..] {
        let step = usize::from(*step);
        assert!(!measured[step] && !measured[step + 1], "key frame {step} measures the large contact");
    }
}

#[test]
fn a_slow_link_thins_updates_and_images_but_no_onset_and_no_release() {
    let mut bench = Bench::new(Scene::shipped());
    bench.ask(&Request::Start);
    bench.drain(usize::MAX, |_| ());
    let mut seen: BTreeMap<u32, Vec<Phase>> = BTreeMap::new();
    for step in 0..2_000 {
        bench.press(&FINGER, if step % 20 < 9 { 800 } else { 0 });
        bench.scan();
        bench.tick();
        // 20 bytes in 5 ms: 4 kB/s.
        bench.drain(20, |report| {
            if let Report::Contacts(list) = report {
                for placed in &list.contacts {
                    let phases = seen.entry(placed.contact.id).or_default();
                    if phases.last() != Some(&placed.contact.phase) {
                        phases.push(placed.contact.phase);
                    }
                }
            }
        });
    }
    let health = *bench.board.health();
    assert!(health.thinned_frames > 500 && health.thinned_contacts > 100, "{health:?}");
    assert_eq!(health.lost, 0);
    seen.pop_last();
    assert!(seen.len() > 90, "{}", seen.len());
    for (id, phases) in &seen {
        assert_eq!(phases.first(), Some(&Phase::Onset), "contact {id}");
        assert_eq!(phases.last(), Some(&Phase::Released), "contact {id}");
    }
}

#[test]
fn over_pressure_reacts_in_its_frame_and_drives_the_pin() {
    let mut scene = Scene::shipped();
    scene.react = [ReactionConfig {
        name: name("ouch"),
        cause: Cause::Pressure,
        region: name("mat"),
        level: 3000,
        hysteresis: 500,
        hold_ms: 20,
        output: Some(Line { pin: 24, inverted: true }),
    }]
    .into_iter()
    .collect();
    let mut bench = Bench::new(scene);
    bench.ask(&Request::Start);
    assert_eq!(bench.tick(), Some(Job::Drive(24, true)), "at rest, inverted");
    let mut course = Vec::new();
    for code in [0, 2999, 3000, 2600, 2400, 0, 0, 0, 0, 0, 0] {
        bench.press(&FINGER, code);
        bench.scan();
        bench.drain(usize::MAX, |report| {
            if let Report::Reaction(told) = report {
                course.push((code, told.reaction.active, told.reaction.value));
            }
        });
        while let Some(Job::Drive(pin, level)) = bench.tick() {
            course.push((pin.into(), level, -1));
        }
    }
    // Active from the frame of 3000 on; 2600 keeps it; 20 ms (four frames) after that it ends.
    assert_eq!(course, [(3000, true, 3000), (24, false, -1), (0, false, 0), (24, true, -1)]);
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
    let mut bench = Bench::new(Scene::shipped());
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
    assert_eq!(answers, [(4, 2, true)]);
    assert!(!bench.board.state().is_touched());
}

#[test]
fn garbage_is_counted_and_loses_no_request() {
    let mut bench = Bench::new(Scene::shipped());
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
fn jobs_that_fail_are_told() {
    let mut bench = Bench::new(Scene::shipped());
    bench.ask(&Request::SelfTest);
    let jobs: Vec<_> =
        std::iter::from_fn(|| bench.tick()).take_while(|job| !matches!(job, Job::Scan(_))).collect();
    assert_eq!(jobs.last(), Some(&Job::Examine));
    bench.board.step(Micros(0), Input::Examined(Err(ScanError::Output(9))), &mut ());
    let error = ScanError::Converter { input: 26, taxel: 5 };
    bench.board.step(Micros(0), Input::Scanned(Err(error)), &mut ());
    let mut told = Vec::new();
    bench.drain(usize::MAX, |report| match report {
        Report::Answer(answer) => {
            told.push(format!("{} {}", answer.request, answer.refusal.unwrap_or("yes")))
        }
        Report::Log(log) => told.push(log.text.to_string()),
        _ => {}
    });
    assert_eq!(
        told,
        ["9 pin 9 cannot be driven", "scan: converter input on pin 26 gave no sample (at taxel 5)"]
    );
    assert!(matches!(bench.tick(), Some(Job::Scan(_))), "a failed scan is followed by the next");
}

#[test]
fn what_waits_to_be_done_keeps_no_pin_from_being_driven() {
    let mut bench = Bench::new(Scene::shipped());
    let scene = postcard::to_allocvec(&Scene::shipped()).expect("it fits");
    for _ in 0..20 {
        bench.ask(&Request::SelfTest);
        bench.ask(&Request::SetScene(&scene));
    }
    let mut jobs = Vec::new();
    while let Some(job) = bench.tick() {
        jobs.push(job);
        if let Job::Scan(_) = job {
            bench.scan();
        }
        if jobs.len() == 12 {
            break;
        }
    }
    assert_eq!(jobs[..2], [Job::Drive(18, false), Job::Drive(19, false)]);
    // Four of them wait; whoever asks without end keeps nothing from being scanned.
    let (works, scans): (Vec<Job>, Vec<Job>) = jobs[2..10].iter().partition(|job| **job == Job::Examine);
    assert_eq!((works.len(), scans.len()), (4, 4));
    assert!(jobs[2..].chunks(2).all(|two| matches!(two[1], Job::Scan(_))), "{jobs:?}");
}

#[test]
fn how_the_board_came_to_start_is_told_after_each_hello() {
    let mut bench = Bench::new(Scene::shipped());
    let boot = Boot { cause: BootCause::Panic, resets: 3, aside: Aside::Resets };
    bench.board.booted(boot);
    let told = |bench: &mut Bench| {
        let mut told = Vec::new();
        bench.drain(usize::MAX, |report| {
            told.push(match report {
                Report::Hello(_) => "hello".to_string(),
                Report::Boot(boot) => format!("{boot:?}"),
                report => format!("{report:?}"),
            });
        });
        told
    };
    let pair = ["hello".to_string(), format!("{boot:?}")];
    assert_eq!(told(&mut bench), pair);
    bench.tick();
    bench.now += 1_000_000;
    assert_eq!(told(&mut bench), pair, "each second");
    bench.ask(&Request::Start);
    assert_eq!(told(&mut bench)[..2], pair);
    // What is stored now is in force.
    bench.ask(&Request::Save);
    until_save(&mut bench);
    bench.board.step(Micros(bench.now), Input::Saved(Ok(Saved::Written)), &mut ());
    bench.ask(&Request::Start);
    bench.drain(usize::MAX, |report| {
        if let Report::Boot(told) = report {
            assert_eq!(*told, Boot { aside: Aside::No, ..boot });
        }
    });
}

#[test]
fn settings_are_reset_then_the_board_starts_anew_when_it_has_answered() {
    let mut bench = Bench::new(Scene::shipped());
    bench.scan();
    let asked = |bench: &mut Bench, undo| {
        bench.ask(&Request::ResetSettings { undo });
        let reset = std::iter::from_fn(|| bench.tick()).find(|job| !matches!(job, Job::Drive(..)));
        assert_eq!(reset, Some(Job::ResetSettings { undo }));
    };
    let answer = |bench: &mut Bench| {
        let mut answers = Vec::new();
        bench.drain(usize::MAX, |report| {
            if let Report::Answer(answer) = report {
                answers.push((answer.request, answer.refusal.map(str::to_string)));
            }
        });
        answers
    };
    asked(&mut bench, true);
    bench.board.step(Micros(bench.now), Input::SettingsReset(Err("the flash cannot be read")), &mut ());
    assert_eq!(answer(&mut bench), [(19, Some("the flash cannot be read".to_string()))]);
    for _ in 0..100 {
        assert_ne!(bench.tick(), Some(Job::Restart), "what has failed changes nothing");
        bench.scan();
    }
    asked(&mut bench, false);
    bench.board.step(Micros(bench.now), Input::SettingsReset(Ok(Saved::Written)), &mut ());
    assert_eq!(answer(&mut bench), [(19, None)]);
    let restarts = (0..20).position(|_| {
        let job = bench.tick();
        bench.scan();
        job == Some(Job::Restart)
    });
    assert_eq!(restarts, Some(10), "50 ms later");
}

#[test]
fn a_change_waits_for_a_scan_and_what_is_no_change_does_not() {
    let mut bench = Bench::new(Scene::shipped());
    let scene = postcard::to_allocvec(&Scene::shipped()).expect("it fits");
    let garment = postcard::to_allocvec(&Garment::block()).expect("it fits");
    // All but the last byte, which ends the message.
    let begun = |bench: &mut Bench, request: &Request<'_>| {
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

#[test]
fn a_stored_garment_that_would_outlast_the_watchdog_is_refused_and_what_ships_stays() {
    let mut bench = Bench::new(Scene::shipped());
    let mut slow = Garment::block();
    slow.wiring.settle_ns = 10_000_000;
    bench.board.restore(Part::Garment, &postcard::to_allocvec(&slow).expect("it fits"));
    assert_eq!(bench.board.setup().garment, Garment::block());
    let mut logs = Vec::new();
    bench.drain(usize::MAX, |report| {
        if let Report::Log(log) = report {
            logs.push(log.text.to_string());
        }
    });
    let why = "stored garment: a frame takes 641 ms, at most 500: lower wiring.settle_ns (10000000)";
    assert_eq!(logs, [why]);
}

/// Ticks, scans and reads on until the board wants to save; what it logged before.
fn until_save(bench: &mut Bench) -> Vec<String> {
    let mut logs = Vec::new();
    for _ in 0..100 {
        bench.drain(usize::MAX, |report| {
            if let Report::Log(log) = report {
                logs.push(log.text.to_string());
            }
        });
        match bench.tick() {
            Some(Job::Save) => return logs,
            Some(Job::Scan(_)) => bench.scan(),
            _ => {}
        }
    }
    panic!("the board does not save");
}

#[test]
fn a_save_is_announced_and_what_it_costs_is_counted() {
    let mut bench = Bench::new(Scene::shipped());
    bench.scan();
    bench.ask(&Request::Save);
    assert_eq!(until_save(&mut bench), ["scanning stops for about 150 ms while the settings are stored"]);
    bench.now += 200_000;
    bench.board.step(Micros(bench.now), Input::Saved(Ok(Saved::Written)), &mut ());
    // Scans of 4 ms.
    assert_eq!(bench.board.health().overruns, 50);
    let mut answers = Vec::new();
    bench.drain(usize::MAX, |report| {
        if let Report::Answer(answer) = report {
            answers.push((answer.request, answer.refusal.map(str::to_string)));
        }
    });
    assert_eq!(answers, [(10, None)]);
}

#[test]
fn the_flash_is_spared() {
    let mut bench = Bench::new(Scene::shipped());
    bench.scan();
    // Settings that have not changed cost nothing.
    for round in 0..40 {
        bench.ask(&Request::Save);
        until_save(&mut bench);
        let saved = if round < 28 { Saved::Unchanged } else { Saved::Written };
        bench.board.step(Micros(bench.now), Input::Saved(Ok(saved)), &mut ());
    }
    let refusal = bench.answer(&Request::Save).expect("it is refused");
    assert!(refusal.starts_with("the flash has been written often enough"), "{refusal}");
    bench.now += 300_000_000;
    bench.ask(&Request::Save);
    until_save(&mut bench);
}

#[test]
fn half_a_tare_is_not_stored() {
    let mut bench = Bench::new(Scene::shipped());
    bench.ask(&Request::Tare { frames: 9 });
    assert_eq!(bench.answer(&Request::Save).as_deref(), Some("a tare is under way"));
}
