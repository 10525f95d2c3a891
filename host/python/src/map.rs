//! Fuzzy cognitive maps.

use crate::error::{argument, raised};
use crate::value;
use anyhow::{Context, Error, Result, ensure};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;
use std::collections::BTreeMap;
use taxel::fcm::decimal::Decimal;
use taxel::fcm::engine;
use taxel::fcm::map::MapFile;
use taxel::fcm::{check, draw, load, ran, why};

/// A map of concepts and causes.
#[pyclass(frozen, subclass, module = "taxel.fcm")]
pub struct Map {
    file: MapFile,
}

/// Activations by concept, in Python's order.
type Given = BTreeMap<String, f64>;

/// Activations as decimals, which is what maps count in.
fn decimals(given: Given) -> Result<Vec<(String, Decimal)>> {
    let each = |(name, value): (String, f64)| {
        let decimal = Decimal::from_f64(value).filter(|value| value.is_fraction());
        let must = || argument(format!("{name} must be a number from -1 to 1"));
        Ok((name.clone(), decimal.ok_or_else(must)?))
    };
    given.into_iter().map(each).collect()
}

impl Map {
    fn of(file: Result<MapFile>) -> PyResult<Map> {
        Ok(Map { file: file.map_err(raised)? })
    }
}

#[pymethods]
impl Map {
    /// A map from the keys of its TOML file.
    #[staticmethod]
    fn _from_dict(keys: &Bound<'_, PyDict>) -> PyResult<Map> {
        let keys = value::of(keys)?;
        let read = || -> Result<MapFile> {
            let file: MapFile = serde_json::from_value(keys).context("the map")?;
            file.check_numbers().context("the map")?;
            Ok(file)
        };
        Map::of(read())
    }

    /// A map from the text of its TOML file.
    #[staticmethod]
    fn parse(text: &str) -> PyResult<Map> {
        Map::of(load::parse(text, "the map").map_err(Error::from))
    }

    /// A shipped map by name (`tactile`, `shape`), or a TOML file.
    #[staticmethod]
    fn load(name_or_path: &str) -> PyResult<Map> {
        Map::of(load::map(name_or_path).map_err(Error::from))
    }

    /// Name of the map.
    #[getter]
    fn name(&self) -> &str {
        &self.file.name
    }

    /// Names of the concepts, in the order of every state.
    #[getter]
    fn concepts(&self) -> Vec<&str> {
        self.file.concept.iter().map(|concept| concept.name.as_str()).collect()
    }

    /// The map as the keys of its TOML file.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = serde_json::to_value(&self.file).map_err(raised)?;
        value::dict(py, &all)
    }

    /// The text of its TOML file.
    fn to_toml(&self) -> PyResult<String> {
        toml::to_string(&self.file).context("the map cannot be written").map_err(raised)
    }

    /// Runs the map from these activations in f64 and in the arithmetic of the board.
    #[pyo3(signature = (inputs=Given::new(), *, steps=100))]
    fn run<'py>(&self, py: Python<'py>, inputs: Given, steps: usize) -> PyResult<Bound<'py, PyDict>> {
        let run = || -> Result<Value> {
            let (problem, settings) = self.file.problem(&decimals(inputs)?)?;
            let values = steps.saturating_mul(problem.names.len());
            ensure!(values <= 20_000_000, argument("that many steps are more than 20 million values"));
            let float = engine::run(&problem, &settings, steps);
            Ok(ran::report(&float, &engine::q15(&problem, &settings, steps)))
        };
        value::dict(py, &py.detach(run).map_err(raised)?)
    }

    /// Explains a concept's activation in numbers that add up, and what would change it.
    #[pyo3(signature = (inputs=Given::new(), *, of=None, set=Given::new()))]
    fn explain<'py>(
        &self,
        py: Python<'py>,
        inputs: Given,
        of: Option<&str>,
        set: Given,
    ) -> PyResult<Bound<'py, PyDict>> {
        let explain = || -> Result<Value> {
            let (inputs, set) = (decimals(inputs)?, decimals(set)?);
            let explained = why::explain(&self.file, &inputs, of)?;
            let changed = if set.is_empty() { None } else { Some(why::what_if(&self.file, &inputs, &set)?) };
            Ok(why::report(&explained, changed.as_ref()))
        };
        value::dict(py, &py.detach(explain).map_err(raised)?)
    }

    /// Returns what is to be said about the map: concepts that cannot be reached, whether it settles, whether it fits
    /// the board.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let check = || check::check(&self.file).map(|checked| check::report(&self.file, &checked));
        value::dict(py, &py.detach(check).map_err(raised)?)
    }

    /// The map in DOT.
    fn draw(&self) -> String {
        draw::dot(&self.file, None)
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Map>().is_ok_and(|other| other.get().file == self.file)
    }

    fn __repr__(&self) -> String {
        let (concepts, edges) = (self.file.concept.len(), self.file.edge.len());
        format!("Map({:?}, {concepts} concepts, {edges} edges)", self.file.name)
    }
}
