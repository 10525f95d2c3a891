//! Boards that are lost and come back in random order and in each other's places: never a wrong board under a
//! name, and nothing is left behind.

use crate::random::Noise;
use crate::session::rig::{self, Rig};
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use taxel::client::{Client, Event, Identity, Stamp};
use taxel::error::SourceError;
use taxel::robot::{BoardEvent, BoardPlan, BoardState, Required, RobotEvent, RobotStream, WhenFull};
use taxel::session::Session;
use taxel::source::Source;
use taxel_core::format::{Code, name};
use taxel_core::garment::Garment;

const NAMES: [&str; 3] = ["head", "hand", "heel"];

/// Number of losses, in a test and in a campaign.
fn losses() -> usize {
    if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 1000 } else { 120 }
}

/// Three places, each for the board of its number, in which any board may be plugged.
struct Bench {
    rigs: [Arc<Mutex<Rig>>; 3],
    plugged: Mutex<[Option<usize>; 3]>,
}

impl Bench {
    fn new() -> Arc<Bench> {
        let rig = |number: usize| {
            let mut rig = Rig::with_garment(Garment { name: name(NAMES[number]), ..Garment::block() });
            rig.codes = [Code(100 + 100 * number as u16); 64];
            Arc::new(Mutex::new(rig))
        };
        Arc::new(Bench { rigs: [0, 1, 2].map(rig), plugged: Mutex::new([Some(0), Some(1), Some(2)]) })
    }

    /// Opens what is plugged in at a place.
    fn open(self: Arc<Bench>, place: usize, with_serial: bool) -> taxel::Result<Source> {
        let there = self.plugged.lock().unwrap()[place];
        let Some(there) = there else {
            return Err(SourceError::NoBoard("nothing is plugged in".into()).into());
        };
        let source = rig::open(&self.rigs[there])?;
        let usb_serial = with_serial.then(|| format!("N{there}"));
        let again = move || self.clone().open(place, with_serial);
        Ok(Source { label: format!("place {place}"), usb_serial, returns: Some(Box::new(again)), ..source })
    }

    /// Follows the boards in threads of this name and their number; what is reported is the first raw code, which
    /// each board has of its own.
    fn robot(
        self: &Arc<Bench>,
        thread: &str,
        identity: impl Fn(usize) -> Identity,
        with_serial: bool,
    ) -> RobotStream<Coded> {
        let plan = |number: usize| {
            let bench = self.clone();
            let open = move || bench.clone().open(number, with_serial);
            let begin = |session: &mut Session| {
                let client = session.parts().0;
                client.start(0)?;
                client.stream_raw(u16::MAX)?;
                Ok(Required::of(client))
            };
            let plan = BoardPlan::of(format!("{thread}{number}"), open, begin);
            BoardPlan { identity: Some(identity(number)), ..plan }
        };
        RobotStream::start([0, 1, 2].map(plan).into(), WhenFull::Wait, |_, queue| queue.make(read_event))
            .unwrap()
    }

    /// Plugs boards in: at each place the one of this number.
    fn plug(&self, boards: [Option<usize>; 3]) {
        // Nobody finds a board in its new place before it is out of the old one.
        let mut plugged = self.plugged.lock().unwrap();
        for (place, board) in plugged.into_iter().enumerate() {
            if boards[place] != board
                && let Some(board) = board
            {
                self.rigs[board].lock().unwrap().cut();
            }
        }
        *plugged = boards;
    }

    fn cut(&self, board: usize, restart: bool) {
        let mut rig = self.rigs[board].lock().unwrap();
        if restart {
            rig.restart();
        }
        rig.cut();
    }
}

/// The garment and the first raw code.
type Coded = (String, u16);

fn read_event(client: &Client, event: &Event, _: Stamp) -> Option<Coded> {
    let garment = client.description()?.garment.name.to_string();
    matches!(event, Event::Raw { whole: true, .. }).then(|| (garment, client.raw()[0]))
}

/// What the boards have said so far.
#[derive(Default)]
struct Seen {
    news: [usize; 3],
    lost: [usize; 3],
    back: [usize; 3],
    others: [usize; 3],
}

impl Seen {
    /// Takes an event. No board says what another one feels.
    fn take(&mut self, event: RobotEvent<Coded>) {
        let board = event.board;
        match event.what {
            BoardEvent::News((garment, code)) => {
                assert_eq!((garment.as_str(), usize::from(code)), (NAMES[board], 100 + 100 * board));
                self.news[board] += 1;
            }
            BoardEvent::State(BoardState::Lost { since_us, .. }) => {
                assert!(since_us <= event.stamp.host_us && since_us + 10_000_000 > event.stamp.host_us);
                self.lost[board] += 1;
            }
            BoardEvent::State(BoardState::Back { .. }) => self.back[board] += 1,
            BoardEvent::State(BoardState::Other { why }) => {
                assert!(why.starts_with(&format!("place {board} answers with another board: ")), "{why}");
                self.others[board] += 1;
            }
            BoardEvent::State(BoardState::Met) => {}
            other => panic!("{other:?}"),
        }
    }

    /// Takes events until the condition holds.
    fn until(&mut self, robot: &mut RobotStream<Coded>, what: &str, is_met: impl Fn(&Seen) -> bool) {
        let begun = Instant::now();
        while !is_met(self) {
            robot.wait(Duration::from_millis(100)).into_iter().for_each(|event| self.take(event));
            assert!(begun.elapsed() < Duration::from_secs(60), "{what} did not come");
        }
    }
}

/// Number of threads of this process whose names begin with this word.
#[cfg(target_os = "linux")]
fn threads(word: &str) -> usize {
    let tasks = std::fs::read_dir("/proc/self/task").unwrap().flatten();
    let names = tasks.filter_map(|task| std::fs::read_to_string(task.path().join("comm")).ok());
    names.filter(|name| name.starts_with(word)).count()
}

#[test]
fn boards_come_back_in_any_order_and_no_wrong_one_has_a_name() {
    let (bench, mut random) = (Bench::new(), Noise(23));
    let garment = |number: usize| Garment { name: name(NAMES[number]), ..Garment::block() };
    let mut robot = bench.robot("random", |number| Identity::new(None, Some(garment(number))), false);
    let mut seen = Seen::default();
    seen.until(&mut robot, "the first frames", |seen| seen.news.iter().all(|news| *news > 0));
    let (mut swaps, all) = (0, [Some(0), Some(1), Some(2)]);
    while seen.lost.iter().sum::<usize>() < losses() {
        let (before, others) = (seen.lost, seen.others);
        let [a, b] = [random.below(3) as usize, random.below(3) as usize];
        let hit: BTreeSet<usize> = match random.below(4) {
            // Two boards in each other's places, until both are found out.
            0 if a != b => {
                let mut swapped = all;
                swapped.swap(a, b);
                bench.plug(swapped);
                seen.until(&mut robot, "other boards", |seen| {
                    [a, b].iter().all(|n| seen.others[*n] > others[*n])
                });
                bench.plug(all);
                swaps += 1;
                [a, b].into()
            }
            // Some are unplugged, and plugged in one after the other.
            1 => {
                let mut left = [None; 3];
                bench.plug(left);
                seen.until(&mut robot, "losses", |seen| (0..3).all(|n| seen.lost[n] > before[n]));
                for next in [a, (a + 1 + b % 2) % 3, (a + 2 - b % 2) % 3] {
                    left[next] = Some(next);
                    bench.plug(left);
                }
                [0, 1, 2].into()
            }
            _ => {
                bench.cut(a, b == 0);
                [a].into()
            }
        };
        let news = seen.news;
        seen.until(&mut robot, "boards", |seen| {
            hit.iter().all(|n| {
                seen.lost[*n] > before[*n] && seen.back[*n] == seen.lost[*n] && seen.news[*n] > news[*n]
            })
        });
    }
    let lost: usize = seen.lost.iter().sum();
    assert!(swaps > losses() / 40, "{swaps} swaps");
    println!("{lost} losses and returns in random order, {swaps} times two boards in each other's places");
    #[cfg(target_os = "linux")]
    assert_eq!(threads("random"), 3);
    // The test holds one, a board's open link two: itself and the way back to it.
    assert!(bench.rigs.iter().all(|rig| Arc::strong_count(rig) <= 3));
    drop(robot);
    #[cfg(target_os = "linux")]
    assert_eq!(threads("random"), 0);
    assert!(bench.rigs.iter().all(|rig| Arc::strong_count(rig) == 1));
    assert_eq!(Arc::strong_count(&bench), 1);
}

#[test]
fn boards_of_one_garment_are_distinguished_by_their_serial_numbers() {
    let bench = Bench::new();
    // Nothing is stated: who is met first is known from then on.
    let mut robot = bench.robot("serial", |_| Identity::default(), true);
    let mut seen = Seen::default();
    seen.until(&mut robot, "the first frames", |seen| seen.news.iter().all(|news| *news > 0));
    bench.plug([Some(1), Some(0), Some(2)]);
    seen.until(&mut robot, "other boards", |seen| seen.others[0] > 0 && seen.others[1] > 0);
    bench.plug([Some(0), Some(1), Some(2)]);
    seen.until(&mut robot, "boards", |seen| seen.back[0] == 1 && seen.back[1] == 1);
    assert_eq!((seen.lost, seen.others[2]), ([1, 1, 0], 0));
}

#[test]
fn a_board_that_is_not_there_at_the_start_is_waited_for() {
    let bench = Bench::new();
    bench.plug([Some(0), None, Some(2)]);
    let mut robot = bench.robot("absent", |_| Identity::default(), false);
    let (mut absent, mut met, mut news) = (Vec::new(), BTreeSet::new(), [0; 3]);
    let begun = Instant::now();
    while met.len() < 3 || news[1] == 0 {
        assert!(begun.elapsed() < Duration::from_secs(30));
        let Some(event) = robot.wait(Duration::from_millis(100)) else { continue };
        match event.what {
            BoardEvent::State(BoardState::Absent { why }) => absent.push((event.board, why)),
            BoardEvent::State(BoardState::Met) => drop(met.insert(event.board)),
            BoardEvent::News(_) => news[event.board] += 1,
            other => panic!("{other:?}"),
        }
        if met.len() == 2 && news[0] > 10 && news[2] > 10 {
            bench.plug([Some(0), Some(1), Some(2)]);
        }
    }
    assert_eq!(absent, [(1, "nothing is plugged in".into())]);
}

#[test]
fn of_a_board_whose_events_are_not_taken_images_are_dropped_and_counted() {
    let bench = Bench::new();
    let plan = |number: usize| {
        let bench = bench.clone();
        BoardPlan::of(
            NAMES[number],
            move || bench.clone().open(number, false),
            |session| {
                session.parts().0.start(0)?;
                Ok(Required::default())
            },
        )
    };
    let read_event = |_: &Client, event: &Event, _: Stamp| match event {
        Event::Frame { frame, .. } => Some(("frame", *frame)),
        Event::Contacts { frame, .. } => Some(("contacts", *frame)),
        _ => None,
    };
    let mut robot =
        RobotStream::start(vec![plan(0)], WhenFull::DropImages, |_, queue| queue.make(read_event)).unwrap();
    let begun = Instant::now();
    while robot.dropped(0) < 20 {
        std::thread::sleep(Duration::from_millis(20));
        assert!(begun.elapsed() < Duration::from_secs(30));
    }
    // Taken as fast as they come from now on: each image either comes or is counted.
    let (mut frames, mut contacts, mut reported) = (Vec::new(), Vec::new(), 0);
    while frames.len() < 400 {
        match robot.wait(Duration::from_secs(5)).expect("a board streams").what {
            BoardEvent::News(("frame", frame)) => frames.push(frame),
            BoardEvent::News((_, frame)) => contacts.push(frame),
            BoardEvent::State(BoardState::Dropped { images }) => reported = images,
            _ => {}
        }
    }
    let missing: u32 = frames.windows(2).map(|pair| pair[1] - pair[0] - 1).sum();
    let before = u64::from(frames[0] - contacts[0].min(frames[0]));
    assert_eq!(reported, robot.dropped(0));
    assert_eq!(u64::from(missing) + before, reported, "{frames:?}");
    // What the start forgets is reported with a list of its own, of a frame that may have had one.
    assert!(
        contacts.windows(2).all(|pair| pair[1] - pair[0] <= 1),
        "a list of contacts is missing: {contacts:?}"
    );
}
