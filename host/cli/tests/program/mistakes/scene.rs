//! Mistakes in a scene's file.

use super::{Mistake, each, file, keys};
use taxel_cli::commands::garment::config::{FileKind, check};

/// A scene with every key except for an inline map, which `taxel fcm check` checks.
const BASE: &str = r#"name = "calm"
rate_hz = 50
joints = ["left_elbow", "right_elbow"]

[plan]
panels = 255
blocks = 4294967295
depth = "12"

[condition]
floor = 14
filter = "conservative"
track_baseline = true

[contact]
low = 16
high = 40
min_area = 1
gate = 4
smoothing_ms = 40
slip_speed = 64
forms_in_frame = 1

[shape]
k = 1
reject = 400

[gestures]
model = "intent"
rate_hz = 54
gain = 256
quiet_ms = 1000
decide_ms = 250
onset_ms = 250
lead = 200
certainty = 700

[symbol]
strength = [1000, 5000, 20000]
extent = [9, 40]
span_ms = [150, 800]

[intent]
map = "tactile"
onset_ms = 30
level = 500
margin = 100
hold_ms = 600
period_ms = 20
steps = 16

[[friendliness]]
region = "back"
percent = 60

[[react]]
name = "press"
cause = "pressure"
level = 3600
region = "back"
hysteresis = 400
hold_ms = 100
output = { pin = 18, inverted = false }

[[react]]
name = "angry"
cause = { concept = "anger" }
level = 9000

[[react]]
name = "flinch"
cause = { leading = "attack" }
level = 1

[stream]
frames_hz = 65535
contacts_hz = 20
symbols = true
intent = true
pressing_hz = 20
form_ages = false
key_ms = 1000
"#;

const MISTAKES: &[Mistake] = &[
    ("/name", "\"calm\"", "\"calm and more than that\"", "`name`: must be a text of at most 16 bytes"),
    ("/rate_hz", "rate_hz = 50", "rate_hz = 70000", "`rate_hz`: must be"),
    ("/joints", "\"right_elbow\"", "\"left_elbow\"", "`joints[1]`: joints[1] must not be given twice"),
    ("/joints", "\"right_elbow\"", "\"\"", "`joints[1]`: joints[1] must not be empty"),
    ("/plan", "[plan]\n", "[plan]\nspeed = 1\n", "`plan.speed`: "),
    ("/plan/panels", "panels = 255", "panels = 256", "`plan.panels`: must be"),
    ("/plan/blocks", "blocks = 4294967295", "blocks = -1", "`plan.blocks`: must be"),
    (
        "/plan/panels",
        "panels = 255",
        "panels = 240",
        "`plan.panels`: plan.panels must leave a block of the garment to be read",
    ),
    (
        "/plan/blocks",
        "blocks = 4294967295",
        "blocks = 0",
        "`plan.blocks`: plan.blocks must leave a block of the garment to be read",
    ),
    (
        "/react/name",
        "name = \"flinch\"",
        "name = \"press\"",
        "`react[2].name`: react[2].name must not be given twice",
    ),
    ("/plan/depth", "depth = \"12\"", "depth = 12", "`plan.depth`: "),
    ("/condition", "[condition]\n", "[condition]\nfloors = 1\n", "`condition.floors`: "),
    ("/condition/floor", "floor = 14", "floor = 0", "`condition.floor`: condition.floor must be"),
    ("/condition/filter", "\"conservative\"", "\"mean\"", "`condition.filter`: "),
    (
        "/condition/track_baseline",
        "track_baseline = true",
        "track_baseline = 1",
        "`condition.track_baseline`: must be",
    ),
    ("/contact", "[contact]\n", "[contact]\nmiddle = 1\n", "`contact.middle`: "),
    ("/contact/low", "low = 16", "low = 0", "`contact.low`: contact.low must be"),
    ("/contact/high", "high = 40", "high = 8", "`contact.high`: contact.high must"),
    ("/contact/min_area", "min_area = 1", "min_area = 1.5", "`contact.min_area`: must be"),
    ("/contact/gate", "gate = 4", "gate = 0", "`contact.gate`: contact.gate must be"),
    ("/contact/smoothing_ms", "smoothing_ms = 40", "smoothing_ms = -40", "`contact.smoothing_ms`: must be"),
    ("/contact/slip_speed", "slip_speed = 64", "slip_speed = \"fast\"", "`contact.slip_speed`: must be"),
    ("/shape", "[shape]\n", "[shape]\nbase = 1\n", "`shape.base`: "),
    ("/shape/k", "k = 1", "k = 0", "`shape.k`: shape.k must be"),
    ("/shape/reject", "reject = 400", "reject = 0", "`shape.reject`: shape.reject must be"),
    ("/symbol", "[symbol]\n", "[symbol]\nspan = 1\n", "`symbol.span`: "),
    ("/symbol/strength", "[1000, 5000", "[5000, 1000", "`symbol.strength`: symbol.strength must rise"),
    ("/symbol/extent", "[9, 40]", "[9]", "`symbol.extent`: "),
    ("/symbol/span_ms", "[150, 800]", "[150, 150]", "`symbol.span_ms`: symbol.span_ms must rise"),
    ("/intent", "[intent]\n", "[intent]\nmaps = 1\n", "`intent.maps`: "),
    ("/intent/map", "\"tactile\"", "\"tactil\"", "`intent.map`: "),
    ("/intent/onset_ms", "onset_ms = 30", "onset_ms = 1e9", "`intent.onset_ms`: must be"),
    (
        "/intent/level",
        "level = 500",
        "level = 1001",
        "`intent.level`: intent.map: level = 1001 thousandths is above 1",
    ),
    (
        "/intent/margin",
        "margin = 100",
        "margin = 2000",
        "`intent.margin`: intent.map: margin = 2000 thousandths is above 1",
    ),
    ("/intent/hold_ms", "hold_ms = 600", "hold_ms = 66000", "`intent.hold_ms`: must be"),
    ("/intent/period_ms", "period_ms = 20", "period_ms = []", "`intent.period_ms`: must be"),
    ("/intent/steps", "steps = 16", "steps = 0", "`intent.steps`: intent.map: steps = 0"),
    ("/friendliness", "[[friendliness]]\n", "[[friendliness]]\nlink = 1\n", "`friendliness[0].link`: "),
    (
        "/friendliness/region",
        "region = \"back\"\npercent",
        "region = \"tail\"\npercent",
        "`friendliness[0].region`: friendliness[0].region must be a region of the garment",
    ),
    (
        "/friendliness/percent",
        "percent = 60",
        "percent = 101",
        "`friendliness[0].percent`: friendliness[0].percent must be -100 to 100",
    ),
    ("/react", "name = \"press\"\n", "name = \"press\"\nspeed = 1\n", "`react[0].speed`: "),
    (
        "/react/name",
        "\"press\"",
        "\"press as hard as can be\"",
        "`react[0].name`: must be a text of at most 16 bytes",
    ),
    ("/react/cause", "cause = \"pressure\"", "cause = \"noise\"", "`react[0].cause`: "),
    (
        "/react/cause/concept",
        "concept = \"anger\"",
        "concept = \"angst\"",
        "`react[1].cause.concept`: react[1].cause.concept must be a concept of the map",
    ),
    ("/react/cause/reflex", "cause = \"pressure\"", "cause = { reflex = \"three\" }", "`react[0].cause"),
    ("/react/cause/leading", "leading = \"attack\"", "leading = \"attacks\"", "`react[2].cause"),
    ("/react/level", "level = 3600", "level = 3600.5", "`react[0].level`: must be"),
    (
        "/react/region",
        "3600\nregion = \"back\"",
        "3600\nregion = \"bakc\"",
        "`react[0].region`: react[0].region must be a region of the garment, or empty",
    ),
    (
        "/react/hysteresis",
        "hysteresis = 400",
        "hysteresis = 4000",
        "`react[0].hysteresis`: react[0].hysteresis must be 0 to level",
    ),
    ("/react/hold_ms", "hold_ms = 100", "hold_ms = -100", "`react[0].hold_ms`: must be"),
    ("/react/output", "output = { pin = 18, inverted = false }", "output = 18", "`react[0].output`: must be"),
    (
        "/react/output/pin",
        "pin = 18",
        "pin = 9",
        "`react[0].output.pin`: react[0].output.pin must not be a select line of the garment",
    ),
    (
        "/react/output/pin",
        "pin = 18",
        "pin = 1",
        "`react[0].output.pin`: react[0].output.pin must be a free output of this board",
    ),
    ("/react/output/inverted", "inverted = false", "inverted = 0", "`react[0].output.inverted`: must be"),
    ("/stream", "[stream]\n", "[stream]\nhz = 1\n", "`stream.hz`: "),
    ("/stream/frames_hz", "frames_hz = 65535", "frames_hz = 65536", "`stream.frames_hz`: must be"),
    (
        "/stream/contacts_hz",
        "contacts_hz = 20",
        "contacts_hz = 1000",
        "`stream.contacts_hz`: stream.contacts_hz must be lower",
    ),
    ("/stream/symbols", "symbols = true", "symbols = 1", "`stream.symbols`: must be"),
    ("/stream/intent", "intent = true", "intent = \"yes\"", "`stream.intent`: must be"),
    ("/stream/pressing_hz", "pressing_hz = 20", "pressing_hz = true", "`stream.pressing_hz`: must be"),
    ("/stream/form_ages", "form_ages = false", "form_ages = 0", "`stream.form_ages`: must be"),
    ("/gestures", "[gestures]\n", "[gestures]\nfloor = 1\n", "`gestures.floor`: "),
    ("/gestures/model", "model = \"intent\"", "model = \"joy\"", "`gestures.model`: "),
    (
        "/gestures/rate_hz",
        "rate_hz = 54",
        "rate_hz = 0",
        "`gestures.rate_hz`: gestures.rate_hz must be 1 to 200",
    ),
    ("/gestures/gain", "gain = 256", "gain = 0", "`gestures.gain`: gestures.gain must be 1 to 4096"),
    ("/gestures/quiet_ms", "quiet_ms = 1000", "quiet_ms = -1", "`gestures.quiet_ms`: must be"),
    (
        "/gestures/decide_ms",
        "decide_ms = 250",
        "decide_ms = 49",
        "`gestures.decide_ms`: gestures.decide_ms must be",
    ),
    ("/gestures/onset_ms", "onset_ms = 250", "onset_ms = 1.5", "`gestures.onset_ms`: must be"),
    ("/gestures/lead", "lead = 200", "lead = \"far\"", "`gestures.lead`: must be"),
    (
        "/gestures/certainty",
        "certainty = 700",
        "certainty = 1000",
        "`gestures.certainty`: gestures.certainty must be at most 999",
    ),
    (
        "/contact/forms_in_frame",
        "forms_in_frame = 1",
        "forms_in_frame = 256",
        "`contact.forms_in_frame`: must be",
    ),
    ("/stream/key_ms", "key_ms = 1000", "key_ms = 1001", "`stream.key_ms`: stream.key_ms must be 1 to 1000"),
];

fn checked(garment: &str, text: &str) -> anyhow::Result<String> {
    check(garment, Some(&file("scene.toml", text)))
}

#[test]
fn each_key_of_a_scene_has_a_mistake_that_is_reported_with_its_line() {
    let said = checked("reference", BASE).unwrap();
    assert!(said.ends_with("fits; scene calm can be played on it."), "{said}");
    each(BASE, MISTAKES, |text| format!("{:#}", checked("reference", text).expect_err("it is refused")));
    // Inline maps are checked by `taxel fcm check`.
    let schema: Vec<String> = keys::of(FileKind::Scene.schema());
    assert_eq!(schema, keys::of_mistakes(MISTAKES));
}

#[test]
fn a_frame_that_is_too_slow_is_reported_in_the_file_that_makes_it_so() {
    let garment = |settle_ns: &str| {
        let text = include_str!("../../../../taxel/garments/reference.toml").replacen(
            "settle_ns = 3000 ",
            settle_ns,
            1,
        );
        file(&format!("{}.toml", settle_ns.len()), &text).display().to_string()
    };
    let (quick, slow) = (garment("settle_ns = 200000 "), garment("settle_ns = 1000000 "));
    let mean = BASE.replacen("\"12\"", "\"mean of 8\"", 1);
    let why =
        |garment: &str, scene: &str| format!("{:#}", checked(garment, scene).expect_err("it is refused"));
    checked(&quick, BASE).unwrap();
    let scene = why(&quick, &mean);
    assert!(scene.contains("scene.toml, line 8, `plan.depth`: a frame takes 854 ms, at most 500"), "{scene}");
    let garment = why(&slow, BASE);
    assert!(garment.contains("`wiring.settle_ns`: a frame takes 526 ms, at most 500"), "{garment}");
}

#[test]
fn the_scene_that_ships_may_be_used_for_a_garment_without_its_regions() {
    let scene = BASE.replace("region = \"back\"\nhys", "region = \"mat\"\nhys");
    checked("block-4x16", &scene).unwrap();
}
