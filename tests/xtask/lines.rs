//! `cargo xtask size`: the lines of the product by crate and language, without blank lines, comments and tests.
//!
//! What distinguishes them is the layout by `rustfmt`: an item behind `#[cfg(test)]` ends with the line that is
//! indented no deeper and ends with `;`, `,` or `}`. Comments within comments are not known.

use crate::{paths, process};
use std::collections::BTreeMap;
use std::process::Command;

/// Endings of files; begin and end of comments; quotes of strings that may span lines, and of those that end
/// with their line at the latest.
struct Language {
    ends: &'static [&'static str],
    comments: &'static [(&'static str, &'static str)],
    long: &'static [&'static str],
    short: &'static [&'static str],
}

const SLASHES: &[(&str, &str)] = &[("//", "\n"), ("/*", "*/")];
const LINE: &[&str] = &["\"", "'"];
const TEXT: &str = "\"\"\"";
const RUST: Language = Language { ends: &["rs"], comments: SLASHES, long: &["\""], short: &[] };
const SCRIPT: Language = Language { ends: &["js"], comments: SLASHES, long: &["`"], short: LINE };
const PYTHON: Language =
    Language { ends: &["py", "pyi"], comments: &[("#", "\n")], long: &[TEXT, "'''"], short: LINE };
const PAGE: Language =
    Language { ends: &["css", "html"], comments: &[("/*", "*/"), ("<!--", "-->")], long: &[], short: &[] };

/// In the order of the columns.
const LANGUAGES: [(&str, Language); 4] =
    [("Rust", RUST), ("JavaScript", SCRIPT), ("Python", PYTHON), ("CSS, HTML", PAGE)];

/// Prints the table.
pub fn run() -> Result<(), String> {
    let listed = process::output(Command::new("git").arg("ls-files").current_dir(paths::root()));
    let listed = listed.ok_or("git lists no files")?;
    let crates: Vec<&str> = listed.lines().filter_map(|path| path.strip_suffix("Cargo.toml")).collect();
    let mut all = [0; LANGUAGES.len()];
    let mut rows = BTreeMap::<String, [usize; LANGUAGES.len()]>::new();
    for path in listed.lines().filter(|path| is_product(path)) {
        let end = path.rsplit('.').next().unwrap_or_default();
        let language = LANGUAGES.iter().position(|(_, language)| language.ends.contains(&end));
        let home = crates.iter().filter(|home| path.starts_with(**home)).max_by_key(|home| home.len());
        let (Some(language), Some(home)) = (language, home) else { continue };
        let text = std::fs::read_to_string(paths::root().join(path));
        let lines = count(&text.map_err(|error| format!("{path}: {error}"))?, &LANGUAGES[language].1);
        let within = path.strip_prefix("core/src/").and_then(|path| path.split_once('/'));
        let folder = within.map(|(folder, _)| format!("core/src/{folder}"));
        [home.trim_end_matches('/').into()].into_iter().chain(folder).for_each(|row| {
            rows.entry(row).or_default()[language] += lines;
        });
        all[language] += lines;
    }
    let heads = LANGUAGES.map(|(name, _)| format!("{name:>12}"));
    println!("{:20}{}{:>12}", "", heads.concat(), "all");
    for (row, lines) in rows.into_iter().chain([("all".into(), all)]) {
        let cells = lines.map(|lines| format!("{lines:>12}"));
        let (name, sum) = (row.replace("core/src/", "  "), lines.iter().sum::<usize>());
        println!("{name:20}{}{sum:>12}", cells.concat());
    }
    Ok(())
}

/// True for what is neither test nor example. The second image of the firmware is the one that measures.
fn is_product(path: &str) -> bool {
    // The trainer is a tool of the repository.
    let beside = |part| matches!(part, "tests" | "tests.rs" | "benches" | "fuzz" | "examples" | "docs");
    !path.split('/').any(|part| beside(part) || part.starts_with("test_"))
        && !["firmware/src/bin/", "host/learn/"].iter().any(|folder| path.starts_with(folder))
}

/// Lines that are neither blank nor comment nor test.
fn count(text: &str, language: &Language) -> usize {
    let (mut total, mut test) = (0, None);
    for (line, lines) in code(text, language) {
        let (depth, line) = (line.len() - line.trim_start().len(), line.trim());
        // A string that stands alone documents what is around it.
        if line.is_empty() || line == TEXT {
            continue;
        }
        if ["#[cfg(test)]", "#[cfg(all(test,"].iter().any(|begin| line.starts_with(begin)) {
            test = test.or(Some(depth));
        }
        match test {
            Some(of) if depth >= of => test = test.filter(|_| depth > of || !line.ends_with([';', ',', '}'])),
            // Also behind a test that ends with its block, without a sign of its own.
            _ => (total, test) = (total + lines, None),
        }
    }
    total
}

/// Code without comments and without what is in strings; a string joins its lines, whose number is with them.
fn code(text: &str, language: &Language) -> Vec<(String, usize)> {
    let (mut lines, mut line, mut rest) = (Vec::new(), (String::new(), 1), text);
    while let Some(sign) = rest.chars().next() {
        let comment = language.comments.iter().find(|(open, _)| rest.starts_with(open));
        let (length, ends) = if let Some((open, close)) = comment {
            let inside = rest[open.len()..].find(close);
            let length = inside.map_or(rest.len(), |inside| open.len() + inside + close.len());
            (length, rest[..length].matches('\n').count())
        } else if let Some((quote, length)) = string(rest, language) {
            line.0.push_str(quote);
            line.1 += rest[..length].lines().skip(1).filter(|line| !line.trim().is_empty()).count();
            (length, 0)
        } else {
            line.0.extend(Some(sign).filter(|sign| *sign != '\n'));
            (sign.len_utf8(), usize::from(sign == '\n'))
        };
        lines.extend((0..ends).map(|_| std::mem::replace(&mut line, (String::new(), 1))));
        rest = &rest[length..];
    }
    lines.push(line);
    lines
}

/// Quote and length of the string or sign that begins here.
fn string<'a>(text: &'a str, language: &Language) -> Option<(&'a str, usize)> {
    if language.ends == RUST.ends {
        let raw = text.strip_prefix('r').unwrap_or_default();
        let (hashes, inside) = raw.split_at(raw.len() - raw.trim_start_matches('#').len());
        if let Some(inside) = inside.strip_prefix('"') {
            let end = format!("\"{hashes}");
            let rest = inside.split_once(&end).map_or("", |(_, rest)| rest);
            return Some(("\"", text.len() - rest.len()));
        }
        if let Some(sign) = text.strip_prefix('\'') {
            // Without an end it is a lifetime.
            let (least, most) = if sign.starts_with('\\') { (2, 12) } else { (1, 2) };
            let mut signs = sign.char_indices().take(most).skip(least);
            return signs.find(|(_, sign)| *sign == '\'').map(|(inside, _)| ("'", inside + 2));
        }
    }
    let quote = language.long.iter().chain(language.short).find(|quote| text.starts_with(**quote))?;
    let (mut signs, is_short) = (text.char_indices().skip(quote.len()), language.short.contains(quote));
    while let Some((at, sign)) = signs.next() {
        match sign {
            '\\' => _ = signs.next(),
            '\n' if is_short => return Some((quote, at)),
            _ if text[at..].starts_with(quote) => return Some((quote, at + quote.len())),
            _ => {}
        }
    }
    Some((quote, text.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_is_counted_and_comments_are_not() {
        let rust =
            "//! doc\n\nfn f<'a>(x: &'a str) { // why\n/* one\ntwo */ g('\"', '\\'', '\\u{1F600}');\n}";
        assert_eq!(count(rust, &RUST), 3);
        let strings = "a(\"// b\");\nc(\"\\\"/*\");\nd(r#\"\"//\n\n  /* \"#, \"two\n  lines\");\n// \"\ne();";
        assert_eq!(count(strings, &RUST), 6);
        let script = "/** @type {a} */\nconst a = `http://\n${b}`; // c\nf('\"', /[\"']/g);\n";
        assert_eq!(count(script, &SCRIPT), 3);
        let python = "\"\"\"Doc.\n\nMore.\"\"\"\n# no\na = \"\"\"b\n# text\"\"\"  # no\nb = '#'\n";
        assert_eq!(count(python, &PYTHON), 3);
        assert_eq!(count("/* a\n*/ b {\n  c: url(//d)\n}\n<!-- e -->", &PAGE), 3);
    }

    #[test]
    fn tests_are_left_out_wherever_they_are() {
        let item = "#[cfg(test)]\n#[inline]\nfn f<A, B>(\n    a: A,\n) -> Result<A, B>\nwhere\n    A: C,\n{\n    g(r\"\n};\n\");\n}\n";
        assert_eq!(count(&format!("a();\n{item}b();\n#[cfg(test)]\nmod tests;\nc();\n{item}"), &RUST), 3);
        let inside = "struct A {\n    #[cfg(all(test, unix))]\n    b: B,\n    c: C,\n}\nfn d() {\n    #[cfg(test)]\n    e()\n}\nf();";
        assert_eq!(count(inside, &RUST), 6);
        assert_eq!(count("#[cfg(any(test, unix))]\nfn a() {}\n\"#[cfg(test)]\"\nb();", &RUST), 4);
        let files = ["core/src/a.rs", "core/tests/a.rs", "core/src/a/tests.rs", "tests/a.rs", "a/test_b.py"];
        assert_eq!(files.map(is_product), [true, false, false, false, false]);
    }
}
