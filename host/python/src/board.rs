//! A board's stream: opened, iterated, asked.

use crate::error::{argument, blames_board, raised};
use crate::event::{self, Fact, FactReader};
use crate::keywords::Keywords;
use crate::{request, value};
use pyo3::exceptions::PyRuntimeWarning;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::ffi::CString;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use taxel::body::posture::Motion;
use taxel::client::Event;
use taxel::client::clock::SteadyTime;
use taxel::error::SourceError;
use taxel::robot::{BoardConfig, ConfigPlace, Required, read_board};
use taxel::session::{JointTime, POSES_HZ, Poll, Posing, Returns, RunLimit, Session};
use taxel::source::SourceOptions;
use taxel::text::words;
use taxel_core::format::Micros;

/// Time between two attempts to open a board that is waited for.
const TRY: Duration = Duration::from_millis(250);

/// An open board: an iterator over its events.
#[pyclass(frozen, subclass, module = "taxel")]
pub struct Board {
    open: Mutex<Option<Open>>,
    /// Threads that wait to ask for something, for which the reading thread makes room.
    asking: AtomicUsize,
}

/// A session and how long it is read.
struct Open {
    session: Session,
    reader: FactReader,
    clock: SteadyTime,
    limit: RunLimit,
    /// Requests of the start, which the board must accept.
    required: Required,
    over: bool,
}

/// Result of one look at the session.
enum Look {
    Found(Box<Fact>),
    Nothing,
    End,
}

impl Open {
    fn look(&mut self) -> anyhow::Result<Look> {
        let now_ns = self.clock.now_us().saturating_mul(1000);
        if self.over {
            return Ok(self.session.note().map_or(Look::End, |note| self.found(&note, now_ns)));
        }
        match self.session.poll()? {
            Poll::Event(Event::Other { why }) => {
                // Who gathers images never gathers those of two boards.
                self.over = true;
                Err(taxel::Error::from(SourceError::Other(why)).into())
            }
            Poll::Event(event) => {
                self.over |= self.limit.take(&event);
                let refused = self.required.answered(&self.session.source().label, &event);
                refused.map_err(taxel::Error::from)?;
                Ok(self.found(&event, now_ns))
            }
            Poll::Nothing => {
                self.over |= self.limit.look(&mut self.session).map_err(taxel::Error::from)?;
                Ok(Look::Nothing)
            }
            Poll::End => {
                self.over = true;
                Ok(Look::End)
            }
        }
    }

    fn found(&mut self, event: &Event, now_ns: u64) -> Look {
        Look::Found(Box::new(self.reader.fact(self.session.client(), event, now_ns)))
    }
}

/// Opens a board, for a robot if one is named.
fn open(
    config: &BoardConfig,
    options: &SourceOptions,
    returns: Returns,
    posing: Option<Posing>,
) -> anyhow::Result<Open> {
    let board = read_board(config, ConfigPlace::Keywords)?;
    let source = board.open_any(options)?;
    if let Some(key) = config.configures().next().filter(|_| !source.listens) {
        let label = &source.label;
        anyhow::bail!(argument(format!("{key}: {label} is a recording, whose board does not listen")));
    }
    let mut session = Session::new(source, returns);
    let (client, source) = session.parts();
    board.begin(client, source)?;
    let required = if source.listens { Required::of(client) } else { Required::default() };
    posing.into_iter().for_each(|posing| session.pose_by(posing));
    let longest = options.seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    let (reader, clock, limit) =
        (FactReader::default(), SteadyTime::start(), RunLimit::of(options.frames, longest));
    let over = options.frames == Some(0);
    Ok(Open { session, reader, clock, limit, required, over })
}

impl Board {
    /// The session, once no other thread has it.
    fn lock(&self) -> MutexGuard<'_, Option<Open>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Does something with an open board that listens, between two looks of the reading thread.
    fn ask(&self, ask: impl FnOnce(&mut Open) -> anyhow::Result<()>) -> anyhow::Result<()> {
        self.asking.fetch_add(1, Ordering::AcqRel);
        let mut open = self.lock();
        self.asking.fetch_sub(1, Ordering::AcqRel);
        match open.as_mut() {
            None => Err(argument("the stream is closed").into()),
            Some(open) if !open.session.source().listens => {
                let label = &open.session.source().label;
                Err(argument(format!("{label} is a recording, whose board does not listen")).into())
            }
            Some(open) => ask(open),
        }
    }

    /// Looks for an event until nothing has come for a while: a second or so.
    fn look(&self) -> anyhow::Result<Look> {
        let until = Instant::now() + Duration::from_millis(100);
        loop {
            while self.asking.load(Ordering::Acquire) > 0 {
                std::thread::sleep(Duration::from_micros(100));
            }
            let look = match self.lock().as_mut() {
                Some(open) => open.look()?,
                None => Look::End,
            };
            match look {
                Look::Nothing if Instant::now() < until => {}
                look => return Ok(look),
            }
        }
    }
}

/// Warns whoever opens a stream.
fn warn(py: Python<'_>, sentence: &str) -> PyResult<()> {
    PyErr::warn(py, &py.get_type::<PyRuntimeWarning>(), &CString::new(sentence)?, 2)
}

/// The robot that carries a body, if one is named.
fn posing(
    body: Option<&str>,
    robot: Option<&str>,
    bounds: Option<&str>,
    hz: Option<f64>,
) -> anyhow::Result<Option<Posing>> {
    let Some(robot) = robot else {
        let is_alone = bounds.is_some() || hz.is_some();
        anyhow::ensure!(!is_alone, argument("motion and poses_hz are those of a robot: name one"));
        return Ok(None);
    };
    let body = body.ok_or_else(|| argument("a robot needs a body: name one"))?;
    let motion = bounds.map(str::parse).transpose();
    let motion: Option<Motion> = motion.map_err(|why| argument(format!("motion: {why}")))?;
    Ok(Some(Posing::open(body, robot, motion.unwrap_or_default(), hz.unwrap_or(POSES_HZ))?))
}

#[pymethods]
impl Board {
    #[new]
    #[pyo3(signature = (source, keywords, *, seed=None, robot=None, motion=None, poses_hz=None, realtime=false,
                        repeat=false, frames=None, seconds=None, wait=false, once=false))]
    #[allow(clippy::too_many_arguments)] // keywords in Python
    fn new(
        py: Python<'_>,
        source: &str,
        keywords: Keywords,
        seed: Option<u64>,
        robot: Option<String>,
        motion: Option<String>,
        poses_hz: Option<f64>,
        realtime: bool,
        repeat: bool,
        frames: Option<u64>,
        seconds: Option<f64>,
        wait: bool,
        once: bool,
    ) -> PyResult<Board> {
        if seconds.is_some_and(|seconds| !(0.0..=1e9).contains(&seconds)) {
            return Err(crate::error::usage("seconds must be a time of 0 or more"));
        }
        let options = SourceOptions { seed, realtime, repeat, frames, seconds, ..SourceOptions::default() };
        let config = keywords.config(source).map_err(raised)?;
        let returns = if once { Returns::Never } else { Returns::Always };
        let opened = || {
            let posing = posing(config.body.as_deref(), robot.as_deref(), motion.as_deref(), poses_hz)?;
            open(&config, &options, returns, posing)
        };
        let mut is_reported = false;
        let open = loop {
            match py.detach(opened) {
                Ok(open) => break open,
                Err(error) if wait && blames_board(&error) => {
                    if !std::mem::replace(&mut is_reported, true) {
                        warn(py, &format!("{}; waiting for it", words::sentence(error.as_ref())))?;
                    }
                }
                Err(error) => return Err(raised(error)),
            }
            py.detach(|| std::thread::sleep(TRY));
            py.check_signals()?;
        };
        Ok(Board { open: Mutex::new(Some(open)), asking: AtomicUsize::new(0) })
    }

    fn __iter__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    /// Waits for the next event. Other threads run meanwhile, and Ctrl-C ends the wait.
    fn __next__(&self, py: Python<'_>) -> PyResult<Option<Py<PyAny>>> {
        loop {
            match py.detach(|| self.look()).map_err(raised)? {
                Look::Found(fact) => return event::object(py, *fact).map(Some),
                Look::Nothing => py.check_signals()?,
                Look::End => return Ok(None),
            }
        }
    }

    /// Closes the connection; then there are no more events.
    fn close(&self, py: Python<'_>) {
        py.detach(|| {
            self.asking.fetch_add(1, Ordering::AcqRel);
            let open = self.lock().take();
            self.asking.fetch_sub(1, Ordering::AcqRel);
            drop(open);
        });
    }

    /// Short name of the source; None once it is closed.
    #[getter]
    fn label(&self, py: Python<'_>) -> Option<String> {
        py.detach(|| self.lock().as_ref().map(|open| open.session.source().label.clone()))
    }

    /// Queues a request, by its name and its named values.
    fn _request(&self, py: Python<'_>, name: &str, values: &Bound<'_, PyAny>) -> PyResult<()> {
        let values = value::of(values)?;
        py.detach(|| self.ask(|open| request::ask(open.session.parts().0, name, values))).map_err(raised)
    }

    /// Takes positions of joints at a time of the host, ns since 1970, or of the board, us; else now.
    fn _set_joints(
        &self,
        py: Python<'_>,
        positions: BTreeMap<String, f64>,
        host_ns: Option<u64>,
        time_us: Option<u64>,
    ) -> PyResult<()> {
        let at = match (time_us, host_ns) {
            (Some(us), _) => JointTime::Board(Micros(us)),
            (None, Some(ns)) => JointTime::Host(ns / 1000),
            (None, None) => JointTime::Now,
        };
        let take = |open: &mut Open| {
            let positions = positions.iter().map(|(joint, at)| (joint.as_str(), *at));
            Ok(open.session.take_joints(at, positions)?)
        };
        py.detach(|| self.ask(take)).map_err(raised)
    }
}
