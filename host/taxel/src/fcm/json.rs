//! Maps as JSON, in the form of the reference cases (`names`, `W`, `x0`).

use super::decimal::Decimal;
use super::engine::Problem;
use crate::error::{Context, Error, MapFileError, Result};
use crate::files::input;
use serde_json::Value;
use std::path::Path;

/// Reads a JSON map. Errors are sentences with file, field and value.
pub fn read(path: &Path) -> Result<Problem> {
    let file = path.display();
    let text = input::text(path).with_context(|| format!("{file}: cannot be read"))?;
    parse(&text).map_err(|error| error.context(file))
}

/// Parses the text of a JSON map.
pub fn parse(text: &str) -> Result<Problem> {
    let value: Value = serde_json::from_str(text).map_err(|error| not_json(text, &error))?;
    let names = array(&value, "names")?;
    let names: Vec<String> = names
        .iter()
        .enumerate()
        .map(|(i, n)| {
            n.as_str()
                .map(String::from)
                .ok_or_else(|| error!(MapFileError::Malformed, "names[{i}] = {n} is not a text"))
        })
        .collect::<Result<_>>()?;
    let n = names.len();
    if n == 0 {
        fail!(MapFileError::Malformed, "names is empty");
    }
    if let Some(twice) = names.iter().enumerate().find(|(i, name)| names[..*i].contains(name)) {
        fail!(MapFileError::Malformed, "names: {} is given twice", twice.1);
    }
    let rows = sized(array(&value, "W")?, n, "W", "rows")?;
    let mut weights = Vec::with_capacity(n);
    for (from, row) in names.iter().zip(rows) {
        let row = row
            .as_array()
            .ok_or_else(|| error!(MapFileError::Malformed, "W[{from}] is not a list of numbers"))?;
        let row = sized(row, n, &format!("W[{from}]"), "values")?;
        let row = names.iter().zip(row).map(|(to, w)| fraction(w, || format!("W[{from}][{to}]")));
        weights.push(row.collect::<Result<_>>()?);
    }
    let start = sized(array(&value, "x0")?, n, "x0", "values")?;
    let start = names.iter().zip(start).map(|(concept, v)| fraction(v, || format!("x0[{concept}]")));
    Ok(Problem { weights, start: start.collect::<Result<_>>()?, names, thresholds: Vec::new() })
}

/// JSON has no NaN, but programs write it: say so instead of "expected value".
fn not_json(text: &str, error: &serde_json::Error) -> Error {
    let line = text.lines().nth(error.line().saturating_sub(1)).unwrap_or("");
    let rest = line.get(error.column().saturating_sub(1)..).unwrap_or("");
    match ["NaN", "Infinity", "-Infinity"].into_iter().find(|word| rest.starts_with(word)) {
        Some(word) => error!(MapFileError::Malformed, "line {}: {word} is not a finite number", error.line()),
        None => error!(MapFileError::Malformed, "not JSON: {error}"),
    }
}

fn array<'a>(value: &'a Value, key: &str) -> Result<&'a Vec<Value>> {
    let object = value.as_object();
    let object = object
        .ok_or_else(|| error!(MapFileError::Malformed, "not a JSON object with the keys names, W and x0"))?;
    let field = object.get(key).ok_or_else(|| error!(MapFileError::Malformed, "{key} is missing"))?;
    field.as_array().ok_or_else(|| error!(MapFileError::Malformed, "{key} is not a list"))
}

fn sized<'a>(list: &'a Vec<Value>, n: usize, field: &str, unit: &str) -> Result<&'a Vec<Value>> {
    if list.len() != n {
        fail!(MapFileError::Malformed, "{field} has {} {unit}, and there are {n} concepts", list.len());
    }
    Ok(list)
}

fn fraction(value: &Value, field: impl Fn() -> String) -> Result<Decimal> {
    let Value::Number(number) = value else {
        fail!(MapFileError::Malformed, "{} = {value} is not a finite number", field())
    };
    let text = number.to_string();
    if number.as_f64().is_some_and(|v| v.abs() > 1.0) {
        fail!(
            MapFileError::Range,
            "{} = {} is outside [-1, 1]",
            field(),
            text.strip_suffix(".0").unwrap_or(&text)
        );
    }
    Decimal::parse(&text)
        .ok_or_else(|| error!(MapFileError::Range, "{} = {text} has more than 17 decimals", field()))
}
