//! Mistakes in a garment's file.

use super::{Mistake, each, file, keys};
use taxel_cli::commands::garment::config::{FileKind, check};
use taxel_core::garment::Garment;

/// A garment with every key.
const BASE: &str = r#"name = "mine"

[wiring]
settle_ns = 3000
falling = false
enable = [
  { pin = 18, inverted = true },
]

[wiring.block]
coding = "binary"
lines = [
  { pin = 2, inverted = false },
]

[wiring.row]
coding = "one-hot"
lines = [
  { pin = 3, inverted = true },
  { pin = 6 }, { pin = 7 }, { pin = 8 },
]

[wiring.column]
coding = "binary"
lines = [
  { pin = 9, inverted = true },
  { pin = 10 }, { pin = 11 }, { pin = 12 },
]

[[panels]]
name = "front"
link = "torso"
region = "chest"
rows = 4
columns = 16
pitch_um = [12000, 10000]

[[panels]]
name = "rear"
link = "torso"
region = "back"
rows = 4
columns = 16
pitch_um = [0, 0]

[[blocks]]
panel = 0
row = 0
column = 0
rows = 4
columns = 16
input = 26
select = 0

[blocks.orientation]
transposed = false
mirror_x = false
mirror_y = false

[[blocks]]
panel = 1
row = 0
column = 0
rows = 4
columns = 16
input = 26
select = 1

[[seams]]
length = 4
reversed = false
a = { panel = 0, side = "right", start = 0 }
b = { panel = 1, side = "left", start = 0 }

[[absent]]
panel = 1
row = 3
column = 15
rows = 1
columns = 1
"#;

const MISTAKES: &[Mistake] = &[
    ("/name", "\"mine\"", "\"\"", "`name`: name: the garment has none"),
    ("/wiring", "[wiring]\n", "[wiring]\nspeed = 3\n", ": `speed` is not a known key"),
    ("/wiring/settle_ns", "= 3000", "= 4000000", "`wiring.settle_ns`: a frame takes 514 ms, at most 500"),
    ("/wiring/settle_ns", "= 3000", "= -1", "`settle_ns`: must be a whole number"),
    ("/wiring/falling", "falling = false", "falling = 0", "`falling`: must be"),
    ("/wiring/enable", "{ pin = 18, inverted = true },\n", "18,\n", "`enable`: must be"),
    (
        "/wiring/enable/pin",
        "pin = 18",
        "pin = 13",
        "`wiring.enable[0].pin`: wiring: pin 13 is no free output of this board: the heartbeat LED is there",
    ),
    ("/wiring/enable/inverted", "18, inverted = true", "18, inverted = 1", "`inverted`: must be"),
    ("/wiring/block", "[wiring.block]\n", "[wiring.block]\nline = 1\n", ": `line` is not a known key"),
    ("/wiring/block/coding", "block]\ncoding = \"binary\"", "block]\ncoding = \"gray\"", "`coding`: "),
    (
        "/wiring/block/lines",
        "lines = [\n  { pin = 2, inverted = false },\n]",
        "lines = 2",
        "`lines`: must be",
    ),
    (
        "/wiring/block/lines/pin",
        "pin = 2,",
        "pin = 0,",
        "`wiring.block.lines[0].pin`: wiring: pin 0 is no free output of this board: the UART transmits there",
    ),
    ("/wiring/block/lines/inverted", "2, inverted = false", "2, inverted = \"no\"", "`inverted`: must be"),
    ("/wiring/row", "[wiring.row]\n", "[wiring.row]\ncodes = 4\n", ": `codes` is not a known key"),
    ("/wiring/row/coding", "\"one-hot\"", "\"one-cold\"", "`coding`: "),
    ("/wiring/row/lines", "  { pin = 6 }, { pin = 7 }, { pin = 8 },\n", "  6,\n", "`lines`: must be"),
    (
        "/wiring/row/lines/pin",
        "{ pin = 3,",
        "{ pin = 40,",
        "`wiring.row.lines[0].pin`: wiring: pin 40 is no free output of this board: the chip ends at GP29",
    ),
    ("/wiring/row/lines/inverted", "3, inverted = true", "3, inverted = [true]", "`inverted`: must be"),
    ("/wiring/column", "[wiring.column]\n", "[wiring.column]\nwidth = 16\n", ": `width` is not a known key"),
    ("/wiring/column/coding", "column]\ncoding = \"binary\"", "column]\ncoding = 2", "`coding`: "),
    (
        "/wiring/column/lines",
        "{ pin = 9, inverted = true },\n",
        "{ pin = 9, pins = 2 },\n",
        "`lines`: `pins` is not a known key",
    ),
    (
        "/wiring/column/lines/pin",
        "{ pin = 9,",
        "{ pin = 2,",
        "`wiring.column.lines[0].pin`: wiring: pin 2 is used twice",
    ),
    (
        "/wiring/column/lines/pin",
        "{ pin = 9,",
        "{ pin = 26,",
        "`wiring.column.lines[0].pin`: wiring: pin 26 is no free output of this board: it is a converter input",
    ),
    ("/wiring/column/lines/inverted", "9, inverted = true", "9, inverted = 0.5", "`inverted`: must be"),
    ("/panels", "name = \"front\"\n", "name = \"front\"\ncolour = 3\n", ": `colour` is not a known key"),
    ("/panels/name", "\"rear\"", "\"front\"", "`panels[1].name`: panel front: the name is used twice"),
    ("/panels/name", "\"rear\"", "\"\"", "`panels[1].name`: panel 1: its name is empty"),
    ("/panels/name", "\"rear\"", "\"the rear of the torso\"", "`name`: "),
    ("/panels/link", "link = \"torso\"", "link = \"\"", "`panels[0].link`: panel 0: its link is empty"),
    ("/panels/region", "\"back\"", "\"\"", "`panels[1].region`: panel 1: its region is empty"),
    ("/panels/rows", "rows = 4", "rows = 0", "`panels[0].rows`: panel front: rows and columns"),
    ("/panels/rows", "rows = 4", "rows = 400", "`panels[0].rows`: panels: 6464 taxels, but only 2048 fit"),
    ("/panels/columns", "columns = 16", "columns = 0", "`panels[0].columns`: panel front: rows and columns"),
    (
        "/panels/pitch_um",
        "[12000, 10000]",
        "[10, 10]",
        "`panels[0].pitch_um`: panel front: pitch_um is 10, outside 500 to 200000: did you mean 10000?",
    ),
    (
        "/panels/pitch_um",
        "[12000, 10000]",
        "[12000, 400000000]",
        "`panels[0].pitch_um`: panel front: pitch_um is 400000000, outside 500 to 200000",
    ),
    (
        "/panels/pitch_um",
        "[12000, 10000]",
        "[12000, 0]",
        "`panels[0].pitch_um`: panel front: pitch_um is 0 along one axis",
    ),
    ("/panels/pitch_um", "[12000, 10000]", "12000", "`pitch_um`: must be"),
    (
        "/blocks",
        "[[blocks]]\npanel = 0\n",
        "[[blocks]]\npanel = 0\npitch = 3\n",
        ": `pitch` is not a known key",
    ),
    (
        "/blocks/panel",
        "[[blocks]]\npanel = 0",
        "[[blocks]]\npanel = 2",
        "`blocks[0].panel`: block 0: there is no panel 2",
    ),
    (
        "/blocks/row",
        "panel = 1\nrow = 0",
        "panel = 1\nrow = 1",
        "`blocks[1].row`: block 1: it is empty or leaves panel rear",
    ),
    (
        "/blocks/column",
        "panel = 1\nrow = 0\ncolumn = 0",
        "panel = 1\nrow = 0\ncolumn = 1",
        "`blocks[1].column`: block 1: it is empty or leaves panel rear",
    ),
    (
        "/blocks/rows",
        "column = 0\nrows = 4",
        "column = 0\nrows = 5",
        "`blocks[0].rows`: block 0: it is empty or leaves panel front",
    ),
    (
        "/blocks/columns",
        "rows = 4\ncolumns = 16\ninput",
        "rows = 4\ncolumns = 0\ninput",
        "`blocks[0].columns`: block 0: it is empty or leaves panel front",
    ),
    (
        "/blocks/input",
        "input = 26",
        "input = 25",
        "`blocks[0].input`: block 0: input 25 is no converter input of this board, which has GP26 to GP29",
    ),
    (
        "/blocks/select",
        "select = 1",
        "select = 2",
        "`blocks[1].select`: block 1: block code 2 does not fit the 2 codes",
    ),
    (
        "/blocks/select",
        "select = 1",
        "select = 0",
        "`blocks[1].select`: blocks 0 and 1: same select code on the same input",
    ),
    (
        "/blocks/orientation",
        "[blocks.orientation]\n",
        "[blocks.orientation]\nturned = 3\n",
        ": `turned` is not a known key",
    ),
    ("/blocks/orientation/transposed", "transposed = false", "transposed = 1", "`transposed`: must be"),
    ("/blocks/orientation/mirror_x", "mirror_x = false", "mirror_x = \"x\"", "`mirror_x`: must be"),
    ("/blocks/orientation/mirror_y", "mirror_y = false", "mirror_y = 0", "`mirror_y`: must be"),
    ("/seams", "[[seams]]\n", "[[seams]]\nwidth = 3\n", ": `width` is not a known key"),
    (
        "/seams/length",
        "length = 4",
        "length = 5",
        "`seams[0].length`: seam 0: it is empty or leaves the Right side of panel front",
    ),
    ("/seams/reversed", "reversed = false", "reversed = 1", "`reversed`: must be"),
    ("/seams/a", "a = { panel = 0, side = \"right\", start = 0 }", "a = 0", "`a`: must be"),
    (
        "/seams/a/panel",
        "a = { panel = 0",
        "a = { panel = 7",
        "`seams[0].a.panel`: seam 0: there is no panel 7",
    ),
    ("/seams/a/side", "side = \"right\"", "side = \"front\"", "`side`: "),
    ("/seams/a/start", "\"right\", start = 0", "\"right\", start = -1", "`start`: must be"),
    (
        "/seams/b",
        "b = { panel = 1, side = \"left\", start = 0 }",
        "b = { panel = 0, side = \"right\" }",
        "`seams[0].b`: seam 0: it sews taxels of a panel to themselves",
    ),
    (
        "/seams/b/panel",
        "b = { panel = 1",
        "b = { panel = 2",
        "`seams[0].b.panel`: seam 0: there is no panel 2",
    ),
    ("/seams/b/side", "side = \"left\"", "side = 3", "`side`: "),
    ("/seams/b/start", "\"left\", start = 0", "\"left\", start = 70000", "`start`: must be"),
    ("/absent", "[[absent]]\n", "[[absent]]\nwhy = 3\n", ": `why` is not a known key"),
    (
        "/absent/panel",
        "[[absent]]\npanel = 1",
        "[[absent]]\npanel = 9",
        "`absent[0].panel`: absent 0: there is no panel 9",
    ),
    ("/absent/row", "row = 3", "row = 4", "`absent[0].row`: absent 0: it is empty or leaves panel rear"),
    (
        "/absent/column",
        "column = 15",
        "column = 16",
        "`absent[0].column`: absent 0: it is empty or leaves panel rear",
    ),
    (
        "/absent/rows",
        "rows = 1\n",
        "rows = 0\n",
        "`absent[0].rows`: absent 0: it is empty or leaves panel rear",
    ),
    (
        "/absent/columns",
        "rows = 1\ncolumns = 1",
        "rows = 1\ncolumns = 0",
        "`absent[0].columns`: absent 0: it is empty or leaves panel rear",
    ),
];

/// A garment without wiring, with every key.
const GRID: &str = "name = \"mat\"\n\n[grid]\nrows = 12\ncolumns = 21\npitch_um = [5000, 8000]\n";

const GRID_MISTAKES: &[Mistake] = &[
    ("/grid", "\n[grid]", "seams = []\n[grid]", "`seams`: a garment has either wiring and panels, or [grid]"),
    ("/grid/rows", "rows = 12", "rows = 0", "`grid.rows`: "),
    ("/grid/columns", "columns = 21", "columns = -1", "`columns`: must be"),
    ("/grid/pitch_um", "[5000, 8000]", "[5000, 8]", "`grid.pitch_um`: "),
];

fn refused(text: &str) -> String {
    let file = file("garment.toml", text);
    format!("{:#}", check(file.to_str().expect("a name in UTF-8"), None).expect_err("it is refused"))
}

#[test]
fn each_key_of_a_garment_has_a_mistake_that_is_reported_with_its_line() {
    let good = file("good.toml", BASE);
    let said = check(good.to_str().unwrap(), None).unwrap();
    assert!(said.ends_with("garment mine, 128 taxels in 2 panels and 2 blocks: fits."), "{said}");
    each(BASE, MISTAKES, refused);
    each(GRID, GRID_MISTAKES, refused);
    let all = [MISTAKES, GRID_MISTAKES].concat();
    assert_eq!(keys::of(FileKind::Garment.schema()), keys::of_mistakes(&all));
}

#[test]
fn a_taxel_in_no_block_or_in_two_is_reported_with_the_panel_or_the_block() {
    let hole = refused(&BASE.replacen("rows = 4\ncolumns = 16\ninput", "rows = 3\ncolumns = 16\ninput", 1));
    assert!(hole.contains("`panels[0]`: panel front: row 3, column 0 lies in no block"), "{hole}");
    let twice = refused(&BASE.replacen("panel = 1\nrow = 0", "panel = 0\nrow = 0", 1));
    assert!(twice.contains("`blocks[1]`: blocks 0 and 1: they cover the same taxel"), "{twice}");
}

#[test]
fn a_preset_is_checked_by_its_name() {
    let said = check("block-4x16", None).unwrap();
    assert_eq!(said, "block-4x16: garment block-4x16, 64 taxels in 1 panel and 1 block: fits.");
    let why = check("block-4x61", None).unwrap_err().to_string();
    assert!(why.contains("did you mean \"block-4x16\"?"), "{why}");
}

#[test]
fn the_schema_has_the_keys_of_a_garment_and_no_others() {
    let all: Garment = toml::from_str(BASE).unwrap();
    let mut all = serde_json::to_value(&all).unwrap();
    all["grid"] = toml::from_str::<serde_json::Value>(GRID).unwrap()["grid"].take();
    keys::assert_all(&all, FileKind::Garment.schema());
}
