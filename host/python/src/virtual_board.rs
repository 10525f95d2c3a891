//! The very board, stepped by hand.

use crate::array;
use crate::error::{raised, usage};
use crate::event::{self, Fact, FactReader};
use crate::{request, value};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use std::sync::{Mutex, MutexGuard, PoisonError};
use taxel::files::garments;
use taxel::source::SceneFile;
use taxel::virtual_board;
use taxel_core::format::Micros;
use taxel_core::scene::Scene;

/// A board without pins and without a clock.
#[pyclass(frozen, subclass, module = "taxel")]
pub struct VirtualBoard {
    stepped: Mutex<Hand>,
}

struct Hand {
    board: virtual_board::VirtualBoard,
    reader: FactReader,
}

impl VirtualBoard {
    fn lock(&self) -> MutexGuard<'_, Hand> {
        self.stepped.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A board with this garment and scene.
fn build(garment: &str, scene: Option<&str>) -> anyhow::Result<virtual_board::VirtualBoard> {
    let garment = garments::load(garment)?;
    let scene =
        scene.map_or_else(|| Ok(Scene::shipped()), |scene| SceneFile::named(scene).map(|file| file.scene))?;
    Ok(virtual_board::VirtualBoard::new(garment, scene)?)
}

#[pymethods]
impl VirtualBoard {
    #[new]
    #[pyo3(signature = (garment="reference", scene=None))]
    fn new(py: Python<'_>, garment: &str, scene: Option<&str>) -> PyResult<VirtualBoard> {
        let board = py.detach(|| build(garment, scene)).map_err(raised)?;
        Ok(VirtualBoard { stepped: Mutex::new(Hand { board, reader: FactReader::default() }) })
    }

    /// Number of taxels: the length of a scan.
    #[getter]
    fn taxels(&self, py: Python<'_>) -> usize {
        py.detach(|| self.lock().board.taxels())
    }

    /// Takes one scan: the codes of all taxels, `uint16` by their numbers, and the board's time in
    /// microseconds, which never goes back. Returns the events that it causes.
    fn step(
        &self,
        py: Python<'_>,
        codes: PyReadonlyArray1<'_, u16>,
        time_us: u64,
    ) -> PyResult<Vec<Py<PyAny>>> {
        let codes = codes.as_slice().map_err(|_| usage("the codes must lie side by side"))?;
        let step = || {
            let mut facts: Vec<Fact> = Vec::new();
            let Hand { board, reader } = &mut *self.lock();
            board.step(codes, Micros(time_us), &mut |client, event| {
                facts.push(reader.fact(client, event, time_us.saturating_mul(1000)));
                Ok(())
            })?;
            Ok::<_, taxel::Error>(facts)
        };
        let facts = py.detach(step).map_err(raised)?;
        facts.into_iter().map(|fact| event::object(py, fact)).collect()
    }

    /// Numbers of the taxels that fold, what each is expected to feel now, and the doubt of it, counts.
    fn _folds<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyAny>; 3]> {
        let folds = py.detach(|| self.lock().board.folds());
        let [taxels, expected, doubts] =
            [0, 1, 2].map(|at| folds.iter().map(|all| all[at]).collect::<Vec<u16>>());
        Ok([array::frozen(py, taxels)?, array::frozen(py, expected)?, array::frozen(py, doubts)?])
    }

    /// Queues a request, by its name and its named values.
    fn _request(&self, py: Python<'_>, name: &str, values: &Bound<'_, PyAny>) -> PyResult<()> {
        let values = value::of(values)?;
        py.detach(|| request::ask(self.lock().board.client(), name, values)).map_err(raised)
    }
}
