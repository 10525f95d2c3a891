//! Garments: read, or a grid of any array of taxels.

use crate::error::{argument, raised, usage};
use pyo3::FromPyObject;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use taxel::files::garments;
use taxel_core::capacity::TAXELS;
use taxel_core::format::name;
use taxel_core::garment::{Garment as Described, Layout, PITCH_UM};

/// Panels of taxels, and their wiring if a board scans them.
#[pyclass(frozen, module = "taxel")]
pub struct Garment {
    garment: Described,
    layout: Layout,
}

/// Distance of columns and of rows, mm.
#[derive(FromPyObject)]
enum PitchMm {
    Both(f64),
    Each(f64, f64),
}

/// A garment, or the name of a preset or of a file.
#[derive(FromPyObject)]
pub enum GarmentOrName<'py> {
    Garment(Bound<'py, Garment>),
    Name(PathBuf),
}

impl GarmentOrName<'_> {
    /// Path of its file, or name of a preset; none of a garment.
    pub fn file(&self) -> Option<PathBuf> {
        match self {
            GarmentOrName::Garment(_) => None,
            GarmentOrName::Name(path) => Some(path.clone()),
        }
    }

    /// The garment. Error if the file cannot be read.
    pub fn read(&self) -> anyhow::Result<Described> {
        match self {
            GarmentOrName::Garment(garment) => Ok(garment.get().garment.clone()),
            GarmentOrName::Name(path) => Ok(garments::load(&path.display().to_string())?),
        }
    }
}

impl Garment {
    fn of(garment: Described) -> anyhow::Result<Garment> {
        let layout =
            Layout::build(&garment, TAXELS, u16::MAX).map_err(|why| argument(format!("garment: {why}")))?;
        Ok(Garment { garment, layout })
    }
}

#[pymethods]
impl Garment {
    /// A garment of one panel without wiring, for an array of taxels that something else reads: `rows` x `columns`,
    /// at most 2,048, their centres `pitch_mm` apart: a number, or (columns, rows); None if it is not known, and
    /// lengths are then in taxels alone.
    #[staticmethod]
    #[pyo3(signature = (rows, columns, *, pitch_mm=None, name="grid"))]
    fn grid(rows: u16, columns: u16, pitch_mm: Option<PitchMm>, name: &str) -> PyResult<Garment> {
        let pitch = match pitch_mm {
            None => [0.0; 2],
            Some(PitchMm::Both(mm)) => [mm; 2],
            Some(PitchMm::Each(x, y)) => [x, y],
        };
        let [least, most] = PITCH_UM.map(|um| f64::from(um) / 1000.0);
        if !pitch.iter().all(|mm| *mm == 0.0 || (least..=most).contains(mm)) {
            return Err(usage(format!("pitch_mm must be {least} to {most}")));
        }
        let short = self::name(name);
        if short.is_empty() || short != name {
            return Err(usage(format!("{name:?} is no name of a garment: 1 to 16 bytes")));
        }
        let pitch_um = pitch.map(|mm| (mm * 1000.0).round() as u32);
        Garment::of(Described::grid(name, rows, columns, pitch_um)).map_err(raised)
    }

    /// A preset by its name (`reference`, `mat-64x32`, `block-4x16`), or a TOML file.
    #[staticmethod]
    fn load(name_or_path: PathBuf) -> PyResult<Garment> {
        GarmentOrName::Name(name_or_path).read().and_then(Garment::of).map_err(raised)
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        self.garment.name.as_str()
    }

    /// Number of taxels: the length of a scan.
    #[getter]
    fn taxels(&self) -> usize {
        self.layout.taxels()
    }

    /// Rows and columns of each panel, by its name, in the order of their taxels.
    #[getter]
    fn panels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for area in self.layout.areas() {
            dict.set_item(area.name.as_str(), (area.rows, area.columns))?;
        }
        Ok(dict)
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Garment>().is_ok_and(|other| other.get().garment == self.garment)
    }

    fn __repr__(&self) -> String {
        let panels =
            self.layout.areas().iter().map(|area| format!("{} {}x{}", area.name, area.rows, area.columns));
        format!("Garment('{}': {})", self.name(), panels.collect::<Vec<_>>().join(", "))
    }
}
