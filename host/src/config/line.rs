//! Where in a garment's file something is that an error speaks of.

/// Number of the line, from 1, that an error's first words are about: `block 3`, `seam 0`, `absent 1`, `panel NAME`, `wiring`.
pub fn of(error: &str, text: &str) -> Option<usize> {
    let subject = error.split(':').next()?;
    let (what, which) = subject.split_once(' ').unwrap_or((subject, ""));
    // Of two, the second is the one too many.
    let which = which.rsplit(' ').next()?;
    match what {
        "panel" => nth(text, "panels", panel(text, subject.strip_prefix("panel ")?)?),
        "panels" => nth(text, "panels", 0),
        "block" | "blocks" => nth(text, "blocks", which.parse().ok()?),
        "seam" => nth(text, "seams", which.parse().ok()?),
        "absent" => nth(text, "absent", which.parse().ok()?),
        "wiring" => find(text, |line| line.starts_with("[wiring")).next(),
        _ => None,
    }
}

fn nth(text: &str, table: &str, index: usize) -> Option<usize> {
    let header = format!("[[{table}]]");
    find(text, |line| line.starts_with(&header)).nth(index)
}

/// Index of a panel by its name; of the last where two share it.
fn panel(text: &str, name: &str) -> Option<usize> {
    let parsed: toml::Table = toml::from_str(text).ok()?;
    parsed
        .get("panels")?
        .as_array()?
        .iter()
        .rposition(|panel| panel.get("name").and_then(toml::Value::as_str) == Some(name))
}

fn find(text: &str, is_it: impl Fn(&str) -> bool) -> impl Iterator<Item = usize> {
    text.lines().enumerate().filter(move |(_, line)| is_it(line.trim_start())).map(|(index, _)| index + 1)
}
