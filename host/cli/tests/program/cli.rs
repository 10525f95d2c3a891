//! The program from outside: results on the reference images, and one sentence and an exit status for bad
//! input.

use crate::reference;
use crate::start::taxel;
use npyz::WriterBuilder;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Path of this test's file in the build folder.
fn file(name: &str, bytes: &[u8]) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    path.to_str().unwrap().into()
}

fn npy<T: npyz::AutoSerialize + Copy>(shape: &[u64], values: &[T]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer =
        npyz::WriteOptions::new().default_dtype().shape(shape).writer(&mut bytes).begin_nd().unwrap();
    writer.extend(values.iter().copied()).unwrap();
    writer.finish().unwrap();
    bytes
}

/// An archive of two images named `a` and `b`.
fn two_images() -> Vec<u8> {
    let mut cursor = std::io::Cursor::new(Vec::new());
    let mut writer = npyz::npz::NpzWriter::new(&mut cursor);
    for name in ["a", "b"] {
        let array = writer.array(name, Default::default()).unwrap();
        let mut array = array.default_dtype().shape(&[2, 3]).begin_nd().unwrap();
        array.extend([1u16, 2, 3, 4, 5, 6]).unwrap();
        array.finish().unwrap();
    }
    drop(writer);
    cursor.into_inner()
}

fn run(args: &[&str]) -> Output {
    Command::new(taxel()).args(args).stdin(Stdio::null()).output().unwrap()
}

fn answer(args: &[&str]) -> String {
    let output = run(args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn json(args: &[&str]) -> Value {
    serde_json::from_str(&answer(args)).unwrap()
}

/// Checks bad input: this exit status, nothing on stdout, one line on stderr with each of `words`.
fn refused(status: i32, args: &[&str], words: &[&str]) {
    let output = run(args);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{args:?}: {error}");
    assert!(output.stdout.is_empty(), "{args:?}");
    assert!(error.starts_with("error: ") && error.lines().count() == 1, "{args:?}: {error}");
    for word in words {
        assert!(error.contains(word), "{args:?}: {word} is not in: {error}");
    }
}

#[test]
fn bad_arrays_are_refused_by_name() {
    let whole = npy(&[2, 3], &[1u16, 2, 3, 4, 5, 6]);
    let cut = file("cut.npy", &whole[..whole.len() - 3]);
    let flat = file("flat.npy", &npy(&[6], &[1u16; 6]));
    let nan = file("nan.npy", &npy(&[2, 2, 2], &[0.0, 1.0, 2.0, 3.0, 4.0, f64::NAN, 6.0, 7.0]));
    let half = file("half.csv", b"1,2\n3,4.5\n");
    let text = file("text.npy", b"not an array");
    let missing = text.replace("text.npy", "missing.npy");
    for command in ["features", "process"] {
        refused(1, &[command, &cut], &["cut.npy", "truncated", "12 bytes", "9"]);
        refused(1, &[command, &flat], &["flat.npy", "[6]", "[frames, rows, columns]"]);
        refused(1, &[command, &nan], &["nan.npy", "frame 1, row 0, column 1", "NaN"]);
        refused(1, &[command, &half], &["half.csv", "line 2", "row 1, column 1", "4.5"]);
        refused(1, &[command, &text, "--json"], &["text.npy", "not a NumPy array"]);
        refused(1, &[command, &missing], &["missing.npy", "cannot be read"]);
    }
}

/// Standard error and standard output of a command.
fn said(args: &[&str]) -> (String, String) {
    let output = run(args);
    let [error, text] =
        [&output.stderr, &output.stdout].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    assert!(output.status.success(), "{args:?}: {error}");
    (error, text)
}

#[test]
fn what_speaks_against_recorded_frames_is_told() {
    let frames = |value: &dyn Fn(usize, usize) -> u16| -> Vec<u16> {
        (0..20 * 64).map(|i| value(i / 64, i % 64)).collect()
    };
    let quiet = frames(&|frame, cell| (frame * 37 + cell * 11) as u16 % 600);
    let started =
        frames(&|frame, cell| if frame == 1 { 4000 } else { (frame * 37 + cell * 11) as u16 % 600 });
    let stopped = frames(&|frame, cell| ((frame * 379 + cell * 113) as u16 % 2000).min(1500));
    let soft = frames(&|frame, cell| (frame * 37 + cell * 11) as u16 % 60);
    let process = |name: &str, values: &[u16]| said(&["process", &file(name, &npy(&[20, 8, 8], values))]).0;
    assert!(!process("quiet.npy", &quiet).contains("warning"));
    assert!(process("started.npy", &started).contains("started.npy: frame 1 has "));
    assert!(process("stopped.npy", &stopped).contains("saturation: values stop at 1500"));
    assert!(process("soft.npy", &soft).contains("no value is above 59 of a full scale of 4095"));

    // Two gestures by three people, eight times each, which all saturate; the first recording begins with a
    // transient.
    let two = started.iter().chain(&stopped).map(|value| (*value).min(500));
    let mut all = two.collect::<Vec<u16>>().repeat(24);
    all[..64 * 20].iter_mut().for_each(|value| *value /= 50);
    all[64..128].fill(500);
    let frames = file("touches.npy", &npy(&[48 * 20, 8, 8], &all));
    let labels: String =
        (0..48).map(|n| format!("{},{}\n", ["pat", "rub"][n % 2], ["ann", "bob", "cid"][n / 16])).collect();
    let labels = file("touches.csv", format!("gesture,participant\n{labels}").as_bytes());
    let cross = ["--cross", "participant", "--json"];
    let files = ["--frames", frames.as_str(), "--labels", labels.as_str()];
    let (error, text) = said(&[&["gestures", "eval"][..], &files, &cross].concat());
    assert!(error.contains("warning: 1 of 48 recordings, recording 0: frame 1 has "), "{error}");
    assert!(
        error.contains("warning: saturation: values stop at 500 in 100 % of pat, 100 % of rub"),
        "{error}"
    );
    let report: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(report["doubts"].as_array().map(Vec::len), Some(2));
    assert!(report["reliability"]["predictions"].as_u64() > Some(0), "{report}");
}

#[test]
fn what_is_not_in_a_file_is_refused_by_name() {
    let two = file("two.npz", &two_images());
    refused(2, &["features", &two, "--array", "c"], &["two.npz", "no array c", "a, b"]);
    refused(2, &["process", &two, "--array", "c"], &["two.npz", "no array c", "a, b"]);
    refused(2, &["features", &two], &["two.npz", "--array", "a, b"]);
    refused(
        2,
        &["features", &two, "--array", "a", "--frame", "1"],
        &["two.npz", "no frame 1", "the last is 0"],
    );
    assert_eq!(json(&["features", &two, "--array", "b", "--json"])["m"], 21);
}

#[test]
fn bad_maps_are_refused_by_name() {
    let map = |name: &str, text: &str| file(name, text.as_bytes());
    let heavy = map("heavy.json", r#"{"names": ["a", "b"], "W": [[0, 2], [0, 0]], "x0": [1, 0]}"#);
    refused(1, &["fcm", &heavy, "--json"], &["heavy.json", "W[a][b] = 2", "[-1, 1]"]);
    let nan = map("nan.json", r#"{"names": ["a"], "W": [[NaN]], "x0": [1]}"#);
    refused(1, &["fcm", &nan], &["nan.json", "NaN"]);
    let short = map("short.json", r#"{"names": ["a", "b"], "W": [[0, 1], [0, 0]]}"#);
    refused(1, &["fcm", &short], &["short.json", "x0 is missing"]);
    refused(1, &["fcm", "/no/such/map.json"], &["/no/such/map.json", "cannot be read"]);
}

/// From the shipped map to a combined, a merged, a trained and a drawn one, and back to results.
#[test]
fn maps_are_made_of_maps() {
    let at = |name: &str| file(name, b"");
    let (ours, both, taught, drawn) = (at("ours.toml"), at("both.toml"), at("taught.toml"), at("map.svg"));
    let combined = json(&["fcm", "combine", "tactile", "tactile", "--force", "-o", &ours, "--json"]);
    assert_eq!(
        (combined["map"].as_str(), combined["edges"].as_array().map(Vec::len)),
        (Some("ours"), Some(36))
    );
    let merged = json(&["fcm", "merge", &ours, "shape", "--force", "-o", &both, "--json"]);
    assert_eq!(merged["concepts"].as_array().map(Vec::len), Some(26));
    assert!(merged["conflicts"][0].as_str().is_some_and(|said| said.contains(" of shape")), "{merged}");
    let checked = json(&["fcm", "check", &both, "--json"]);
    assert_eq!((checked["faults"].as_array().map(Vec::len), checked["cycles"].as_u64()), (Some(0), Some(0)));
    let why = json(&[
        "fcm",
        "why",
        &both,
        "--input",
        "blow=0.9",
        "--input",
        "shape=0.9",
        "--set",
        "blow=-0.9",
        "--json",
    ]);
    let units = |list: &str| {
        why[list].as_array().unwrap().iter().map(|one| one["units"].as_i64().unwrap()).sum::<i64>()
    };
    assert_eq!(
        (why["concept"].as_str(), units("parts"), units("paths")),
        (Some("attack"), units("paths"), why["sum_units"].as_i64().unwrap())
    );
    let attack = |value: &Value| value["activations"]["attack"].as_f64().unwrap();
    assert!(attack(&why) > 0.9 && attack(&why["what_if"]) < 0.5, "{why}");
    let touches =
        file("blows.csv", b"blow,location,label\n0.9,0.1,attack\n0.1,0.9,none\n0.8,0,attack\n0,0,none\n");
    let learned = json(&[
        "fcm",
        "learn",
        "tactile",
        "--touches",
        &touches,
        "--force",
        "-o",
        &taught,
        "--folds",
        "2",
        "--json",
    ]);
    assert_eq!((learned["touches"].as_u64(), learned["after"]["accuracy"].as_f64()), (Some(4), Some(1.0)));
    answer(&["fcm", "draw", &taught, "--force", "-o", &drawn, "--input", "press=0.5"]);
    assert!(std::fs::read_to_string(&drawn).unwrap().ends_with("</svg>\n"));
    let run = json(&["fcm", &taught, "--input", "shape=1", "--json"]);
    assert_eq!(run["f64"]["outcome"], "fixed");
    let broken = file("broken.toml", b"name = \"m\"\n[[concept]]\nname = 3\n");
    for command in [
        &["fcm", "check", &broken][..],
        &["fcm", &broken],
        &["fcm", "why", &broken],
        &["fcm", "draw", &broken, "--force", "-o", &drawn],
    ] {
        refused(1, command, &["broken.toml, line 3"]);
    }
    refused(
        1,
        &["fcm", "new", "--force", "-o", &at("new.toml")],
        &["line 1: the answers end before the map is complete"],
    );
    refused(
        1,
        &["fcm", "learn", "tactile", "--touches", "/no/such.csv", "--force", "-o", &taught],
        &["/no/such.csv", "cannot be read"],
    );
}

#[test]
fn bad_garments_are_refused_by_name() {
    let image = file("garment.npy", &npy(&[2, 3], &[1u16, 2, 3, 4, 5, 6]));
    let garment = file("extra.toml", b"name = \"x\"\nextra = 3\n");
    refused(
        1,
        &["process", &image, "--layout", &garment],
        &["extra.toml, line 2", "`extra` is not a known key"],
    );
    refused(2, &["process", &image, "--layout", "nothing"], &["no garment", "nothing", "mat-64x32"]);
    refused(1, &["process", &image, "--layout", "mat-64x32"], &["garment.npy", "2 x 3", "mat-64x32"]);
}

#[test]
fn bad_sources_are_refused_by_name() {
    let scene = file("colour.toml", b"duration_s = 1\ncolour = 3\n");
    refused(
        1,
        &["live", "--source", &format!("sim:{scene}")],
        &["colour.toml, line 2", "`colour` is not a known key"],
    );
    refused(2, &["live", "--source", "sim:nothing"], &["no script of touches", "nothing", "pat"]);
    refused(3, &["live", "--source", "serial:/dev/no-such-port"], &["/dev/no-such-port"]);
    refused(3, &["live", "--source", "tcp:127.0.0.1:1"], &["127.0.0.1:1"]);
    refused(1, &["live", "--source", "file:/no/such/bytes"], &["/no/such/bytes"]);
    let garbage = file("garbage.bin", &[0x5a; 4000]);
    refused(1, &["live", "--source", &format!("file:{garbage}"), "--json"], &["garbage.bin", "no Hello"]);
}

/// An unreadable argument has the same status; clap adds how to get help.
#[test]
fn bad_arguments_have_the_same_status() {
    for args in
        [&["features"][..], &["features", "x.npy", "--frame", "-1"], &["nothing"], &["fcm", "x", "--no"]]
    {
        let output = run(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(String::from_utf8_lossy(&output.stderr).starts_with("error: "), "{args:?}");
    }
}

/// Some pixels are in the reference itself; the others are with the recordings.
#[test]
fn features_are_those_of_the_reference() {
    let cases = reference::cases();
    let whole =
        cases.iter().enumerate().filter_map(|(index, case)| Some((index, case, case["img"].as_array()?)));
    let mut compared = 0;
    for (index, case, image) in whole {
        let image: Vec<u16> = image.iter().map(|v| v.as_u64().unwrap() as u16).collect();
        let shape = [&case["shape"][0], &case["shape"][1]].map(|v| v.as_u64().unwrap());
        let image = file(&format!("reference-{index}.npy"), &npy(&shape, &image));
        reference::check(&reference::features(&[&image]), case);
        compared += 1;
    }
    assert!(compared >= 8);
}

#[test]
fn scenes_are_listed() {
    let scenes = json(&["scenes", "--json"]);
    let names: Vec<&str> = scenes.as_array().unwrap().iter().map(|s| s["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"pat") && names.contains(&"lash"));
    let table = answer(&["scenes"]);
    assert_eq!(table.lines().count(), names.len());
    assert!(names.iter().zip(table.lines()).all(|(name, line)| line.starts_with(name)));
}

#[test]
fn a_body_is_checked_and_every_taxel_placed() {
    let table = answer(&["body", "check", "reference"]);
    let arm = "left arm   on left_upper_arm    512 taxels, neighbours at 0.995 to 1.000 of their pitch\n";
    assert!(table.lines().count() == 4 && table.contains(arm), "{table}");
    let panels = json(&["body", "check", "reference", "--json"]);
    assert_eq!((&panels[0]["panel"], &panels[0]["link"]), (&"chest".into(), &"torso".into()));
    let places = answer(&["body", "places", "reference", "-o", "-"]);
    assert!(places.starts_with("taxel,link,x,y,z,nx,ny,nz\n0,torso,"), "{}", &places[..80]);
    assert_eq!(places.lines().count(), 2049);
    // Each taxel faces one of front and back; those of the sides of the arms face the left, too.
    let picture = answer(&["body", "show", "reference", "-o", "-"]);
    let circles = picture.matches("<circle").count();
    assert!(
        picture.contains(">torso from the left</text>") && (2048..=3 * 2048).contains(&circles),
        "{circles}"
    );
    // What a command reads it never overwrites: not a list that the body names, either.
    let list = file("list.txt", "0 0 0.1 0 0 1\n".repeat(2048).as_bytes());
    let worn = file("list.toml", format!("[[patches]]\npanel = \"mat\"\non.taxels = {list:?}\n").as_bytes());
    let holed = "0 0 0 0 0 0\n".to_string() + &"0 0 0.1 0 0 1\n".repeat(2047);
    let holed = file("holed.txt", holed.as_bytes());
    let holed =
        file("holed.toml", format!("[[patches]]\npanel = \"mat\"\non.taxels = {holed:?}\n").as_bytes());
    let table = answer(&["body", "check", &holed, "--garment", "mat-64x32"]);
    assert!(
        table.starts_with("mat  on base  2047 taxels, without a place: taxel 0, neighbours at"),
        "{table}"
    );
    let over = run(&["body", "places", &worn, "--garment", "mat-64x32", "-o", &list, "--force"]);
    assert!(!over.status.success() && std::fs::read(&list).unwrap().len() == 14 * 2048);
    let told = answer(&["live", "--source", "sim:pat", "--body", "reference", "--frames", "120", "--json"]);
    let pressing = told.lines().filter(|line| line.starts_with("{\"type\":\"pressing\"")).collect::<Vec<_>>();
    assert!(pressing.len() > 10 && pressing[0].contains("\"link\":\"torso\""), "{pressing:?}");
    let other = run(&["body", "check", "reference", "--garment", "mat-64x32"]);
    let told = String::from_utf8(other.stderr).unwrap();
    let what = "reference, line 6, `patches[0].panel`: must be a panel of the garment: mat";
    // Regions are listed, and marked in the picture.
    let text = include_str!("../../../taxel/bodies/reference.toml").to_string()
        + "[[regions]]\nname = \"heart & lung\"\nlink = \"torso\"\nwithin.box = { from = [0, 0, 0.2], to = [0.1, 0.012, 0.22] }\n";
    let regions = file("regions.toml", text.as_bytes());
    let table = answer(&["body", "check", &regions]);
    assert!(table.ends_with("\nregion heart & lung, on torso: 2 taxels, 2.4 cm2: 232, 248\n"), "{table}");
    let listed = json(&["body", "check", &regions, "--json"]);
    assert_eq!(
        (&listed[4]["region"], &listed[4]["taxels"]),
        (&"heart & lung".into(), &serde_json::json!([232, 248]))
    );
    let picture = answer(&["body", "show", &regions, "-o", "-"]);
    assert!(picture.contains(">heart &amp; lung</text>"));
    // They face the front and, a little to its left, the left.
    assert_eq!(picture.matches(" stroke=\"#000\"").count(), 4);
    assert!(!other.status.success() && told.contains(what), "{told}");
}

#[test]
fn a_body_is_put_on_a_robot_in_a_posture() {
    let robot = ["--robot", "reference"];
    let table = answer(&[&["body", "check", "reference"][..], &robot].concat());
    let last = "robot reference: 12 links, base base_link; 11 joints, 9 with a position of their own\n";
    assert!(table.lines().count() == 5 && table.ends_with(last), "{table}");
    let places = |more: &[&str]| {
        let table = answer(&[&["body", "places", "reference", "-o", "-"][..], &robot, more].concat());
        let line = table.lines().nth(1).unwrap().to_string();
        let numbers =
            line.split(',').skip(2).map(|number| number.parse::<f64>().unwrap()).collect::<Vec<_>>();
        let count = table.lines().count();
        assert!(line.starts_with("0,torso,") && count == 2049, "{count} {line}");
        <[f64; 6]>::try_from(numbers).unwrap()
    };
    // At rest the frames of torso and base are the same; a quarter less turns x and y.
    let [x, y, z, nx, ny, nz] = places(&["--frame", "torso", "--joints", "waist=-60deg"]);
    assert_eq!(places(&[]), [x, y, z, nx, ny, nz]);
    let turned = places(&["--joints", "waist=-60deg,left_elbow=1rad"]);
    let (sin, cos) = (-60f64).to_radians().sin_cos();
    let exact = [x * cos - y * sin, x * sin + y * cos, z, nx * cos - ny * sin, nx * sin + ny * cos, nz];
    assert!(turned.iter().zip(exact).all(|(a, b)| (a - b).abs() < 2e-6), "{turned:?} {exact:?}");
    let picture = answer(&[&["body", "show", "reference", "-o", "-"][..], &robot].concat());
    assert!(picture.contains(">in the frame of base_link from the left</text>"));

    let said = |args: &[&str]| {
        let other = run(&[&["body", "places", "reference", "-o", "-"][..], args].concat());
        (other.status.code().unwrap(), String::from_utf8(other.stderr).unwrap())
    };
    for (args, status, what) in [
        (&["--joints", "waist=1deg"][..], 2, "--robot"),
        (&["--robot", "reference", "--joints", "waist=1"], 2, "waist=1: write JOINT=30deg"),
        (
            &["--robot", "reference", "--joints", "waist=90deg"],
            2,
            "joint \"waist\": 90\u{b0} is out of its range",
        ),
        (&["--robot", "reference", "--joints", "neck=9deg"], 2, "reference: there is no joint \"neck\""),
        (&["--robot", "reference", "--frame", "head"], 2, "reference: there is no link \"head\""),
        (&["--robot", "none"], 2, "there is no robot \"none\""),
    ] {
        let (code, told) = said(args);
        assert!(code == status && told.contains(what), "{code}: {told}");
    }
    // A robot that is read is never overwritten.
    let trunk = b"<robot><link name=\"trunk\"/></robot>";
    let urdf = file("robot.urdf", trunk);
    let over = run(&["body", "places", "reference", "--robot", &urdf, "-o", &urdf, "--force"]);
    assert!(!over.status.success() && std::fs::read(&urdf).unwrap() == trunk);
    let (code, told) = said(&["--robot", &urdf]);
    let what = format!("reference, line 6, `patches[0].panel`: {urdf}: there is no link \"torso\"");
    assert!(code == 1 && told.contains(&what), "{told}");
}

#[test]
fn a_panel_is_draped_over_a_mesh_and_worn() {
    // A board of 30 cm by 50 cm, in millimetres, as the front of a robot.
    let mesh = file("board.obj", b"v 50 -150 0\nv 50 150 0\nv 50 150 500\nv 50 -150 500\nf 1 2 3 4\n");
    let over =
        ["body", "drape", &mesh, "--scale", "0.001", "--panel", "chest", "--at", "0.06,0,0.25", "-o", "-"];
    let list = answer(&over);
    assert!(list.lines().count() == 513 && list.starts_with("# chest over "), "{}", &list[..99]);
    let list = file("chest.txt", list.as_bytes());
    let body =
        file("chest.toml", format!("[[patches]]\npanel = \"chest\"\non.taxels = {list:?}\n").as_bytes());
    let panels = json(&["body", "check", &body, "--json"]);
    let pitch: Vec<f64> =
        panels[0]["pitch"].as_array().unwrap().iter().map(|n| n.as_f64().unwrap()).collect();
    assert!(pitch[0] > 0.999 && pitch[1] < 1.001, "{pitch:?}");
    let places = answer(&["body", "places", &body, "-o", "-"]);
    // Seen from the front, columns run to the robot's left, rows down.
    assert_eq!(places.lines().nth(1), Some("0,torso,0.050000,-0.090000,0.405000,1.000000,0.000000,0.000000"));
    let said = |args: &[&str]| String::from_utf8(run(args).stderr).unwrap();
    let larger = said(&[&over[..3], &["--scale", "0.0003"], &over[5..]].concat());
    assert!(
        larger.contains("board.obj, panel chest: ") && larger.contains("has no place on the mesh"),
        "{larger}"
    );
    let unknown = said(&["body", "drape", &mesh, "--panel", "chst", "--at", "0,0,0", "-o", "-"]);
    assert!(unknown.contains("there is no panel \"chst\": did you mean \"chest\"?"), "{unknown}");
    let named = "<robot>\n<link name=\"torso\">\n<visual><origin xyz=\"0.01 0 0\"/><geometry><mesh filename=\"package://worn/board.obj\" \
         scale=\"0.001 0.001 0.001\"/></geometry></visual>\n</link>\n</robot>\n";
    let urdf = file("board.urdf", named.as_bytes());
    let folder = Path::new(&mesh).parent().unwrap().to_str().unwrap();
    let on = [
        "body",
        "drape",
        "--robot",
        &urdf,
        "--link",
        "torso",
        "--panel",
        "chest",
        "--at",
        "0.06,0,0.25",
        "-o",
        "-",
    ];
    let package = ["--package", &format!("worn={folder}")];
    let listed = answer(&[&on[..], &package].concat());
    // As over the mesh itself, 1 cm farther to the front.
    let first = |list: &str| list.lines().nth(1).unwrap().to_string();
    let list = std::fs::read_to_string(&list).unwrap();
    assert_eq!(first(&listed), first(&list).replace("0.050000", "0.060000"));
    let lost = said(&on);
    let what =
        format!("{urdf}, line 3, link \"torso\": mesh package://worn/board.obj: no folder above the file");
    assert!(lost.contains(&what), "{lost}");
    for (args, what) in [
        (&["body", "drape", "--robot", &urdf, "--panel", "chest", "--at", "0,0,0", "-o", "-"][..], "--link"),
        (
            &[
                "body", "drape", &mesh, "--robot", &urdf, "--link", "torso", "--panel", "chest", "--at",
                "0,0,0", "-o", "-",
            ],
            "cannot be used with",
        ),
        (&["body", "drape", "--panel", "chest", "--at", "0,0,0", "-o", "-"], "MESH"),
        (
            &["body", "drape", &mesh, "--scale", "0", "--panel", "chest", "--at", "0,0,0", "-o", "-"],
            "--scale must be above 0",
        ),
    ] {
        let done = run(args);
        let told = String::from_utf8(done.stderr).unwrap();
        assert!(done.status.code() == Some(2) && told.contains(what), "{told}");
    }
    // Neither the robot nor its mesh is ever written.
    for input in [&urdf, &mesh] {
        let before = std::fs::read(input).unwrap();
        let mut args = [&on[..], &package, &["--force"]].concat();
        args[11] = input;
        assert!(!run(&args).status.success() && std::fs::read(input).unwrap() == before);
    }
    let bad = said(&["body", "drape", &mesh, "--panel", "chest", "--at", "0,0", "-o", "-"]);
    assert!(bad.contains("write three numbers: 0.06,0,0.2"), "{bad}");
}

#[test]
fn every_subcommand_has_a_help_with_an_example() {
    assert!(answer(&["--help"]).contains("Example"));
    for command in ["process", "features", "fcm", "scenes", "body"] {
        let help = answer(&[command, "--help"]);
        assert!(help.contains("Example") && help.contains(&format!("taxel {command}")), "{help}");
    }
}

/// The reader of a pipe may exit early.
#[test]
fn a_broken_pipe_is_quiet() {
    let text = r#"{"names": ["a", "b"], "W": [[0, 1], [0.5, 0]], "x0": [1, 0]}"#;
    let map = file("long.json", text.as_bytes());
    let mut command = Command::new(taxel());
    command.args(["fcm", &map, "--steps", "100000", "--json"]).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success());
}

#[test]
fn a_garment_is_set_up_by_touch() {
    let output = file("touched.toml", b"");
    let said = run(&["setup", "--simulate", "7", "--json", "--force", "-o", &output]);
    assert!(said.status.success(), "{said:?}");
    let lines: Vec<Value> = String::from_utf8(said.stdout)
        .unwrap()
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let kinds = |kind: &str| lines.iter().filter(|line| line["type"] == kind).count();
    assert_eq!((kinds("ask"), kinds("felt"), kinds("found")), (9, 9, 1));
    let garment = taxel::files::garments::load(&output).unwrap();
    assert_eq!(serde_json::to_value(&garment).unwrap(), lines.last().unwrap()["garment"]);
    let said = run(&["setup", "--simulate", "7"]);
    let text = String::from_utf8(said.stdout).unwrap();
    assert!(text.contains("9. Panel right arm: press") && text.contains("\n[wiring]\n"), "{text}");
    let said = run(&["setup", "--simulate", "7", "--garment", "block-4x16"]);
    let why = String::from_utf8(said.stderr).unwrap();
    assert!(said.status.code() == Some(1) && why.contains("only binary addresses do"), "{why}");
}

#[test]
fn nobody_touches_and_nothing_is_claimed() {
    let idle = file("nobody.toml", b"duration_s = 1\n[idle]\nspread_counts = 1\n");
    let source = format!("sim:{idle}");
    let said = run(&["setup", "--source", &source, "--wait", "0.3"]);
    let why = String::from_utf8(said.stderr).unwrap();
    assert!(
        said.status.code() == Some(1) && why.contains("not sure: Nothing was felt on any panel"),
        "{why}"
    );
    let said = run(&["settle", "--source", &source, "--json"]);
    let why = String::from_utf8(said.stderr).unwrap();
    assert!(said.status.code() == Some(1) && why.contains("too few edges"), "{why}");
}

#[test]
fn settling_is_found_and_written() {
    let weights = concat!("sim:", env!("CARGO_MANIFEST_DIR"), "/../../examples/scenes/weights.toml");
    let output = file("settled.toml", b"");
    let said = run(&["settle", "--source", weights, "--json", "--force", "-o", &output]);
    assert!(said.status.success(), "{said:?}");
    let settled: Value = serde_json::from_slice(&said.stdout).unwrap();
    // 800 ns and 4 of 4,095 counts: 5,545 ns, three conversions; a second round of the four inputs takes less
    // time than a slower pace.
    assert_eq!(settled["in_slots_ns"], 12_000);
    assert_eq!(settled["measured"], serde_json::json!([26, 27, 28, 29]));
    let garment = taxel::files::garments::load(&output).unwrap();
    assert_eq!(settled["settle_ns"], garment.wiring.settle_ns);
}

/// Nine touches in the order of the requests, on a garment wired as shipped.
#[test]
fn a_board_is_set_up_by_touch() {
    let mut script = String::from("duration_s = 30\n");
    let mut touch = |panel: &str, at: [f64; 2], velocity: [f64; 2], hold_s: f64, number: usize| {
        script += &format!(
            "[[touch]]\npanel = \"{panel}\"\nshape = \"finger\"\nforce_n = 8\nsize_mm = [26, 22]\nat = {at:?}\n\
             velocity = {velocity:?}\nstart_s = {}\nrise_s = 0.05\nhold_s = {hold_s}\nfall_s = 0.05\n",
            0.5 + 2.5 * number as f64
        );
    };
    let panels = ["chest", "back", "left arm", "right arm"];
    for (number, panel) in panels.iter().enumerate() {
        touch(panel, [3.4, 0.0], [0.0, 20.0], 1.45, number);
    }
    touch("chest", [0.0, 17.0], [12.0, 0.0], 1.15, 4);
    for (number, panel) in panels.iter().enumerate() {
        touch(panel, [0.3, 0.4], [0.0, 0.0], 0.4, 5 + number);
    }
    let source = format!("sim:{}", file("nine.toml", script.as_bytes()));
    let output = file("found.toml", b"");
    let said = run(&["setup", "--source", &source, "--json", "--force", "-o", &output]);
    assert!(
        said.status.success(),
        "{}{}",
        String::from_utf8_lossy(&said.stdout),
        String::from_utf8_lossy(&said.stderr)
    );
    let found = taxel::sim::Decoder::build(&taxel::files::garments::load(&output).unwrap());
    let wired = taxel::sim::Decoder::build(&taxel_core::garment::Garment::reference());
    // All levels of the nine address lines, on every input.
    let lines = [2, 3, 6, 7, 8, 9, 10, 11, 12];
    for word in 0..512u64 {
        let levels = lines.iter().enumerate().map(|(bit, pin)| (word >> bit & 1) << pin).sum();
        let shown =
            |decoder: &taxel::sim::Decoder, input| decoder.taxel(decoder.address(levels).unwrap(), input);
        assert!((0..4).all(|input| shown(&found, input) == shown(&wired, input)), "{word:#b}");
    }
}
