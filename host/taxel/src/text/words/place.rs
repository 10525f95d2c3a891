//! Lines and keys of a TOML text: what is at a byte, and where a value is.

use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A step from a table or list to one of its values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step<'a> {
    /// The value of a key.
    Key(&'a str),
    /// The value with this index in a list, from 0.
    At(usize),
}

/// Line of a byte, from 1.
pub(super) fn line(text: &str, at: usize) -> usize {
    1 + text.bytes().take(at).filter(|byte| *byte == b'\n').count()
}

/// Line, from 1, of the value at the end of the steps, or of the last step that exists; none if the text is
/// not TOML.
pub(crate) fn line_of(text: &str, steps: &[Step<'_>]) -> Option<usize> {
    let table = DeTable::parse(text).ok()?;
    let mut start = 0;
    let mut value: Option<&Spanned<DeValue<'_>>> = None;
    for step in steps {
        let next = match (step, value.map(Spanned::get_ref)) {
            (Step::Key(key), None) => table.get_ref().get(*key),
            (Step::Key(key), Some(DeValue::Table(table))) => table.get(*key),
            (Step::At(at), Some(DeValue::Array(list))) => list.get(*at),
            _ => None,
        };
        let Some(found) = next else { break };
        start = found.span().start;
        value = Some(found);
    }
    Some(line(text, start))
}

/// Innermost key whose value contains these bytes; if the text is not TOML, the key before them on their
/// line.
pub(super) fn key_at(text: &str, span: &Range<usize>) -> Option<String> {
    let Ok(table) = DeTable::parse(text) else {
        let begin = text.get(..span.start)?.rfind('\n').map_or(0, |at| at + 1);
        let (key, _) = text.get(begin..span.start)?.split_once('=')?;
        return Some(key.trim().into()).filter(|key: &String| !key.is_empty());
    };
    within(table.get_ref(), span)
}

fn holds(outer: Range<usize>, inner: &Range<usize>) -> bool {
    outer.start <= inner.start && inner.end <= outer.end
}

fn within(table: &DeTable<'_>, span: &Range<usize>) -> Option<String> {
    table.iter().find_map(|(key, value)| {
        let inner = deeper(value, span);
        let own = || holds(value.span(), span) && !matches!(value.get_ref(), DeValue::Table(_));
        inner.or_else(|| own().then(|| key.get_ref().to_string()))
    })
}

/// Tables under a header have only the header's place, so all of them are searched.
fn deeper(value: &Spanned<DeValue<'_>>, span: &Range<usize>) -> Option<String> {
    match value.get_ref() {
        DeValue::Table(table) => within(table, span),
        DeValue::Array(list) => list.iter().find_map(|value| deeper(value, span)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::Step::{At, Key};
    use super::*;

    #[test]
    fn values_are_found() {
        let text =
            "name = \"a\"\nlist = [\n  1,\n  { b = 2 },\n]\n[[edge]]\nfrom = 1\n[[edge]]\nfrom = 2\nto = 3\n";
        let line = |steps: &[Step<'_>]| line_of(text, steps);
        assert_eq!(line(&[Key("name")]), Some(1));
        assert_eq!(line(&[Key("list"), At(1), Key("b")]), Some(4));
        assert_eq!(line(&[Key("edge"), At(1), Key("to")]), Some(10));
        assert_eq!(line(&[Key("edge"), At(1), Key("weight")]), Some(8));
        assert_eq!(line(&[Key("nothing")]), Some(1));
        assert_eq!(line_of("a = = 1", &[Key("a")]), None);
    }
}
