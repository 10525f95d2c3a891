//! Tare, scene and self-test of all boards or of one by name, while they are followed; one of them is dead.

use crate::session::rig::{self, Rig};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use taxel::client::{Client, Event, Stamp};
use taxel::error::SourceError;
use taxel::robot::{
    BoardEvent, BoardOrder, BoardPlan, BoardState, ReadRobot, Required, RobotStream, WhenFull,
};
use taxel::session::RunLimit;
use taxel::source::{SceneFile, SourceOptions};
use taxel::text::words;
use taxel_core::wire::Request;

/// Number of a request that was answered, and why it was refused.
type Answered = (u8, Option<String>);

fn read_event(_: &Client, event: &Event, _: Stamp) -> Option<Answered> {
    match event {
        Event::Answer { request, refusal } => Some((*request, refusal.clone())),
        _ => None,
    }
}

/// Three boards, each of which can be unplugged for good.
fn three(names: [&str; 3]) -> ([Arc<Mutex<Rig>>; 3], RobotStream<Answered>) {
    let rigs = [(); 3].map(|()| Arc::new(Mutex::new(Rig::new())));
    let plan = |number: usize| {
        let rig = rigs[number].clone();
        let open = move || {
            let is_plugged = rig.lock().unwrap().plugged;
            if is_plugged {
                return rig::open(&rig);
            }
            Err(SourceError::NoBoard("nothing is plugged in".into()).into())
        };
        BoardPlan::of(names[number], open, |session| {
            session.parts().0.start(0)?;
            Ok(Required::default())
        })
    };
    let plans = [0, 1, 2].map(plan).into();
    let session = RobotStream::start(plans, WhenFull::Wait, |_, queue| queue.make(read_event)).unwrap();
    (rigs, session)
}

/// Takes events until the condition holds; `states` and answers are counted by board.
#[derive(Default)]
struct Heard {
    answers: BTreeMap<(usize, u8), usize>,
    met: [bool; 3],
    lost: [bool; 3],
}

impl Heard {
    fn until(&mut self, robot: &mut RobotStream<Answered>, what: &str, is_met: impl Fn(&Heard) -> bool) {
        let begun = Instant::now();
        while !is_met(self) {
            assert!(begun.elapsed() < Duration::from_secs(30), "{what} did not come");
            let Some(event) = robot.wait(Duration::from_millis(100)) else { continue };
            match event.what {
                BoardEvent::News((request, refusal)) => {
                    assert_eq!(refusal, None, "board {}, request {request}", event.board);
                    *self.answers.entry((event.board, request)).or_default() += 1;
                }
                BoardEvent::State(BoardState::Met) => self.met[event.board] = true,
                BoardEvent::State(BoardState::Lost { .. }) => self.lost[event.board] = true,
                BoardEvent::State(BoardState::Back { .. }) => self.lost[event.board] = false,
                other => panic!("{other:?}"),
            }
        }
    }

    fn count(&self, board: usize, request: u8) -> usize {
        self.answers.get(&(board, request)).copied().unwrap_or(0)
    }
}

const TARE: u8 = Request::Tare { frames: 0 }.number();
const SELF_TEST: u8 = Request::SelfTest.number();
const SCENE: u8 = Request::SetScene(&[]).number();

#[test]
fn all_boards_but_the_dead_one_do_what_is_ordered_and_it_follows_once_it_is_back() {
    let (rigs, mut robot) = three(["head", "hand", "heel"]);
    let mut heard = Heard::default();
    heard.until(&mut robot, "the boards", |heard| heard.met == [true; 3]);
    {
        let mut dead = rigs[1].lock().unwrap();
        dead.plugged = false;
        dead.cut();
    }
    heard.until(&mut robot, "the loss", |heard| heard.lost[1]);
    let calm = SceneFile::named("name = \"calm\"\n[contact]\nlow = 70\nhigh = 140\n").unwrap();
    let wrong = SceneFile::named("name = \"wrong\"\n[contact]\nlow = 700\n").unwrap();
    let why = robot.order(None, &BoardOrder::Scene(Box::new(wrong))).unwrap_err();
    let why = words::sentence(&why);
    assert!(why.contains("contact.high must not be below contact.low"), "{why}");
    assert_eq!(robot.order(None, &BoardOrder::Tare(8)).unwrap(), [0, 1, 2]);
    robot.order(None, &BoardOrder::Scene(Box::new(calm))).unwrap();
    assert_eq!(robot.order(Some("heel"), &BoardOrder::SelfTest).unwrap(), [2]);
    heard.until(&mut robot, "the answers", |heard| {
        [0, 2].iter().all(|board| heard.count(*board, TARE) == 1 && heard.count(*board, SCENE) == 1)
            && heard.count(2, SELF_TEST) == 1
    });
    assert!(heard.count(1, TARE) == 0 && heard.count(0, SELF_TEST) == 0);
    let uses_scene = |board: usize| rigs[board].lock().unwrap().scene().contact.low == 70;
    assert_eq!([0, 1, 2].map(uses_scene), [true, false, true]);
    rigs[1].lock().unwrap().plugged = true;
    heard.until(&mut robot, "the dead board's answers", |heard| {
        heard.count(1, TARE) == 1 && heard.count(1, SCENE) == 1
    });
    assert!(uses_scene(1));
}

#[test]
fn who_cannot_be_ordered_is_named() {
    let (_rigs, robot) = three(["head", "hand", "heel"]);
    let reported = robot.order(Some("hadn"), &BoardOrder::SelfTest).unwrap_err().to_string();
    assert_eq!(reported, "there is no board \"hadn\": did you mean \"hand\"? Known are head, hand, heel");
    let text = "name = \"one\"\n[[boards]]\nname = \"old\"\nsource = \"replay:old.mcap\"\n\
                [[boards]]\nname = \"new\"\nsource = \"sim:press\"\n";
    let read = ReadRobot::parse("one.toml".into(), text.into(), Path::new(".")).unwrap();
    let plans = read.plans(&SourceOptions::default(), &RunLimit::of(None, None));
    let mut robot = RobotStream::start(plans, WhenFull::Wait, |_, queue| queue.make(read_event)).unwrap();
    let reported = robot.order(Some("old"), &BoardOrder::Tare(8)).unwrap_err().to_string();
    assert_eq!(reported, "board old is a recording, whose board does not listen");
    while !robot.is_over() {
        robot.wait(Duration::from_secs(30));
    }
    let over =
        [None, Some("new")].map(|name| robot.order(name, &BoardOrder::Tare(8)).unwrap_err().to_string());
    assert_eq!(over, ["no board listens any longer", "board new is over"]);
}
