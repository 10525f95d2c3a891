//! JSON values as Python objects, and Python objects as JSON values.

use crate::error::usage;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use serde_json::Value;

/// The Python object of a value: dict, list, str, int, float, bool or None. Numbers keep every bit.
pub fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    match value {
        Value::Null => Ok(py.None().into_bound(py)),
        Value::Bool(is_true) => is_true.into_bound_py_any(py),
        Value::Number(number) => match (number.as_u64(), number.as_i64()) {
            (Some(number), _) => number.into_bound_py_any(py),
            (None, Some(number)) => number.into_bound_py_any(py),
            (None, None) => number.as_f64().into_bound_py_any(py),
        },
        Value::String(text) => text.into_bound_py_any(py),
        Value::Array(items) => {
            let list = PyList::empty(py);
            items.iter().try_for_each(|item| list.append(object(py, item)?))?;
            Ok(list.into_any())
        }
        Value::Object(_) => Ok(dict(py, value)?.into_any()),
    }
}

/// The dict of an object; an empty one for any other value.
pub fn dict<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (key, item) in value.as_object().into_iter().flatten() {
        dict.set_item(key, object(py, item)?)?;
    }
    Ok(dict)
}

/// The value of a Python object. Error if it is, or holds, something else than [`object`] makes, or a number that
/// JSON cannot hold.
pub fn of(object: &Bound<'_, PyAny>) -> PyResult<Value> {
    let refused = || usage(format!("{object} is no number, text, list or dict"));
    if object.is_none() {
        Ok(Value::Null)
    } else if object.is_instance_of::<PyBool>() {
        Ok(object.extract::<bool>()?.into())
    } else if object.is_instance_of::<PyInt>() {
        Ok(object.extract::<i64>()?.into())
    } else if object.is_instance_of::<PyFloat>() {
        serde_json::Number::from_f64(object.extract()?).map(Value::Number).ok_or_else(refused)
    } else if object.is_instance_of::<PyString>() {
        Ok(object.extract::<String>()?.into())
    } else if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
        object.try_iter()?.map(|item| of(&item?)).collect()
    } else if let Ok(dict) = object.cast::<PyDict>() {
        let pair =
            |(key, item): (Bound<'_, PyAny>, Bound<'_, PyAny>)| Ok((key.extract::<String>()?, of(&item)?));
        dict.iter().map(pair).collect::<PyResult<serde_json::Map<_, _>>>().map(Value::Object)
    } else {
        Err(refused())
    }
}
