//! Accuracy of the recognition of touches.

use serde_json::{Map, Value, json};

/// Class of a touch, and decision.
pub type Outcome = (usize, usize);

/// Accuracy, confusion and further results.
#[derive(Debug, Clone, Default)]
pub struct Report {
    classes: Vec<String>,
    outcomes: Vec<Outcome>,
    more: Map<String, Value>,
}

impl Report {
    /// A report on touches of these classes.
    pub fn new(classes: &[String], outcomes: Vec<Outcome>) -> Report {
        Report { classes: classes.to_vec(), outcomes, more: Map::new() }
    }

    /// Share of right decisions; 0 without touches.
    pub fn accuracy(&self) -> f64 {
        accuracy(&self.outcomes)
    }

    /// Adds a further result.
    pub fn add(&mut self, key: &str, value: Value) {
        self.more.insert(key.into(), value);
    }

    /// Confusion matrix: rows are true classes, columns decisions.
    fn confusion(&self) -> Vec<Vec<usize>> {
        let mut confusion = vec![vec![0; self.classes.len()]; self.classes.len()];
        self.outcomes.iter().for_each(|(was, taken)| confusion[*was][*taken] += 1);
        confusion
    }

    /// JSON for `--json`.
    pub fn json(&self) -> Value {
        let mut object = json!({
            "accuracy": self.accuracy(),
            "touches": self.outcomes.len(),
            "chance": 1.0 / self.classes.len().max(1) as f64,
            "classes": self.classes,
            "confusion": self.confusion(),
        });
        if let Value::Object(object) = &mut object {
            object.extend(self.more.clone());
        }
        object
    }

    /// Readable form.
    pub fn text(&self) -> String {
        let width = self.classes.iter().map(String::len).max().unwrap_or(0).max(6);
        let mut text =
            format!("accuracy {:.1} % of {} touches\n", 100.0 * self.accuracy(), self.outcomes.len());
        text += &format!("{:>width$}  taken for\n{:>width$}", "was", "");
        self.classes.iter().for_each(|class| text += &format!(" {class:>width$}"));
        for (class, row) in self.classes.iter().zip(self.confusion()) {
            text += &format!("\n{class:>width$}");
            row.iter().for_each(|count| text += &format!(" {count:>width$}"));
        }
        text.push('\n');
        self.more.iter().for_each(|(key, value)| text += &line(key, value));
        text
    }
}

/// Formats a result: a list of objects as a table, an object with such a part by its parts, anything else as
/// a line.
fn line(key: &str, value: &Value) -> String {
    let is_table =
        |value: &Value| value.as_array().is_some_and(|rows| rows.first().is_some_and(Value::is_object));
    match value {
        value if is_table(value) => format!("{key}:\n{}", table(value)),
        Value::Object(parts) if parts.values().any(is_table) => {
            parts.iter().map(|(part, value)| line(&format!("{key} {part}"), value)).collect()
        }
        value => format!("{key}: {value}\n"),
    }
}

/// Formats a list of objects with the keys of the first, one row each.
fn table(rows: &Value) -> String {
    let rows: Vec<&Map<String, Value>> =
        rows.as_array().into_iter().flatten().filter_map(Value::as_object).collect();
    let keys: Vec<&String> = rows.first().into_iter().flat_map(|row| row.keys()).collect();
    let cell = |value: &Value| match value.as_f64() {
        Some(number) if value.is_f64() => format!("{number:.3}"),
        _ => value.to_string(),
    };
    let cells = |row: &&Map<String, Value>| -> String {
        let each = keys
            .iter()
            .map(|key| format!(" {:>1$}", row.get(*key).map_or(String::new(), cell), key.len().max(6)));
        each.collect()
    };
    let head: String = keys.iter().map(|key| format!(" {key:>0$}", key.len().max(6))).collect();
    std::iter::once(head).chain(rows.iter().map(cells)).map(|row| row + "\n").collect()
}

/// Share of right decisions.
pub fn accuracy(outcomes: &[Outcome]) -> f64 {
    outcomes.iter().filter(|(was, taken)| was == taken).count() as f64 / outcomes.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_what_touches_were() {
        let classes = ["pat".to_string(), "rub".to_string()];
        let report = Report::new(&classes, vec![(0, 0), (0, 1), (0, 1), (1, 1)]);
        let json = report.json();
        assert_eq!((report.accuracy(), &json["confusion"]), (0.5, &json!([[1, 2], [0, 1]])));
        assert!(report.text().starts_with("accuracy 50.0 % of 4 touches\n"));
    }

    #[test]
    fn lists_of_objects_are_tables() {
        let mut report = Report::new(&["pat".to_string()], Vec::new());
        report.add("recall", json!({ "pat": 1 }));
        report
            .add("sure", json!({ "count": 2, "bins": [{ "from": 0.5, "n": 12 }, { "from": 0.75, "n": 3 }] }));
        let want = "recall: {\"pat\":1}\nsure count: 2\nsure bins:\n   from      n\n  0.500     12\n  0.750      3\n";
        assert!(report.text().ends_with(want), "{}", report.text());
    }
}
