//! The very boards of a robot and its mind, stepped by hand.

use crate::error::{argument, raised, usage};
use crate::event::{self, Fact};
use crate::value;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use taxel::mind::{self, HostInputLine, RobotMeaningLine, RobotReasons, RobotTouchLine};
use taxel::robot::ReadRobot;
use taxel::text::words;

/// The boards of a robot without pins and without a clock, and what touches mean to it.
#[pyclass(frozen, subclass, module = "taxel")]
pub struct VirtualRobot {
    robot: ReadRobot,
    stepped: Mutex<mind::VirtualRobot>,
}

impl VirtualRobot {
    fn lock(&self) -> MutexGuard<'_, mind::VirtualRobot> {
        self.stepped.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn number(&self, board: &str) -> anyhow::Result<usize> {
        let names = self.robot.boards.iter().map(|board| board.name.as_str());
        self.robot.board(board).ok_or_else(|| argument(words::unknown("board", board, names)).into())
    }

    fn take_input(&self, line: &HostInputLine, time_us: u64) -> anyhow::Result<()> {
        self.lock().mind().take_input(line, time_us)?;
        Ok(())
    }
}

fn build(path: &Path) -> anyhow::Result<(ReadRobot, mind::VirtualRobot)> {
    let robot = ReadRobot::read(path)?;
    let stepped = mind::VirtualRobot::new(&robot)?;
    Ok((robot, stepped))
}

#[pymethods]
impl VirtualRobot {
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<VirtualRobot> {
        let (robot, stepped) = py.detach(|| build(&path)).map_err(raised)?;
        Ok(VirtualRobot { robot, stepped: Mutex::new(stepped) })
    }

    /// Names of the boards, in the order of the file.
    #[getter]
    fn boards(&self) -> Vec<String> {
        self.robot.boards.iter().map(|board| board.name.clone()).collect()
    }

    /// Number of a board's taxels: the length of a scan.
    fn taxels(&self, py: Python<'_>, board: &str) -> PyResult<usize> {
        let count = || Ok::<_, anyhow::Error>(self.lock().taxels(self.number(board)?)?);
        py.detach(count).map_err(raised)
    }

    /// Takes one scan of a board: the codes of all its taxels, `uint16` by their numbers, and the time in
    /// microseconds, which never goes back. Returns what touches mean then, if that is news.
    fn step(
        &self,
        py: Python<'_>,
        board: &str,
        codes: PyReadonlyArray1<'_, u16>,
        time_us: u64,
    ) -> PyResult<Option<Py<PyAny>>> {
        let codes = codes.as_slice().map_err(|_| usage("the codes must lie side by side"))?;
        let step = || {
            let number = self.number(board)?;
            let mut stepped = self.lock();
            let Some(meaning) = stepped.step(number, codes, time_us)? else { return Ok(None) };
            let line = serde_json::to_value(RobotMeaningLine::of(stepped.mind(), &meaning))?;
            Ok::<_, anyhow::Error>(Some(Fact::alone(line, time_us.saturating_mul(1000))))
        };
        let fact = py.detach(step).map_err(raised)?;
        fact.map(|fact| event::object(py, fact)).transpose()
    }

    /// Sends the robot's map what others know at a time: a value of -1 to 1 by its name, of this age.
    #[pyo3(signature = (name, value, time_us, *, age_ms=0))]
    fn set_input(&self, py: Python<'_>, name: String, value: f64, time_us: u64, age_ms: u32) -> PyResult<()> {
        let line = HostInputLine { host_input: [(name, value)].into(), age_ms, ..HostInputLine::default() };
        py.detach(|| self.take_input(&line, time_us)).map_err(raised)
    }

    /// Sends positions of the robot's joints, rad or m, at a time, of this age.
    #[pyo3(signature = (positions, time_us, *, age_ms=0))]
    fn set_joints(
        &self,
        py: Python<'_>,
        positions: BTreeMap<String, f64>,
        time_us: u64,
        age_ms: u32,
    ) -> PyResult<()> {
        let line = HostInputLine { positions, age_ms, ..HostInputLine::default() };
        py.detach(|| self.take_input(&line, time_us)).map_err(raised)
    }

    /// Returns what touches the robot now: a dict for each touch.
    fn _touches<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let touches =
            || Ok::<_, anyhow::Error>(serde_json::to_value(RobotTouchLine::all(self.lock().mind()))?);
        value::object(py, &py.detach(touches).map_err(raised)?)
    }

    /// Returns why the robot's map has its activations now.
    #[pyo3(signature = (of=None))]
    fn why<'py>(&self, py: Python<'py>, of: Option<&str>) -> PyResult<Bound<'py, PyDict>> {
        let why = || {
            let mut stepped = self.lock();
            let seconds = stepped.mind().meaning().map_or(0.0, |meaning| meaning.host_us as f64 / 1e6);
            let reasons = RobotReasons::of(stepped.mind(), seconds, of, &self.robot)?;
            Ok::<_, anyhow::Error>(reasons.json(&self.robot))
        };
        value::dict(py, &py.detach(why).map_err(raised)?)
    }
}
