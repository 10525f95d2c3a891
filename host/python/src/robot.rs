//! A robot of several boards: opened, iterated, asked by the names of its boards.

use crate::error::{argument, raised};
use crate::event::{self, Fact, FactReader};
use crate::moments::{KeptMoments, Moment};
use crate::value;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;
use std::collections::{BTreeMap, VecDeque};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use taxel::client::Event;
use taxel::mind::{BoardSense, HostInputLine, MindReader, RobotMeaningLine, RobotMind, RobotReasons};
use taxel::robot::{
    BoardContact, BoardEvent, BoardLine, BoardOrder, BoardState, ReadRobot, RobotEvent, RobotStream, WhenFull,
};
use taxel::session::RunLimit;
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
    session: RobotStream<BoardFact>,
    /// None unless all boards are at one time.
    mind: Option<RobotMind>,
    /// None if nothing is kept.
    kept: Option<KeptMoments>,
    /// Host time of the begin, us.
    begun_us: u64,
    /// Facts that are reported next.
    waiting: VecDeque<Fact>,
}

/// Result of a board's event, in the board's thread.
struct BoardFact {
    fact: Fact,
    /// None unless it is a list of contacts, and those are kept.
    contacts: Option<Vec<BoardContact>>,
    sense: Option<BoardSense>,
}

impl OpenRobot {
    /// Opens it; what its boards have said is kept for so long.
    fn open(path: PathBuf, options: &SourceOptions, keep: Duration) -> anyhow::Result<OpenRobot> {
        let robot = ReadRobot::read(&path)?;
        let is_minded = robot.is_at_one_time(options.realtime);
        let mind = is_minded.then(|| RobotMind::new(&robot)).transpose()?;
        let is_kept = !keep.is_zero();
        let limit = options.seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        let plans = robot.plans(options, &RunLimit::of(options.frames, limit));
        let session = RobotStream::start(plans, WhenFull::DropImages, |number, queue| {
            let board = &robot.boards[number];
            let (name, mut reader) = (board.name.clone(), FactReader::default());
            let mut mind = is_minded.then(|| MindReader::new(&robot, number));
            queue.make(move |client, event, stamp| {
                // How the board is, the robot says.
                if let Event::Lost { .. } | Event::Back { .. } = event {
                    return None;
                }
                let mut fact = reader.fact(client, event, stamp.host_ns());
                fact.line["board"] = name.as_str().into();
                stamp.mark(&mut fact.line);
                let contacts = is_kept.then(|| BoardContact::all(client, event)).flatten();
                let sense = mind.as_mut().and_then(|mind| mind.sense(client, event));
                Some(BoardFact { fact, contacts, sense })
            })
        })?;
        let begun_us = session.now_us();
        let kept = is_kept.then(|| KeptMoments::new(robot.boards.len(), keep));
        Ok(OpenRobot { robot, session, mind, kept, begun_us, waiting: VecDeque::new() })
    }

    /// Looks for what is reported next; none if nothing has come for a while.
    fn look(&mut self) -> anyhow::Result<Option<Fact>> {
        if self.waiting.is_empty() {
            match self.session.wait(LOOK) {
                Some(event) => self.take(event)?,
                None => self.mean(|mind, now_us| mind.pass(now_us).is_some())?,
            }
        }
        Ok(self.waiting.pop_front())
    }

    fn is_over(&self) -> bool {
        self.waiting.is_empty() && self.session.is_over()
    }

    /// Lets the mind hear something at the host's time, us, and says what it means if that is news.
    fn mean(&mut self, hear: impl FnOnce(&mut RobotMind, u64) -> bool) -> anyhow::Result<()> {
        let now_us = self.session.now_us();
        let Some(mind) = self.mind.as_mut() else { return Ok(()) };
        if hear(mind, now_us)
            && let Some(meaning) = mind.meaning()
        {
            let line = serde_json::to_value(RobotMeaningLine::of(mind, meaning))?;
            self.waiting.push_back(Fact::alone(line, meaning.host_us.saturating_mul(1000)));
        }
        Ok(())
    }

    /// Sends the mind what others know, and the boards the robot's posture.
    fn take_input(&mut self, line: &HostInputLine) -> anyhow::Result<()> {
        let mut taken =
            Err(argument("the boards are not at one time: open the robot with realtime=True").into());
        self.mean(|mind, now_us| {
            let news = mind.take_input(line, now_us).map(|news| news.is_some());
            let is_news = matches!(news, Ok(true));
            taken = news.map(drop).map_err(anyhow::Error::from);
            is_news
        })?;
        taken.map(|()| self.session.take_joints(line.from_us(self.session.now_us()), line.joints()))
    }

    fn take(&mut self, event: RobotEvent<BoardFact>) -> anyhow::Result<()> {
        let RobotEvent { board, stamp, what } = event;
        let host_us = stamp.host_us;
        if let BoardEvent::State(state) = &what {
            let line = BoardLine::of(&self.robot.boards[board].name, host_us, state);
            self.waiting.push_back(Fact::alone(serde_json::to_value(line)?, stamp.host_ns()));
        }
        if let Some(kept) = &mut self.kept {
            match &what {
                BoardEvent::News(BoardFact { fact, contacts, .. }) => {
                    kept.take(board, stamp, fact, contacts.as_deref());
                }
                BoardEvent::State(BoardState::Lost { .. } | BoardState::Failed(_)) => kept.forget(board),
                BoardEvent::State(BoardState::Over { .. }) => kept.end(board),
                BoardEvent::State(_) => {}
            }
        }
        let is_gone = matches!(
            what,
            BoardEvent::State(BoardState::Lost { .. } | BoardState::Over { .. } | BoardState::Failed(_))
        );
        let mut sense = None;
        if let BoardEvent::News(news) = what {
            self.waiting.push_back(news.fact);
            sense = news.sense;
        }
        self.mean(|mind, _| match &sense {
            Some(sense) => mind.board(board, sense, host_us).is_some(),
            None => is_gone && mind.forget(board, host_us).is_some(),
        })
    }
}

impl Robot {
    /// The robot, once no other thread has it.
    fn lock(&self) -> MutexGuard<'_, Option<OpenRobot>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns what is reported next; none if nothing has come for a while, and an outer none at the end.
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

impl Robot {
    fn take_input(&self, line: &HostInputLine) -> anyhow::Result<()> {
        match self.interrupt().as_mut() {
            Some(robot) => robot.take_input(line),
            None => Err(argument("the robot is closed").into()),
        }
    }

    fn reasons(&self, of: Option<&str>) -> anyhow::Result<Value> {
        let open = self.interrupt();
        let Some(robot) = open.as_ref() else { return Err(argument("the robot is closed").into()) };
        let Some(mind) = &robot.mind else {
            return Err(argument("the boards are not at one time: open the robot with realtime=True").into());
        };
        let seconds = robot.session.now_us().saturating_sub(robot.begun_us) as f64 / 1e6;
        Ok(RobotReasons::of(mind, seconds, of, &robot.robot)?.json(&robot.robot))
    }
}

impl Robot {
    /// Returns what is kept, as `find` finds it.
    fn kept<T>(&self, find: impl FnOnce(&KeptMoments) -> T) -> anyhow::Result<T> {
        let open = self.interrupt();
        let Some(robot) = open.as_ref() else { return Err(argument("the robot is closed").into()) };
        match &robot.kept {
            Some(kept) => Ok(find(kept)),
            None => Err(argument("nothing is kept: open the robot with keep=1.0, seconds").into()),
        }
    }

    /// By the names of the boards, in their order.
    fn by_board<'py, T>(
        &self,
        py: Python<'py>,
        all: Vec<Option<T>>,
        object: impl Fn(T) -> PyResult<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for (name, one) in self.names.iter().zip(all) {
            dict.set_item(name, one.map(&object).transpose()?)?;
        }
        Ok(dict)
    }
}

#[pymethods]
impl Robot {
    #[new]
    #[pyo3(signature = (path, *, realtime=false, seconds=None, keep=0.0))]
    fn new(
        py: Python<'_>,
        path: PathBuf,
        realtime: bool,
        seconds: Option<f64>,
        keep: f64,
    ) -> PyResult<Robot> {
        if !(0.0..=3600.0).contains(&keep) {
            return Err(crate::error::usage("keep must be a time of 0 to 3600 seconds"));
        }
        if seconds.is_some_and(|seconds| !(0.0..=1e9).contains(&seconds)) {
            return Err(crate::error::usage("seconds must be a time of 0 or more"));
        }
        let options = SourceOptions { realtime, seconds, ..SourceOptions::default() };
        let open =
            py.detach(|| OpenRobot::open(path, &options, Duration::from_secs_f64(keep))).map_err(raised)?;
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

    /// The newest image of each board, a `Frame` or None, until this time of the host, ns; by default until all
    /// boards have sent theirs.
    #[pyo3(signature = (host_ns=None))]
    fn frames<'py>(&self, py: Python<'py>, host_ns: Option<u64>) -> PyResult<Bound<'py, PyDict>> {
        let host_us = host_ns.map(|ns| ns / 1000);
        let all = py.detach(|| self.kept(|kept| kept.frames(host_us))).map_err(raised)?;
        self.by_board(py, all, |fact| event::object(py, fact))
    }

    /// The contacts of each board, a `Moment` or None, at this time of the host, ns; by default the newest that
    /// all boards have reported.
    #[pyo3(signature = (host_ns=None))]
    fn contacts<'py>(&self, py: Python<'py>, host_ns: Option<u64>) -> PyResult<Bound<'py, PyDict>> {
        let host_us = host_ns.map(|ns| ns / 1000);
        let all = py.detach(|| self.kept(|kept| kept.contacts(host_us))).map_err(raised)?;
        self.by_board(py, all, |fact| Ok(Py::new(py, Moment::object(py, &fact)?)?.into_any()))
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

    /// Sends the robot's map what others know: a value of -1 to 1 by its name, of this age.
    #[pyo3(signature = (name, value, *, age_ms=0))]
    fn set_input(&self, py: Python<'_>, name: String, value: f64, age_ms: u32) -> PyResult<()> {
        let line = HostInputLine { host_input: [(name, value)].into(), age_ms, ..HostInputLine::default() };
        py.detach(|| self.take_input(&line)).map_err(raised)
    }

    /// Sends positions of the robot's joints, rad or m, of this age.
    #[pyo3(signature = (positions, *, age_ms=0))]
    fn set_joints(&self, py: Python<'_>, positions: BTreeMap<String, f64>, age_ms: u32) -> PyResult<()> {
        let line = HostInputLine { positions, age_ms, ..HostInputLine::default() };
        py.detach(|| self.take_input(&line)).map_err(raised)
    }

    /// Returns why the robot's map has its activations now.
    #[pyo3(signature = (of=None))]
    fn why<'py>(&self, py: Python<'py>, of: Option<&str>) -> PyResult<Bound<'py, PyDict>> {
        value::dict(py, &py.detach(|| self.reasons(of)).map_err(raised)?)
    }

    /// Examines lines and inputs of this board, or of all.
    #[pyo3(signature = (*, board=None))]
    fn self_test(&self, py: Python<'_>, board: Option<&str>) -> PyResult<()> {
        py.detach(|| self.order(board, &BoardOrder::SelfTest)).map_err(raised)
    }
}
