//! Watching a robot: the loop that hands what its boards say to a command.

use super::{HostInput, RequestLines, stop};
use anyhow::{Context, Error, Result};
use std::time::Duration;
use taxel::mind::RobotMind;
use taxel::robot::{BoardEvent, BoardState, ReadRobot, RobotEvent, RobotStream};

/// News of a robot: an event of a board, or that time passes.
pub struct RobotNews<'a, T> {
    /// The robot's boards.
    pub session: &'a RobotStream<T>,
    /// Inputs of the map among the requests since the last news.
    pub inputs: &'a [HostInput],
    /// Event of a board; none: time passes.
    pub event: Option<&'a RobotEvent<T>>,
}

/// Observer of the events of all boards; a board's own stream goes to the observer of its thread.
pub trait RobotObserver<T> {
    /// Longest wait for an event, before requests are read and Ctrl-C is noticed.
    const LOOK: Duration = Duration::from_millis(100);

    /// The robot's map, which takes the host's inputs among the requests; none if there is none.
    fn mind(&mut self) -> Option<&mut RobotMind> {
        None
    }

    /// Takes the next event; none if none has come within a moment, or there are no more.
    fn wait(&mut self, session: &mut RobotStream<T>) -> Option<RobotEvent<T>>
    where
        T: Send + 'static,
    {
        session.wait(Self::LOOK)
    }

    /// Takes news.
    fn event(&mut self, news: RobotNews<'_, T>) -> Result<()>;

    /// True once it needs no more.
    fn is_done(&self) -> bool {
        false
    }
}

/// Hands the events of a robot's boards to an observer, and the requests to the boards, until all are over, the
/// observer is done, or Ctrl-C. Error if the observer fails, at once, or if a board cannot be followed, at the end.
pub fn watch_robot<T: Send + 'static>(
    robot: &ReadRobot,
    mut session: RobotStream<T>,
    mut requests: Option<RequestLines>,
    observer: &mut impl RobotObserver<T>,
) -> Result<()> {
    let mut ended = Ok(());
    while !session.is_over() && !observer.is_done() && !stop::asked() {
        let inputs = requests.as_mut().map_or(Vec::new(), |requests| requests.ask(&session, observer.mind()));
        let event = observer.wait(&mut session);
        observer.event(RobotNews { session: &session, inputs: &inputs, event: event.as_ref() })?;
        if let Some(event) = event {
            ended = ended.and(failed(&robot.boards[event.board].name, event.what));
        }
    }
    ended
}

/// The error of a board that cannot be followed any longer.
fn failed<T>(name: &str, what: BoardEvent<T>) -> Result<()> {
    match what {
        BoardEvent::State(BoardState::Failed(error)) => {
            Err(Error::from(error)).with_context(|| format!("board {name}"))
        }
        _ => Ok(()),
    }
}
