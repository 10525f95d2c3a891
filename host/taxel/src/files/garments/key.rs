//! Maps errors of the core to keys of a garment's file.

use taxel_core::garment::{Block, Garment, GarmentError, Line};

/// Path of the key to change, such as `blocks[3].input`.
pub(super) fn key(error: &GarmentError, garment: &Garment) -> String {
    use GarmentError as E;
    let panel = |name: &str| garment.panels.iter().position(|panel| panel.name == name).unwrap_or(0);
    match error {
        E::NoName => "name".into(),
        E::Empty => "panels".into(),
        E::NoBlock => "blocks".into(),
        E::Nameless { panel, key } => format!("panels[{panel}].{key}"),
        E::EmptyPanel(name) => {
            let index = panel(name);
            let rows = garment.panels.get(index).is_some_and(|panel| panel.rows == 0);
            format!("panels[{index}].{}", if rows { "rows" } else { "columns" })
        }
        // Of two panels, the second is reported.
        E::DuplicatePanel(name) => {
            let last = garment.panels.iter().rposition(|panel| panel.name == *name).unwrap_or(0);
            format!("panels[{last}].name")
        }
        E::Pitch { panel: name, .. } | E::HalfPitch(name) => format!("panels[{}].pitch_um", panel(name)),
        E::TooLarge { .. } => {
            let taxels = |index: &usize| {
                garment.panels.get(*index).map(|panel| u32::from(panel.rows) * u32::from(panel.columns))
            };
            format!("panels[{}].rows", (0..garment.panels.len()).max_by_key(taxels).unwrap_or(0))
        }
        E::Inexact { panel: name, .. } => format!("panels[{}].rows", panel(name)),
        E::Uncovered { panel: name, .. } => format!("panels[{}]", panel(name)),
        E::NoSuchPanel { what, index, panel } => no_such_panel(what, *index, *panel, garment),
        E::OutsidePanel { what, index, .. } => outside(what, *index, garment),
        E::OutsideSide { seam, .. } => format!("seams[{seam}].length"),
        E::SelfSewn(seam) => format!("seams[{seam}].b"),
        E::Overlap(_, block) => format!("blocks[{block}]"),
        E::SameSelect(_, block) => format!("blocks[{block}].select"),
        E::Code { block, group, .. } => format!(
            "blocks[{block}].{}",
            match *group {
                "row" => "rows",
                "column" => "columns",
                _ => "select",
            }
        ),
        E::PinTwice(pin) => {
            pins(garment).filter(|(_, used)| used == pin).nth(1).map_or("wiring".into(), |p| p.0)
        }
        E::NoOutput { pin, .. } => {
            pins(garment).find(|(_, used)| used == pin).map_or("wiring".into(), |p| p.0)
        }
        E::TooManyLines => "wiring".into(),
        E::NoAdc { block, .. } => format!("blocks[{block}].input"),
    }
}

/// All pins with their paths, in the order in which they are checked.
fn pins(garment: &Garment) -> impl Iterator<Item = (String, u8)> + '_ {
    let wiring = &garment.wiring;
    let list = |path: &'static str, lines: &[Line]| -> Vec<(String, u8)> {
        let at = |(index, line): (usize, &Line)| (format!("wiring.{path}[{index}].pin"), line.pin);
        lines.iter().enumerate().map(at).collect()
    };
    let lines = [
        list("block.lines", &wiring.block.lines),
        list("row.lines", &wiring.row.lines),
        list("column.lines", &wiring.column.lines),
        list("enable", &wiring.enable),
    ];
    let inputs =
        garment.blocks.iter().enumerate().map(|(at, block)| (format!("blocks[{at}].input"), block.input));
    lines.into_iter().flatten().chain(inputs)
}

fn no_such_panel(what: &str, index: usize, panel: u8, garment: &Garment) -> String {
    match what {
        "seam" => {
            let a = garment.seams.get(index).is_some_and(|seam| seam.a.panel == panel);
            format!("seams[{index}].{}.panel", if a { "a" } else { "b" })
        }
        "block" => format!("blocks[{index}].panel"),
        _ => format!("absent[{index}].panel"),
    }
}

/// Key of a rectangle that is empty or leaves its panel: its size if it begins with the panel, else its
/// origin.
fn outside(what: &str, index: usize, garment: &Garment) -> String {
    let (list, turned, [row, column, rows, columns], panel) =
        match (what, garment.blocks.get(index), garment.absent.get(index)) {
            ("block", Some(b), _) => {
                let Block { rows, columns, .. } = *b;
                ("blocks", b.orientation.transposed, [b.row, b.column, rows.into(), columns.into()], b.panel)
            }
            (_, _, Some(gap)) => ("absent", false, [gap.row, gap.column, gap.rows, gap.columns], gap.panel),
            _ => return what.into(),
        };
    let height = garment.panels.get(usize::from(panel)).map_or(0, |panel| u32::from(panel.rows));
    let (down, across) = if turned { (columns, rows) } else { (rows, columns) };
    let (rows_key, columns_key) = if turned { ("columns", "rows") } else { ("rows", "columns") };
    let low = down == 0 || u32::from(row) + u32::from(down) > height;
    let key = match (low, row, column) {
        _ if across == 0 => columns_key,
        (true, 0, _) => rows_key,
        (true, ..) if down == 0 => rows_key,
        (true, ..) => "row",
        (false, _, 0) => columns_key,
        (false, ..) => "column",
    };
    format!("{list}[{index}].{key}")
}
