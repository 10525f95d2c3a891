//! Contacts as a NumPy structured array, field by field what the JSON of a contact has.

use crate::array;
use numpy::PyArrayDescr;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use serde_json::Value;

/// Type of a field.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Field {
    /// A whole number of this many bytes, from 0.
    Whole(usize),
    /// A number; NaN where the JSON has null, or no such key.
    Number,
    /// True or false.
    Flag,
    /// A text of at most this many characters.
    Text(usize),
    /// A whole number of 16 bits; -1 where the JSON has no such key.
    Optional,
}

/// The fields by their names in the JSON, in the units that the names say: taxels and counts where they say none.
const FIELDS: [(&str, Field); 40] = [
    ("id", Field::Whole(4)),
    ("phase", Field::Text(8)),
    ("panel", Field::Whole(1)),
    ("panel_name", Field::Text(16)),
    ("region", Field::Text(16)),
    ("link", Field::Text(16)),
    ("total", Field::Whole(4)),
    ("peak", Field::Whole(2)),
    ("peak_row", Field::Whole(2)),
    ("peak_column", Field::Whole(2)),
    ("area", Field::Whole(2)),
    ("perimeter", Field::Whole(2)),
    ("edge", Field::Whole(2)),
    ("column", Field::Number),
    ("row", Field::Number),
    ("x_mm", Field::Number),
    ("y_mm", Field::Number),
    ("azimuth_rad", Field::Number),
    ("anisotropy", Field::Number),
    ("breadth_mm", Field::Number),
    ("nmi", Field::Number),
    ("nmi_peak", Field::Number),
    ("nmi_s2", Field::Number),
    ("shape", Field::Text(16)),
    ("confidence", Field::Number),
    ("moved_columns", Field::Number),
    ("moved_rows", Field::Number),
    ("columns_per_s", Field::Number),
    ("rows_per_s", Field::Number),
    ("slip", Field::Flag),
    ("unsure", Field::Flag),
    ("duration_ms", Field::Whole(4)),
    ("peak_total", Field::Whole(4)),
    ("peak_breadth_mm", Field::Number),
    ("top", Field::Whole(2)),
    ("bottom", Field::Whole(2)),
    ("left", Field::Whole(2)),
    ("right", Field::Whole(2)),
    ("form_age", Field::Optional),
    ("force_n", Field::Number),
];

impl Field {
    /// NumPy's name of the type, little-endian.
    fn code(self) -> String {
        match self {
            Field::Whole(bytes) => format!("<u{bytes}"),
            Field::Number => "<f8".into(),
            Field::Flag => "?".into(),
            Field::Text(length) => format!("<U{length}"),
            Field::Optional => "<i2".into(),
        }
    }

    /// Appends the bytes of a value.
    fn write(self, value: Option<&Value>, bytes: &mut Vec<u8>) {
        match self {
            Field::Whole(count) => {
                let whole = value.and_then(Value::as_u64).unwrap_or(0).to_le_bytes();
                bytes.extend(whole.iter().take(count));
            }
            Field::Number => bytes.extend(value.and_then(Value::as_f64).unwrap_or(f64::NAN).to_le_bytes()),
            Field::Flag => bytes.push(value.and_then(Value::as_bool).unwrap_or(false).into()),
            Field::Text(length) => {
                let text = value.and_then(Value::as_str).unwrap_or("").chars().map(u32::from);
                let padded = text.chain(std::iter::repeat(0)).take(length);
                bytes.extend(padded.flat_map(u32::to_le_bytes));
            }
            Field::Optional => {
                let age = value.and_then(Value::as_i64).and_then(|age| i16::try_from(age).ok());
                bytes.extend(age.unwrap_or(-1).to_le_bytes());
            }
        }
    }
}

/// Fields of a contact between two scans: those that can be interpolated, and which contact it is.
const MOMENT: [(&str, Field); 15] = [
    ("id", Field::Whole(4)),
    ("panel", Field::Whole(1)),
    ("panel_name", Field::Text(16)),
    ("total", Field::Whole(4)),
    ("force_n", Field::Number),
    ("peak", Field::Whole(2)),
    ("area", Field::Whole(2)),
    ("column", Field::Number),
    ("row", Field::Number),
    ("columns_per_s", Field::Number),
    ("rows_per_s", Field::Number),
    ("top", Field::Whole(2)),
    ("bottom", Field::Whole(2)),
    ("left", Field::Whole(2)),
    ("right", Field::Whole(2)),
];

/// NumPy's type of one contact.
pub fn dtype(py: Python<'_>) -> PyResult<Bound<'_, PyArrayDescr>> {
    static DTYPE: PyOnceLock<Py<PyArrayDescr>> = PyOnceLock::new();
    dtype_of(py, &DTYPE, &FIELDS)
}

/// NumPy's type of one contact between two scans.
pub fn moment_dtype(py: Python<'_>) -> PyResult<Bound<'_, PyArrayDescr>> {
    static DTYPE: PyOnceLock<Py<PyArrayDescr>> = PyOnceLock::new();
    dtype_of(py, &DTYPE, &MOMENT)
}

fn dtype_of<'py>(
    py: Python<'py>,
    made: &PyOnceLock<Py<PyArrayDescr>>,
    fields: &[(&'static str, Field)],
) -> PyResult<Bound<'py, PyArrayDescr>> {
    let make = || {
        let fields: Vec<_> = fields.iter().map(|(name, field)| (*name, field.code())).collect();
        Ok::<_, PyErr>(PyArrayDescr::new(py, fields)?.unbind())
    };
    Ok(made.get_or_try_init(py, make)?.bind(py).clone())
}

/// A read-only array of contacts, from a list of their JSON objects.
pub fn contacts<'py>(py: Python<'py>, list: &Value) -> PyResult<Bound<'py, PyAny>> {
    array::records(py, bytes(list, &FIELDS), &dtype(py)?)
}

/// A read-only array of contacts between two scans, from a list of JSON objects with these fields.
pub fn moment_contacts<'py>(py: Python<'py>, list: &Value) -> PyResult<Bound<'py, PyAny>> {
    array::records(py, bytes(list, &MOMENT), &moment_dtype(py)?)
}

fn bytes(list: &Value, fields: &[(&str, Field)]) -> Vec<u8> {
    let list = list.as_array().map_or(&[][..], Vec::as_slice);
    let mut bytes = Vec::with_capacity(512 * list.len());
    for contact in list {
        fields.iter().for_each(|(name, field)| field.write(contact.get(*name), &mut bytes));
    }
    bytes
}
