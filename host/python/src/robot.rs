//! A robot of several boards: opened, iterated, asked by the names of its boards.

use crate::error::{argument, raised};
use crate::event::{self, Fact, Teller};
use pyo3::prelude::*;
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use taxel::client::{Client, Event};
use taxel::record::Stamp;
use taxel::robot::{
    BoardEvent, BoardLine, BoardOrder, BoardScan, ReadRobot, RobotContacts, RobotContactsLine, RobotEvent,
    RobotSession, ScanReader, Teller as BoardTeller, WhenFull,
};
use taxel::source::{SceneFile, SourceOptions};

/// Longest look for an event: between two, signals are handled.
const LOOK: Duration = Duration::from_millis(100);

/// An open robot: an iterator over the events of all its boards.
#[pyclass(frozen, subclass, module = "taxel")]
pub struct Robot {
    open: Mutex<Option<OpenRobot>>,
    /// Threads that wait to ask for something, for which the reading thread makes room.
    asking: AtomicUsize,
    names: Vec<String>,
}

struct OpenRobot {
    robot: ReadRobot,
    session: RobotSession<BoardFact>,
    /// None if no boards are sewn together.
    contacts: Option<RobotContacts>,
    /// What is told next.
    waiting: VecDeque<Fact>,
}

/// What is made of a board's event, in the board's thread.
struct BoardFact {
    fact: Fact,
    scan: Option<BoardScan>,
}

/// Makes facts of a board's events.
struct FactTeller {
    board: String,
    teller: Teller,
    reader: ScanReader,
}

impl FactTeller {
    /// The fact with its board, and the one time of all boards.
    fn named(&self, mut fact: Fact, stamp: Stamp) -> Fact {
        fact.line["board"] = self.board.as_str().into();
        stamp.mark(&mut fact.line);
        Fact { host_ns: stamp.host_ns(), ..fact }
    }
}

impl BoardTeller<BoardFact> for FactTeller {
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> taxel::Result<Option<BoardFact>> {
        let fact = self.teller.fact(client, event, stamp.host_ns());
        Ok(Some(BoardFact { fact: self.named(fact, stamp), scan: self.reader.scan(client, event) }))
    }

    fn note(&mut self, client: &Client, note: &Event, stamp: Stamp) -> taxel::Result<Option<BoardFact>> {
        let fact = self.teller.note(client, note, stamp.host_ns());
        Ok(Some(BoardFact { fact: self.named(fact, stamp), scan: None }))
    }
}

impl OpenRobot {
    fn open(path: PathBuf, options: &SourceOptions) -> anyhow::Result<OpenRobot> {
        let robot = ReadRobot::read(&path)?;
        let teller = |number: usize| -> Box<dyn BoardTeller<BoardFact>> {
            Box::new(FactTeller {
                board: robot.boards[number].name.clone(),
                teller: Teller::default(),
                reader: ScanReader::new(&robot, number),
            })
        };
        let limit = options.seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        let session = RobotSession::start(robot.plans(options, limit, teller), WhenFull::DropImages)?;
        let contacts = (!robot.seams.is_empty()).then(|| RobotContacts::new(&robot));
        Ok(OpenRobot { robot, session, contacts, waiting: VecDeque::new() })
    }

    /// Looks for what is told next; none if nothing has come for a while.
    fn look(&mut self) -> anyhow::Result<Option<Fact>> {
        if self.waiting.is_empty()
            && let Some(event) = self.session.wait(LOOK)
        {
            self.take(event)?;
        }
        Ok(self.waiting.pop_front())
    }

    fn is_over(&self) -> bool {
        self.waiting.is_empty() && self.session.is_over()
    }

    fn take(&mut self, event: RobotEvent<BoardFact>) -> anyhow::Result<()> {
        let RobotEvent { board, stamp, what } = event;
        let host_us = stamp.host_us;
        if let Some(line) = BoardLine::of(&self.robot.boards[board].name, host_us, &what) {
            self.waiting.push_back(Fact::alone(serde_json::to_value(line)?, stamp.host_ns()));
        }
        let joined = self.contacts.as_mut().map_or(Vec::new(), |contacts| match &what {
            BoardEvent::News(BoardFact { scan: Some(scan), .. }) => contacts.scan(board, scan, host_us),
            BoardEvent::Lost { .. } | BoardEvent::Over | BoardEvent::Failed(_) => {
                contacts.forget(board, host_us)
            }
            _ => Vec::new(),
        });
        if let BoardEvent::News(BoardFact { fact, .. }) = what {
            self.waiting.push_back(fact);
        }
        if !joined.is_empty() {
            let line = serde_json::to_value(RobotContactsLine::of(&self.robot, host_us, &joined))?;
            self.waiting.push_back(Fact::alone(line, stamp.host_ns()));
        }
        Ok(())
    }
}

impl Robot {
    /// The robot, once no other thread has it.
    fn lock(&self) -> MutexGuard<'_, Option<OpenRobot>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What is told next; none if nothing has come for a while, and an outer none at the end.
    fn look(&self) -> anyhow::Result<Option<Option<Fact>>> {
        while self.asking.load(Ordering::Acquire) > 0 {
            std::thread::sleep(Duration::from_micros(100));
        }
        let mut open = self.lock();
        let Some(robot) = open.as_mut() else { return Ok(None) };
        match robot.look()? {
            None if robot.is_over() => Ok(None),
            found => Ok(Some(found)),
        }
    }

    /// Has the robot between two looks of the reading thread.
    fn interrupt(&self) -> MutexGuard<'_, Option<OpenRobot>> {
        self.asking.fetch_add(1, Ordering::AcqRel);
        let open = self.lock();
        self.asking.fetch_sub(1, Ordering::AcqRel);
        open
    }

    fn order(&self, board: Option<&str>, order: &BoardOrder) -> anyhow::Result<()> {
        match self.interrupt().as_ref() {
            Some(robot) => robot.session.order(board, order)?,
            None => return Err(argument("the robot is closed").into()),
        };
        Ok(())
    }
}

#[pymethods]
impl Robot {
    #[new]
    #[pyo3(signature = (path, *, realtime=false, seconds=None))]
    fn new(py: Python<'_>, path: PathBuf, realtime: bool, seconds: Option<f64>) -> PyResult<Robot> {
        if seconds.is_some_and(|seconds| !(0.0..=1e9).contains(&seconds)) {
            return Err(crate::error::usage("seconds must be a time of 0 or more"));
        }
        let options = SourceOptions { realtime, seconds, ..SourceOptions::default() };
        let open = py.detach(|| OpenRobot::open(path, &options)).map_err(raised)?;
        let names = open.session.names().map(String::from).collect();
        Ok(Robot { open: Mutex::new(Some(open)), asking: AtomicUsize::new(0), names })
    }

    fn __iter__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    /// Waits for the next event. Other threads run meanwhile, and Ctrl-C ends the wait.
    fn __next__(&self, py: Python<'_>) -> PyResult<Option<Py<PyAny>>> {
        loop {
            match py.detach(|| self.look()).map_err(raised)? {
                Some(Some(fact)) => return event::object(py, fact).map(Some),
                Some(None) => py.check_signals()?,
                None => return Ok(None),
            }
        }
    }

    /// Names of the boards, in the order of the file.
    #[getter]
    fn boards(&self) -> Vec<String> {
        self.names.clone()
    }

    /// Closes all connections; then there are no more events.
    fn close(&self, py: Python<'_>) {
        py.detach(|| {
            let open = self.interrupt().take();
            drop(open);
        });
    }

    /// Takes the mean of the next frames as the baseline: of this board, or of all.
    #[pyo3(signature = (frames=64, *, board=None))]
    fn tare(&self, py: Python<'_>, frames: u32, board: Option<&str>) -> PyResult<()> {
        let few = u16::try_from(frames).ok().filter(|frames| (1..=4096).contains(frames));
        let Some(frames) = few else {
            return Err(crate::error::usage("frames must be a whole number from 1 to 4096"));
        };
        py.detach(|| self.order(board, &BoardOrder::Tare(frames))).map_err(raised)
    }

    /// Sends a scene to this board, or to all: a TOML file, or its text.
    #[pyo3(signature = (path_or_text, *, board=None))]
    fn _set_scene(&self, py: Python<'_>, path_or_text: &str, board: Option<&str>) -> PyResult<()> {
        let send = || self.order(board, &BoardOrder::Scene(Box::new(SceneFile::named(path_or_text)?)));
        py.detach(send).map_err(raised)
    }

    /// Examines lines and inputs of this board, or of all.
    #[pyo3(signature = (*, board=None))]
    fn self_test(&self, py: Python<'_>, board: Option<&str>) -> PyResult<()> {
        py.detach(|| self.order(board, &BoardOrder::SelfTest)).map_err(raised)
    }
}
