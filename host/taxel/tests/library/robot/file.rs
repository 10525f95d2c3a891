//! Mistakes in a robot's file: each is one sentence with file, line, key and board.

use std::path::Path;
use taxel::robot::ReadRobot;
use taxel::source::SourceSpec;

const GOOD: &str = r#"name = "two"
urdf = "reference"

[[boards]]
name = "torso"
source = "sim:pat"
garment = "reference"
body = "reference"

[[boards]]
name = "arm"
source = "tcp:localhost:4000"
garment = "block-4x16"
link = "left_forearm"
tare = 32
"#;

fn read(text: &str) -> taxel::Result<ReadRobot> {
    ReadRobot::parse("robot.toml".into(), text.into(), Path::new("."))
}

#[test]
fn a_file_is_read_with_what_it_names() {
    let robot = read(GOOD).unwrap();
    assert_eq!((robot.name.as_str(), robot.boards.len(), robot.board("arm")), ("two", 2, Some(1)));
    let [torso, arm] = &robot.boards[..] else { panic!() };
    assert_eq!((&torso.source, torso.is_real()), (&SourceSpec::Sim("pat".into()), false));
    assert_eq!((arm.tare, arm.is_real(), arm.link.as_deref()), (Some(32), true, Some("left_forearm")));
    let taxels = |number: usize| robot.boards[number].garment.as_ref().unwrap().layout.taxels();
    assert_eq!([taxels(0), taxels(1)], [2048, 64]);
}

#[test]
fn paths_are_beside_the_file() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("robot-paths");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("calm.toml"), "rate_hz = 50\n").unwrap();
    std::fs::write(folder.join("touch.toml"), "duration_s = 1\n").unwrap();
    let text =
        "name = \"one\"\n[[boards]]\nname = \"a\"\nsource = \"sim:touch.toml\"\nscene = \"calm.toml\"\n";
    std::fs::write(folder.join("robot.toml"), text).unwrap();
    let robot = ReadRobot::read(&folder.join("robot.toml")).unwrap();
    let touch = folder.join("touch.toml").display().to_string();
    assert_eq!(robot.boards[0].source, SourceSpec::Sim(touch.clone()));
    assert_eq!(robot.boards[0].scene.as_ref().unwrap().scene.rate_hz, 50);
    assert!(robot.inputs.contains(&touch) && robot.inputs.len() == 3, "{:?}", robot.inputs);
}

/// What is changed in the good file, and the sentence.
const MISTAKES: [(&str, &str, &str); 25] = [
    ("name = \"two\"\n", "", "robot.toml, line 1: `name` is missing"),
    ("name = \"two\"", "name = \"\"", "robot.toml, line 1, `name`: the robot has no name"),
    (
        "tare = 32",
        "tare = \"x\"",
        "robot.toml, line 15, `tare`: must be a whole number from 0 to 65535, not \"x\" (board arm)",
    ),
    (
        "tare = 32",
        "tare = 5000",
        "robot.toml, line 15, `boards[1].tare`: board arm: it is 5000, and must be 0 to 4096",
    ),
    (
        "tare = 32",
        "tares = 32",
        "robot.toml, line 15: `tares` is not a known key, did you mean `tare`? Known are `name`, `source`, `garment`, `scene`, `calibration`, `tare`, `budget`, `raw`, `gestures`, `gesture_gain`, `gesture_certainty`, `forms`, `feed`, `shapes`, `body`, `folds`, `pressing`, `link` (board arm)",
    ),
    (
        "source = \"sim:pat\"\n",
        "",
        "robot.toml, line 4, `boards[0].source`: board torso: auto finds any board: name its serial number, usb:SERIAL",
    ),
    (
        "name = \"arm\"",
        "name = \"left arm\"",
        "robot.toml, line 11, `boards[1].name`: a board's name is 1 to 32 letters, digits, _ and -, not \"left arm\"",
    ),
    (
        "name = \"arm\"",
        "name = \"torso\"",
        "robot.toml, line 11, `boards[1].name`: board torso: another board has this name",
    ),
    (
        "sim:pat",
        "sum:pat",
        "robot.toml, line 6, `source`: there is no source \"sum:pat\": did you mean sim:pat? known are auto, usb[:SERIAL], sim[:TOUCHES], serial:PATH[@BAUD], tcp:HOST:PORT, zenoh:ROBOT/BOARD[@FILE], replay:FILE[#BOARD][@SPEED], the path of a port, of a recording (.mcap) or of a robot's file (.toml[#BOARD]), and FORMAT:LINK[,KEY=VALUE...] for another tactile array, of FORMAT numbers, flexitac, vitac, wiresens, anyskin, reskin, eflesh, m0404s, m1616 or a description (.toml) (board torso)",
    ),
    (
        "sim:pat",
        "usb",
        "robot.toml, line 6, `boards[0].source`: board torso: usb finds any board: name its serial number, usb:SERIAL",
    ),
    (
        "sim:pat",
        "tcp:localhost:4000",
        "robot.toml, line 12, `boards[1].source`: board arm: board torso is there, too",
    ),
    (
        "source = \"sim:pat\"",
        "source = \"auto\"",
        "robot.toml, line 6, `boards[0].source`: board torso: auto finds any board: name its serial number, usb:SERIAL",
    ),
    (
        "source = \"sim:pat\"",
        "source = \"replay:a.mcap\"",
        "robot.toml, line 8, `boards[0].body`: board torso: replay:./a.mcap is a recording, whose board does not listen",
    ),
    (
        "tcp:localhost:4000\"",
        "replay:a.mcap\"",
        "robot.toml, line 15, `boards[1].tare`: board arm: replay:./a.mcap is a recording, whose board does not listen",
    ),
    (
        "garment = \"block-4x16\"",
        "garment = \"block-4x61\"",
        "robot.toml, line 13, `boards[1].garment`: board arm: there is no garment \"block-4x61\": did you mean \"block-4x16\"? Known are reference, mat-64x32, block-4x16, or give a .toml file",
    ),
    (
        "garment = \"block-4x16\"",
        "garment = \"no-such.toml\"",
        "robot.toml, line 13, `boards[1].garment`: board arm: cannot read ./no-such.toml: no such file or directory",
    ),
    (
        "tare = 32",
        "scene = \"no-such.toml\"",
        "robot.toml, line 15, `boards[1].scene`: board arm: ./no-such.toml cannot be read: no such file or directory",
    ),
    (
        "urdf = \"reference\"",
        "urdf = \"no-such.urdf\"",
        "robot.toml, line 2, `urdf`: the robot: cannot read ./no-such.urdf: no such file or directory",
    ),
    (
        "urdf = \"reference\"\n",
        "",
        "robot.toml, line 13, `boards[1].link`: board arm: the robot has no `urdf` that has links",
    ),
    (
        "garment = \"reference\"\n",
        "",
        "robot.toml, line 7, `boards[0].body`: board torso: a body is that of a garment: name the board's `garment`, too",
    ),
    (
        "garment = \"reference\"\n",
        "garment = \"mat-64x32\"\n",
        "robot.toml, line 8, `boards[0].body`: board torso: reference, line 6, `patches[0].panel`: must be a panel of the garment: mat",
    ),
    (
        "body = \"reference\"",
        "body = \"refrence\"",
        "robot.toml, line 8, `boards[0].body`: board torso: there is no body \"refrence\": did you mean \"reference\"? Known are reference, or give a .toml file",
    ),
    (
        "body = \"reference\"",
        "body = \"reference\"\nlink = \"torso\"",
        "robot.toml, line 9, `boards[0].link`: board torso: its `body` says on which links its panels lie",
    ),
    (
        "left_forearm",
        "left_forarm",
        "robot.toml, line 14, `boards[1].link`: board arm: reference: there is no link \"left_forarm\": did you mean \"left_forearm\"? Known are base_link, torso, left_shoulder_pitch_link, left_shoulder_roll_link, left_upper_arm, left_forearm, left_hand, right_shoulder_pitch_link, right_shoulder_roll_link, right_upper_arm, right_forearm, right_hand",
    ),
    (
        "tare = 32\n",
        "tare = 32\n\n[[seams]]\nlength = 16\n",
        "robot.toml, line 17: `seams` is not a known key: `name`, `urdf`, `poses`, `motion`, `maps`, `boards`",
    ),
];

#[test]
fn mistakes_are_reported_with_file_line_key_and_board() {
    for (good, bad, want) in MISTAKES {
        assert!(GOOD.contains(good), "{good}");
        let error = read(&GOOD.replacen(good, bad, 1)).err().unwrap_or_else(|| panic!("{bad} is read"));
        let reported = taxel::text::words::sentence(&error);
        assert_eq!(reported, want, "{bad}");
    }
}

#[test]
fn a_script_that_does_not_exist_is_reported_before_anything_is_opened() {
    let error = read(&GOOD.replacen("sim:pat", "sim:pta", 1)).unwrap_err();
    let why = "robot.toml, line 6, `boards[0].source`: board torso: there is no script of touches \"pta\": did you \
               mean \"pat\"?";
    assert!(format!("{error:#}").starts_with(why), "{error:#}");
}
