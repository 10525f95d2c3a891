//! Translates errors of TOML and JSON readers to plain words.

/// Translates a message; others stay as they are.
pub fn plain(message: &str) -> String {
    let message = message.lines().map(str::trim).collect::<Vec<_>>().join(", ");
    match message.as_str() {
        "invalid digit found in string" => return "it must be a whole number of 0 or more".into(),
        "invalid float literal" => return "it must be a number".into(),
        "number too large to fit in target type" => return "the number is too large".into(),
        "number too small to fit in target type" => return "the number is too small".into(),
        "number would be zero for non-zero type" => return "it must be 1 or more".into(),
        "cannot parse integer from empty string" | "cannot parse float from empty string" => {
            return "a number is missing".into();
        }
        _ => {}
    }
    kind(&message)
        .or_else(|| range(&message))
        .or_else(|| length(&message))
        .or_else(|| name(&message))
        .unwrap_or_else(|| crate::text::words::io(&message, cfg!(windows)))
}

/// `invalid type: FOUND, expected WANTED`, and `invalid value: ...`
fn kind(message: &str) -> Option<String> {
    let rest = message.strip_prefix("invalid type: ").or_else(|| message.strip_prefix("invalid value: "))?;
    let (found, wanted) = rest.rsplit_once(", expected ")?;
    Some(format!("must be {}, not {}", this(wanted), that(found)))
}

/// `N is not in A..=B`
fn range(message: &str) -> Option<String> {
    let (number, range) = message.split_once(" is not in ")?;
    let (low, high) = range.split_once("..=")?;
    [number, low, high]
        .iter()
        .all(|text| text.parse::<i64>().is_ok())
        .then(|| format!("it must be {low} to {high}"))
}

/// `invalid length N, expected WANTED`
fn length(message: &str) -> Option<String> {
    let (count, wanted) = message.strip_prefix("invalid length ")?.split_once(", expected ")?;
    if let Some(most) = wanted.strip_prefix("a string no more than ") {
        let most = most.trim_end_matches(" long");
        return Some(format!("must be a text of at most {most}, not of {count}"));
    }
    // A list without a fixed length exceeds the room for it.
    if let ("a sequence", Ok(count)) = (wanted, count.parse::<u64>()) {
        return Some(format!("there is room for {} values only", count.saturating_sub(1)));
    }
    Some(format!("must be {}, not of {count}", this(wanted)))
}

/// Missing, unknown and duplicate keys and names.
fn name(message: &str) -> Option<String> {
    let field = |prefix: &str| message.strip_prefix(prefix).map(str::to_string);
    if let Some(field) = field("missing field ") {
        return Some(format!("{field} is missing"));
    }
    if let Some(field) = field("duplicate field ") {
        return Some(format!("{field} is given twice"));
    }
    if message.starts_with("data did not match any variant of untagged enum") {
        return Some("has none of the known forms".into());
    }
    let (what, rest) = match (field("unknown field "), field("unknown variant ")) {
        (Some(rest), _) => ("key", rest),
        (_, Some(rest)) => ("name", rest),
        _ => return None,
    };
    let (unknown, known) = rest.split_once(", ").unwrap_or((&rest, ""));
    let known = known.strip_prefix("expected ").map(|known| known.strip_prefix("one of ").unwrap_or(known));
    Some(match known.map(|known| known.replace("` or `", "`, `")) {
        Some(known) => {
            let names = known.split(", ").map(|name| name.trim_matches('`'));
            match crate::text::words::meant(unknown.trim_matches('`'), names) {
                Some(name) => {
                    format!("{unknown} is not a known {what}, did you mean `{name}`? Known are {known}")
                }
                None => format!("{unknown} is not a known {what}: {known}"),
            }
        }
        None => format!("{unknown} is not a known {what}"),
    })
}

/// Translates the expected type.
fn this(wanted: &str) -> String {
    let number = |low: i64, high: i64| format!("a whole number from {low} to {high}");
    match wanted.strip_prefix("a nonzero ").unwrap_or(wanted) {
        "u8" => number(wanted.starts_with("a nonzero").into(), u8::MAX.into()),
        "u16" => number(wanted.starts_with("a nonzero").into(), u16::MAX.into()),
        "u32" => number(wanted.starts_with("a nonzero").into(), u32::MAX.into()),
        "u64" | "usize" | "u128" if wanted.starts_with("a nonzero") => "a whole number of 1 or more".into(),
        "u64" | "usize" | "u128" => "a whole number of 0 or more".into(),
        "i8" => number(i8::MIN.into(), i8::MAX.into()),
        "i16" => number(i16::MIN.into(), i16::MAX.into()),
        "i32" => number(i32::MIN.into(), i32::MAX.into()),
        "i64" | "isize" | "i128" => "a whole number".into(),
        "f32" | "f64" => "a number".into(),
        "a boolean" | "bool" => "true or false".into(),
        "a string" | "string" | "str" | "a borrowed string" => "a text".into(),
        "a character" | "char" => "one character".into(),
        "a sequence" | "sequence" => "a list".into(),
        "a map" | "map" | "table" => "a table".into(),
        "string or map" | "string or table" | "variant identifier" => "one of the known names".into(),
        other => shape(other),
    }
}

/// Translates types with names of their own: a table, a list, or a name.
fn shape(wanted: &str) -> String {
    let count = || wanted.split(' ').find_map(|word| word.parse::<u64>().ok());
    let list =
        ["an array of length ", "a tuple of size ", "tuple "].iter().any(|start| wanted.starts_with(start));
    if list || wanted.ends_with(" element") || wanted.ends_with(" elements") {
        return count().map_or("a list".into(), |count| format!("a list of {count} values"));
    }
    match wanted.split(' ').next() {
        Some("struct" | "internally" | "adjacently") => "a table".into(),
        Some("enum") => "one of the known names".into(),
        _ => wanted.into(),
    }
}

/// Translates what was found.
fn that(found: &str) -> String {
    let quoted = |kind: &str| found.strip_prefix(kind).map(|value| value.trim_matches('`').to_string());
    match found {
        "map" | "table" => return "a table".into(),
        "sequence" | "array" => return "a list".into(),
        "null" | "unit value" | "Option value" => return "nothing".into(),
        "string" => return "a text".into(),
        _ if found.ends_with(" variant") => return "a name".into(),
        _ => {}
    }
    ["string ", "integer ", "floating point ", "boolean ", "character ", "enum "]
        .iter()
        .find_map(|kind| quoted(kind))
        .unwrap_or_else(|| found.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_readers_become_those_of_users() {
        for (theirs, ours) in [
            ("invalid type: string \"a\", expected u64", "must be a whole number of 0 or more, not \"a\""),
            ("invalid value: integer `300`, expected u8", "must be a whole number from 0 to 255, not 300"),
            (
                "invalid value: integer `0`, expected a nonzero u16",
                "must be a whole number from 1 to 65535, not 0",
            ),
            ("invalid type: integer `3`, expected i8", "must be a whole number from -128 to 127, not 3"),
            ("invalid type: integer `3`, expected struct Stuck", "must be a table, not 3"),
            ("invalid type: map, expected a string", "must be a text, not a table"),
            ("invalid type: sequence, expected f64", "must be a number, not a list"),
            ("invalid length 3, expected an array of length 2", "must be a list of 2 values, not of 3"),
            (
                "invalid length 3, expected tuple struct Line with 2 elements",
                "must be a list of 2 values, not of 3",
            ),
            ("invalid length 33, expected a sequence", "there is room for 32 values only"),
            ("missing field `at`", "`at` is missing"),
            ("duplicate field `at`", "`at` is given twice"),
            (
                "unknown field `lo`, expected one of `low`, `high`",
                "`lo` is not a known key, did you mean `low`? Known are `low`, `high`",
            ),
            ("unknown variant `xyz`, expected `b` or `c`", "`xyz` is not a known name: `b`, `c`"),
            ("unknown field `a`, there are no fields", "`a` is not a known key"),
            ("number would be zero for non-zero type", "it must be 1 or more"),
            ("99999 is not in 0..=65535", "it must be 0 to 65535"),
            ("the taxel is not in the garment", "the taxel is not in the garment"),
            ("must be a number or [length, width]", "must be a number or [length, width]"),
        ] {
            assert_eq!(plain(theirs), ours);
        }
    }

    #[test]
    fn no_type_of_rust_is_left() {
        #[derive(Debug, serde::Deserialize)]
        #[allow(dead_code, reason = "it is read for its errors only")]
        struct Stuck {
            taxel: u16,
            level: Option<i8>,
            share: f32,
            at: [u8; 2],
            pair: (u8, bool),
            side: Side,
        }
        #[derive(Debug, serde::Deserialize)]
        enum Side {
            Left,
        }
        let whole = "taxel = 1\nlevel = 2\nshare = 0.5\nat = [1, 2]\npair = [1, true]\nside = \"Left\"\n";
        toml::from_str::<Stuck>(whole).unwrap();
        for wrong in ["\"a\"", "-70000", "1.5", "[1]", "{ a = 1 }", "true", "1979-05-27"] {
            for line in whole.lines() {
                let key = line.split_once(" =").unwrap().0;
                let text = whole.replace(line, &format!("{key} = {wrong}"));
                let Err(error) = toml::from_str::<Stuck>(&text) else { continue };
                let reported = plain(error.message());
                for word in
                    ["struct", "u16", "u8", "i8", "f32", "tuple", "array of", "invalid", "enum", "variant"]
                {
                    assert!(!reported.contains(word), "{key} = {wrong}: {reported}");
                }
            }
        }
    }
}
