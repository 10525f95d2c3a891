//! Minimum, maximum, mean and standard deviation of each feature, element by element (Welford's sums).

use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Statistics of one element.
#[derive(Debug, Clone, Copy)]
struct Element {
    least: f64,
    greatest: f64,
    mean: f64,
    squares: f64,
}

impl Element {
    const NONE: Element =
        Element { least: f64::INFINITY, greatest: f64::NEG_INFINITY, mean: 0.0, squares: 0.0 };

    fn take(&mut self, value: f64, count: u64) {
        self.least = self.least.min(value);
        self.greatest = self.greatest.max(value);
        let off = value - self.mean;
        self.mean += off / count as f64;
        self.squares += off * (value - self.mean);
    }
}

/// Statistics of one feature.
#[derive(Debug, Default, Clone)]
struct Feature {
    count: u64,
    elements: Vec<Element>,
}

/// Statistics of all features.
#[derive(Debug, Default)]
pub struct Statistics(BTreeMap<String, Feature>);

impl Statistics {
    /// Adds a row of a feature.
    pub fn take(&mut self, name: &str, values: impl ExactSizeIterator<Item = f64>) {
        if !self.0.contains_key(name) {
            self.0.insert(name.into(), Feature::default());
        }
        let Some(feature) = self.0.get_mut(name) else { return };
        feature.count += 1;
        feature.elements.resize(values.len(), Element::NONE);
        feature
            .elements
            .iter_mut()
            .zip(values)
            .for_each(|(element, value)| element.take(value, feature.count));
    }

    /// Entry of `stats.json` for a feature with this shape.
    pub fn of(&self, name: &str, shape: &[usize]) -> Value {
        let Some(feature) = self.0.get(name) else { return json!({}) };
        let spread = |element: &Element| (element.squares / feature.count as f64).sqrt();
        let told = |what: &dyn Fn(&Element) -> f64| {
            nested(&feature.elements.iter().map(what).collect::<Vec<_>>(), shape)
        };
        json!({
            "min": told(&|element| element.least),
            "max": told(&|element| element.greatest),
            "mean": told(&|element| element.mean),
            "std": told(&spread),
            "count": [feature.count],
        })
    }
}

/// Numbers as nested lists.
fn nested(values: &[f64], shape: &[usize]) -> Value {
    match shape {
        [_, rest @ ..] if !rest.is_empty() => {
            let size = rest.iter().product::<usize>().max(1);
            values.chunks(size).map(|part| nested(part, rest)).collect()
        }
        _ => json!(values),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_those_of_the_book() {
        let mut table = Statistics::default();
        for row in [[1.0, 5.0], [2.0, 5.0], [6.0, 5.0]] {
            table.take("a", row.into_iter());
        }
        let found = table.of("a", &[2, 1]);
        assert_eq!((&found["min"], &found["max"]), (&json!([[1.0], [5.0]]), &json!([[6.0], [5.0]])));
        assert_eq!((&found["mean"], &found["count"]), (&json!([[3.0], [5.0]]), &json!([3])));
        let spread = found["std"][0][0].as_f64().unwrap();
        assert!((spread - (14f64 / 3.0).sqrt()).abs() < 1e-12 && found["std"][1][0] == 0.0, "{found}");
    }
}
