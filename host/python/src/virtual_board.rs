//! The very board, stepped by hand.

use crate::array;
use crate::error::{argument, raised, usage};
use crate::event::{self, Fact, FactReader};
use crate::garment::GarmentOrName;
use crate::{request, value};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use std::io;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use taxel::client::Stamps;
use taxel::files::calibrate::ForceScale;
use taxel::record::{Plan, PlannedBoard, Recorder};
use taxel::session::Observer;
use taxel::source::array::NoiseMeter;
use taxel::source::{Port, SceneFile, Source};
use taxel::virtual_board;
use taxel_core::condition::Filter;
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;

/// Source of its stream, in a recording and on the page.
const LABEL: &str = "virtual board";
/// Code of a full scan: that of the board's converter.
const FULL_SCALE: u16 = 4095;

/// A board without pins and without a clock.
#[pyclass(frozen, subclass, module = "taxel")]
pub struct VirtualBoard {
    stepped: Mutex<Hand>,
}

struct Hand {
    board: virtual_board::VirtualBoard,
    reader: FactReader,
    /// Greatest code.
    full_scale: u16,
    /// The codes of a scan, of the converter's scale.
    codes: Vec<u16>,
    stamps: Stamps,
    recorder: Option<Recorder>,
    observers: Vec<Box<dyn Observer + Send>>,
    page: Option<String>,
}

impl Drop for Hand {
    fn drop(&mut self) {
        // Whoever wants to know closes it.
        let _ = self.close();
    }
}

impl Hand {
    /// Scales codes to those of the converter. Error if one is beyond the full scale.
    fn scale(&mut self, codes: &[u16]) -> taxel::Result<()> {
        let full = u32::from(self.full_scale);
        if let Some((taxel, code)) = codes.iter().enumerate().find(|(_, code)| **code > self.full_scale) {
            return Err(argument(format!("code {code} of taxel {taxel} is beyond full_scale={full}")));
        }
        let scaled = |code: &u16| ((u32::from(*code) * u32::from(FULL_SCALE) + full / 2) / full) as u16;
        self.codes.clear();
        self.codes.extend(codes.iter().map(scaled));
        Ok(())
    }

    /// Completes the recording; nobody sees the board any longer.
    fn close(&mut self) -> taxel::Result<()> {
        let client = self.board.client();
        let stamp = self.stamps.now(client);
        let ended = self.observers.drain(..).try_for_each(|mut one| one.ended(client, stamp));
        let finished = self.recorder.take().map_or(Ok(()), |recorder| recorder.finish());
        ended.and(finished)
    }
}

impl VirtualBoard {
    fn lock(&self) -> MutexGuard<'_, Hand> {
        self.stepped.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A board with this garment and scene.
fn build(garment: Garment, scene: Option<&str>) -> anyhow::Result<virtual_board::VirtualBoard> {
    let scene =
        scene.map_or_else(|| Ok(Scene::shipped()), |scene| SceneFile::named(scene).map(|file| file.scene))?;
    Ok(virtual_board::VirtualBoard::new(garment, scene)?)
}

/// Shows the board in the browser, on the page of the address that is returned.
#[cfg(feature = "cli")]
fn viewer() -> anyhow::Result<(Box<dyn Observer + Send>, String)> {
    use taxel_cli::commands::views::view::bind;
    use taxel_cli::view::{PageHub, Viewer, serve};
    let hub = std::sync::Arc::new(PageHub::default());
    let port = serve(bind(None)?, hub.clone())?;
    Ok((Box::new(Viewer::new(hub, None)), format!("http://127.0.0.1:{port}/")))
}

/// Shows the board in the browser.
#[cfg(not(feature = "cli"))]
fn viewer() -> anyhow::Result<(Box<dyn Observer + Send>, String)> {
    Err(argument("view: this package was built without the program").into())
}

/// A link without bytes: the board runs in this process.
struct Nowhere;

impl Port for Nowhere {
    fn read(&mut self, _: &mut [u8]) -> io::Result<Option<usize>> {
        Ok(None)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len())
    }
}

#[pymethods]
impl VirtualBoard {
    #[new]
    #[pyo3(signature = (garment, scene, full_scale, counts_per_newton, record, view))]
    fn new(
        py: Python<'_>,
        garment: GarmentOrName<'_>,
        scene: Option<&str>,
        full_scale: u16,
        counts_per_newton: Option<f32>,
        record: Option<(PathBuf, bool)>,
        view: bool,
    ) -> PyResult<VirtualBoard> {
        if full_scale == 0 {
            return Err(usage("full_scale must be 1 to 65535"));
        }
        if counts_per_newton.is_some_and(|counts| !(counts.is_finite() && counts > 0.0)) {
            return Err(usage("counts_per_newton must be above 0"));
        }
        // No recording replaces what it is made of.
        let inputs = garment.file().into_iter().chain(scene.map(PathBuf::from)).collect();
        let garment = garment.read().map_err(raised)?;
        let begin = || -> anyhow::Result<Hand> {
            let mut board = build(garment, scene)?;
            let recorder = record.map(|(path, overwrite)| {
                Recorder::create(Plan { force: overwrite, inputs, ..Plan::of(path, PlannedBoard::default()) })
            });
            let recorder = recorder.transpose()?;
            let mut observers: Vec<Box<dyn Observer + Send>> = Vec::new();
            observers.extend(recorder.iter().map(|recorder| Box::new(recorder.board(0)) as _));
            let mut page = None;
            if view {
                let (viewer, address) = viewer()?;
                observers.push(viewer);
                page = Some(address);
            }
            let scale = ForceScale::new(None, counts_per_newton);
            board.client().weigh_by(scale.clone());
            observers.opened(&Source { scale, ..Source::new(LABEL, Nowhere) })?;
            let (reader, stamps) = (FactReader::default(), Stamps::start());
            Ok(Hand { board, reader, full_scale, codes: Vec::new(), stamps, recorder, observers, page })
        };
        Ok(VirtualBoard { stepped: Mutex::new(py.detach(begin).map_err(raised)?) })
    }

    /// Number of taxels: the length of a scan.
    #[getter]
    fn taxels(&self, py: Python<'_>) -> usize {
        py.detach(|| self.lock().board.taxels())
    }

    /// Rows and columns of a garment of one panel; None of one of several.
    #[getter]
    fn shape(&self, py: Python<'_>) -> Option<(u16, u16)> {
        py.detach(|| match self.lock().board.areas() {
            [area] => Some((area.rows, area.columns)),
            _ => None,
        })
    }

    /// Scene with limits for the noise of these frames, (n, taxels) codes; None if it cannot be told.
    fn _scene_for_noise(&self, frames: PyReadonlyArray2<'_, u16>) -> Option<String> {
        let mut meter = NoiseMeter::default();
        let frames = frames.as_array();
        let noise = frames.outer_iter().find_map(|codes| meter.add(&codes.to_vec()))?;
        let Scene { condition, contact, .. } = noise.scene(self.lock().board.areas());
        let filter = match condition.filter {
            Filter::Square => "square",
            Filter::Off => "off",
            _ => "persistent",
        };
        Some(format!(
            "[condition]\nfilter = \"{filter}\"\nfloor = {}\n[contact]\nlow = {}\nhigh = {}\n",
            condition.floor, contact.low, contact.high
        ))
    }

    /// Address of the page that shows the board, in a browser of this machine; None without `view`.
    #[getter]
    fn page(&self, py: Python<'_>) -> Option<String> {
        py.detach(|| self.lock().page.clone())
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
            let hand = &mut *self.lock();
            hand.scale(codes)?;
            let Hand { board, reader, codes, stamps, observers, .. } = hand;
            board.step(codes, Micros(time_us), &mut |client, event| {
                let stamp = stamps.of(client, event);
                observers.event(client, event, stamp)?;
                facts.push(reader.fact(client, event, time_us.saturating_mul(1000)));
                Ok(())
            })?;
            Ok::<_, taxel::Error>(facts)
        };
        let facts = py.detach(step).map_err(raised)?;
        facts.into_iter().map(|fact| event::object(py, fact)).collect()
    }

    /// Completes the recording, if there is one.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        py.detach(|| self.lock().close()).map_err(raised)
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
