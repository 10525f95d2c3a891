//! The list of mutants that cargo-mutants prints as JSON.

use std::ops::Range;

/// A place in a file: line and column, both from 1.
pub type Place = (usize, usize);

/// A change of the sources.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Mutant {
    /// `FILE:LINE:COLUMN: replace X with Y in FUNCTION`.
    pub name: String,
    pub file: String,
    /// What is replaced.
    pub span: Range<Place>,
    pub replacement: String,
    /// The function around it; none for a constant.
    pub function: Option<Range<Place>>,
}

/// Reads what `cargo mutants --list --json` prints: one key a line, indented by its depth.
pub fn read(json: &str) -> Vec<Mutant> {
    let (mut mutants, mut mutant, mut path) = (Vec::new(), Mutant::default(), Vec::<String>::new());
    for line in json.lines() {
        let line = line.trim().trim_end_matches(',');
        let (key, value) = match line.split_once("\": ") {
            Some((key, value)) => (key.trim_start_matches('"').to_string(), value),
            None => (String::new(), line),
        };
        match value {
            "{" | "[" => path.push(key),
            "}" | "]" => {
                path.pop();
                if path.len() == 1 {
                    mutants.push(std::mem::take(&mut mutant));
                }
            }
            _ => mutant.set(&path, &key, value),
        }
    }
    mutants
}

impl Mutant {
    /// Takes a value; `path` leads to the object that has this key, from the list on.
    fn set(&mut self, path: &[String], key: &str, value: &str) {
        let path: Vec<&str> = path.iter().skip(2).map(String::as_str).collect();
        let span = match path[..] {
            ["span", _] => &mut self.span,
            ["function", "span", _] => self.function.get_or_insert_default(),
            [] => {
                match key {
                    "name" => self.name = text(value),
                    "file" => self.file = text(value),
                    "replacement" => self.replacement = text(value),
                    _ => {}
                }
                return;
            }
            _ => return,
        };
        let place = if path.ends_with(&["start"]) { &mut span.start } else { &mut span.end };
        *(if key == "line" { &mut place.0 } else { &mut place.1 }) = value.parse().unwrap_or(0);
    }
}

/// A string of JSON.
fn text(value: &str) -> String {
    let inner = value.strip_prefix('"').and_then(|value| value.strip_suffix('"'));
    let mut signs = inner.unwrap_or(value).chars();
    let mut text = String::new();
    while let Some(sign) = signs.next() {
        text.push(match (sign, sign == '\\') {
            (_, true) => match signs.next() {
                Some('n') => '\n',
                Some('t') => '\t',
                Some(other) => other,
                None => '\\',
            },
            (sign, _) => sign,
        });
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_read() {
        let json = r#"[
  {
    "file": "core/src/a.rs",
    "function": {
      "function_name": "f",
      "span": {
        "end": {
          "column": 2,
          "line": 11
        },
        "start": {
          "column": 1,
          "line": 8
        }
      }
    },
    "genre": "FnValue",
    "name": "core/src/a.rs:10:5: replace f -> &str with \"x\"",
    "replacement": "\"x\"",
    "span": {
      "end": {
        "column": 66,
        "line": 10
      },
      "start": {
        "column": 5,
        "line": 10
      }
    }
  },
  {
    "file": "core/src/b.rs",
    "function": null,
    "name": "core/src/b.rs:1:2: replace + with -",
    "replacement": "-"
  }
]"#;
        let list = read(json);
        let first = Mutant {
            name: "core/src/a.rs:10:5: replace f -> &str with \"x\"".into(),
            file: "core/src/a.rs".into(),
            span: (10, 5)..(10, 66),
            replacement: "\"x\"".into(),
            function: Some((8, 1)..(11, 2)),
        };
        assert_eq!((list.len(), &list[0]), (2, &first));
        assert_eq!((list[1].function.clone(), list[1].replacement.as_str()), (None, "-"));
    }
}
