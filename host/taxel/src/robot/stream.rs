//! All boards of a robot, each followed in a thread of its own, as one stream.

use super::board_queue::BoardQueue;
use super::event::{BoardState, RobotEvent};
use super::follow::{Ask, BoardPlan, Supervisor, follow};
use super::order::BoardOrder;
use super::queue::{EventQueue, WhenFull};
use crate::client::clock::SteadyTime;
use crate::client::{Buses, Client};
use crate::error::{Result, UsageError};
use crate::session::{JointTime, Observer, Session};
use crate::text::words;
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

/// Stack of a board's thread: what a `Hello` holds is decoded on it.
const STACK: usize = 8 << 20;

/// A robot's boards as one stream. Dropping it closes all connections.
///
/// ```
/// use std::path::Path;
/// use std::time::Duration;
/// use taxel::client::Event;
/// use taxel::robot::{BoardEvent, ReadRobot, RobotStream, WhenFull};
/// use taxel::session::RunLimit;
/// use taxel::source::SourceOptions;
///
/// let text = "name = \"two\"\n[[boards]]\nname = \"left\"\nsource = \"sim:pat\"\n\
///             [[boards]]\nname = \"right\"\nsource = \"sim:pat\"\n";
/// let read = ReadRobot::parse("two.toml".into(), text.into(), Path::new("."))?;
/// let plans = read.plans(&SourceOptions::default(), &RunLimit::of(None, None));
/// let mut robot = RobotStream::start(plans, WhenFull::Wait, |_, queue| {
///     queue.make(|client, event, _| {
///         matches!(event, Event::Contacts { .. }).then(|| client.contacts().len())
///     })
/// })?;
/// let mut most = [0, 0];
/// while let Some(event) = robot.wait(Duration::from_secs(1)) {
///     if let BoardEvent::News(contacts) = event.what {
///         most[event.board] = contacts.max(most[event.board]);
///     }
/// }
/// assert!(robot.is_over() && most[0] > 0 && most[0] == most[1]);
/// # Ok::<(), taxel::Error>(())
/// ```
pub struct RobotStream<T> {
    queue: Arc<EventQueue<T>>,
    /// Events that were taken together and are not handed out yet.
    taken: VecDeque<RobotEvent<T>>,
    boards: Vec<FollowedBoard>,
    time: SteadyTime,
}

struct FollowedBoard {
    name: String,
    /// True if it takes requests: it is not a recording.
    listens: bool,
    asks: Sender<Ask>,
    thread: Option<JoinHandle<()>>,
}

/// Ends a board's part of the queue, also if its thread panics.
struct FollowEnd<T>(Arc<EventQueue<T>>, usize);

impl<T> Drop for FollowEnd<T> {
    fn drop(&mut self) {
        self.0.end(self.1);
    }
}

impl<T: Send + 'static> RobotStream<T> {
    /// Follows these boards; `observer` is asked for that of each, by its number and with its end of the queue.
    pub fn start(
        plans: Vec<BoardPlan>,
        when_full: WhenFull,
        mut observer: impl FnMut(usize, &BoardQueue<T>) -> Box<dyn Observer + Send>,
    ) -> Result<RobotStream<T>> {
        let queue = Arc::new(EventQueue::new(plans.len()));
        let time = SteadyTime::start();
        let mut stream =
            RobotStream { queue: queue.clone(), taken: VecDeque::new(), boards: Vec::new(), time };
        let buses = Buses::default();
        for (board, plan) in plans.into_iter().enumerate() {
            let (asks, asked) = channel();
            let (name, listens, buses) = (plan.name.clone(), plan.listens, buses.clone());
            let end = FollowEnd(queue.clone(), board);
            let mut supervisor = BoardQueue::new(board, queue.clone(), time, when_full);
            let mut observer = observer(board, &supervisor);
            let thread = Builder::new().name(name.clone()).stack_size(STACK).spawn(move || {
                let ended = follow(plan, &mut *observer, &mut supervisor, &asked, (time, buses));
                supervisor.state(match ended {
                    Ok(remark) => BoardState::Over { remark },
                    Err(error) => BoardState::Failed(error),
                });
                supervisor.hand_over();
                // Whoever hears that the board is over can no longer ask anything of it.
                drop(asked);
                drop(end);
            })?;
            stream.boards.push(FollowedBoard { name, listens, asks, thread: Some(thread) });
        }
        Ok(stream)
    }

    /// Takes the next event; none if there is none within this time, or [no more](RobotStream::is_over).
    /// Events of a board come in their order, those of several boards as they arrive.
    pub fn wait(&mut self, patience: Duration) -> Option<RobotEvent<T>> {
        if self.taken.is_empty() {
            self.queue.take(patience, &mut self.taken);
        }
        self.taken.pop_front()
    }

    /// The host's time now, us since 1970: that of all stamps.
    pub fn now_us(&self) -> u64 {
        self.time.now_us()
    }

    /// True once every board is over and all events are taken.
    pub fn is_over(&self) -> bool {
        self.taken.is_empty() && self.queue.is_over()
    }

    /// Names of the boards.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.boards.iter().map(|board| board.name.as_str())
    }

    /// Images of a board that were dropped so far, because events were not taken in time.
    pub fn dropped(&self, board: usize) -> u64 {
        self.queue.dropped(board)
    }

    /// Asks something of a board, in its thread: its client takes requests, also while the board is lost, and
    /// lasting settings are sent once it is back. An error ends the board with
    /// [`BoardState::Failed`]. Error if there is no such board or it is over.
    pub fn ask(
        &self,
        board: usize,
        ask: impl FnOnce(&mut Client) -> Result<()> + Send + 'static,
    ) -> Result<()> {
        self.have(board, move |session| ask(session.parts().0))
    }

    /// Has something done in a board's thread.
    fn have(
        &self,
        board: usize,
        act: impl FnOnce(&mut Session) -> Result<()> + Send + 'static,
    ) -> Result<()> {
        let Some(followed) = self.boards.get(board) else {
            fail!(UsageError::Argument, "the robot has no board number {board}");
        };
        let over = |_| UsageError::Argument(format!("board {} is over", followed.name));
        Ok(followed.asks.send(Box::new(act)).map_err(over)?)
    }

    /// Gives an order to the board of this name, or to all boards that listen and are not over. Returns the
    /// numbers of these boards; a board that is lost gets the order once it is back. Error if there is none,
    /// the one of this name does not listen or is over, or the scene is invalid.
    pub fn order(&self, board: Option<&str>, order: &BoardOrder) -> Result<Vec<usize>> {
        // What cannot be asked of any board is an error here: in a board's thread it would end the board.
        order.ask(&mut Client::new())?;
        let ask = |number: usize| {
            let order = order.clone();
            self.ask(number, move |client| order.ask(client))
        };
        let Some(name) = board else {
            let listening = (0..self.boards.len()).filter(|number| self.boards[*number].listens);
            let asked: Vec<usize> = listening.filter(|number| ask(*number).is_ok()).collect();
            require!(!asked.is_empty(), UsageError::Argument, "no board listens any longer");
            return Ok(asked);
        };
        let Some(number) = self.boards.iter().position(|board| board.name == name) else {
            fail!(UsageError::Argument, "{}", words::unknown("board", name, self.names()));
        };
        require!(
            self.boards[number].listens,
            UsageError::Argument,
            "board {name} is a recording, whose board does not listen"
        );
        ask(number)?;
        Ok(vec![number])
    }

    /// Takes positions of the robot's joints, rad or m, at a time of the host, us: every board that has a body
    /// is sent its links' poses, 50 times a second. What a board cannot place in its own time, because it has just
    /// begun anew, does not count for it; nor do names and positions that its robot does not have, which a
    /// robot's mind refuses with a reason.
    pub fn take_joints<'a>(&self, host_us: u64, positions: impl IntoIterator<Item = (&'a str, f64)>) {
        let positions: Arc<[(String, f64)]> =
            positions.into_iter().map(|(joint, at)| (joint.to_string(), at)).collect();
        if positions.is_empty() {
            return;
        }
        for board in 0..self.boards.len() {
            let positions = positions.clone();
            // A board that is over has no posture.
            let _ = self.have(board, move |session| {
                if session.posing().is_some() {
                    let positions = positions.iter().map(|(joint, at)| (joint.as_str(), *at));
                    let _ = session.take_joints(JointTime::Host(host_us), positions);
                }
                Ok(())
            });
        }
    }
}

impl<T> Drop for RobotStream<T> {
    fn drop(&mut self) {
        self.queue.close();
        for board in &mut self.boards {
            // A panic has been printed.
            board.thread.take().map(JoinHandle::join);
        }
    }
}
