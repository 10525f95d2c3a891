//! Sends the pages of a robot's boards how all boards are, and what touches mean to the robot.

use super::hub::PageHub;
use super::hubs::PageHubs;
use super::lines::{RobotBoardLine, RobotIntentLine, RobotLine};
use super::said::Said;
use super::shot::text;
use serde::Serialize;
use std::sync::Arc;
use std::time::Duration;
use taxel::mind::{BoardSense, HostInputLine, ROBOT_INTENT, RobotMeaningLine, RobotMind};
use taxel::robot::{BoardEvent, BoardState, ReadRobot, RobotEvent};
use taxel::text::words;
use taxel::time::Instant;

/// Shortest time between two messages of a kind.
const PERIOD: Duration = Duration::from_millis(100);
/// Longest time between two messages about the boards: a page is shown that the program is there, also while its
/// board is not.
const ALIVE: Duration = Duration::from_secs(1);

/// The pages of a robot's boards, a hub for each board.
pub struct RobotPages<'a> {
    robot: &'a ReadRobot,
    hubs: Vec<Arc<PageHub>>,
    boards: Vec<RobotBoardLine<'a>>,
    /// True if the boards are not as they were sent last; and when that was.
    is_new: bool,
    sent_boards: Instant,
    /// Meaning of touches as it was reported last, without its time.
    meant: Option<RobotMeaningLine>,
    sent: Instant,
}

impl<'a> RobotPages<'a> {
    /// Pages on which all boards are absent.
    pub fn new(robot: &'a ReadRobot) -> RobotPages<'a> {
        let count = robot.boards.len();
        let (state, since_us, why, contacts) = ("absent", None, None, 0);
        let boards = robot.boards.iter().map(|board| RobotBoardLine {
            name: board.name.as_str(),
            state,
            since_us,
            why: why.clone(),
            contacts,
            counts_per_newton: None,
        });
        let mut pages = RobotPages {
            robot,
            hubs: (0..count).map(|_| Arc::new(PageHub::among(count))).collect(),
            boards: boards.collect(),
            is_new: false,
            sent_boards: Instant::now(),
            meant: None,
            sent: Instant::now(),
        };
        pages.announce_boards();
        pages
    }

    /// The hub of a board.
    pub fn hub(&self, board: usize) -> Arc<PageHub> {
        self.hubs[board].clone()
    }

    /// All hubs, by the names of their boards.
    pub fn hubs(&self) -> PageHubs {
        let names = self.robot.boards.iter().map(|board| board.name.clone());
        PageHubs::Boards(names.zip(self.hubs.iter().cloned()).collect())
    }

    /// Handles an event of a board; `sense` is what its news say of touches.
    pub fn event<T>(&mut self, event: &RobotEvent<T>, sense: impl Fn(&T) -> Option<&BoardSense>) {
        let host_us = event.stamp.host_us;
        let board = &mut self.boards[event.board];
        let before = board.clone();
        match &event.what {
            BoardEvent::News(news) => {
                if let Some(BoardSense::Contacts(contacts)) = sense(news) {
                    board.contacts = contacts.len();
                }
            }
            BoardEvent::State(BoardState::Met | BoardState::Back { .. }) => {
                (board.state, board.since_us, board.why) = ("live", None, None);
            }
            BoardEvent::State(BoardState::Absent { why }) => {
                (board.state, board.why) = ("absent", Some(why.clone()))
            }
            BoardEvent::State(BoardState::Lost { since_us, why }) => {
                board.gone("lost", *since_us, Some(why.clone()))
            }
            BoardEvent::State(BoardState::Other { why }) => {
                let since_us = board.since_us.unwrap_or(host_us);
                board.gone("other", since_us, Some(why.clone()));
            }
            BoardEvent::State(BoardState::Over { .. }) => board.gone("over", host_us, None),
            BoardEvent::State(BoardState::Failed(error)) => {
                board.gone("failed", host_us, Some(words::sentence(error)))
            }
            // Of scans: pages get their images from the board's thread.
            BoardEvent::State(BoardState::Dropped { .. }) => {}
        }
        self.is_new |= *board != before;
    }

    /// The mind was given this: pages show the robot in its posture.
    pub fn take_input(&self, line: &HostInputLine) {
        let positions: Vec<_> = line.joints().map(|(joint, at)| (joint.to_string(), at)).collect();
        if positions.is_empty() {
            return;
        }
        for hub in &self.hubs {
            if let Err(error) = hub.joints(&positions) {
                hub.say(&Said::note(format!("the robot: {error:#}")));
            }
        }
    }

    /// Sends what is new to the pages; `mind` is the robot's, if boards are at one time.
    pub fn turn(&mut self, mind: Option<&RobotMind>) {
        if self.sent.elapsed() < PERIOD {
            return;
        }
        self.sent = Instant::now();
        if self.is_new || self.sent_boards.elapsed() >= ALIVE {
            self.announce_boards();
        }
        if let Some(mind) = mind {
            self.announce_mind(mind);
        }
    }

    fn announce_mind(&mut self, mind: &RobotMind) {
        let Some(meaning) = mind.meaning() else { return };
        let line = RobotMeaningLine::of(mind, meaning);
        // That time has passed is no news.
        let meant = Some(RobotMeaningLine { host_time_us: 0, ..line.clone() });
        if meant == self.meant {
            return;
        }
        self.meant = meant;
        self.announce(ROBOT_INTENT, &RobotIntentLine { text: line.text(), line });
    }

    /// Sends a message to all pages: it is encoded once, however many boards there are.
    fn announce(&self, kind: &'static str, line: &impl Serialize) {
        let line = text(line);
        self.hubs.iter().for_each(|hub| hub.announce(kind, line.clone()));
    }

    fn announce_boards(&mut self) {
        (self.is_new, self.sent_boards) = (false, Instant::now());
        for (hub, board) in self.hubs.iter().zip(&mut self.boards) {
            board.counts_per_newton = hub.counts_per_newton();
        }
        for (hub, board) in self.hubs.iter().zip(&self.boards) {
            let line = RobotLine { name: &self.robot.name, board: board.name, boards: &self.boards };
            hub.state("robot", &line);
        }
    }
}

impl RobotBoardLine<'_> {
    fn gone(&mut self, state: &'static str, since_us: u64, why: Option<String>) {
        (self.state, self.since_us, self.why, self.contacts) = (state, Some(since_us), why, 0);
    }
}
