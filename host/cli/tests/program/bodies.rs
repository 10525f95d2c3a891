//! `taxel body` from outside: bodies that are checked, placed on a robot in a posture, and draped over a mesh.

use crate::called::{answer, file, json, run};
use std::path::Path;

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
    let fitted =
        file("list.toml", format!("[[patches]]\npanel = \"mat\"\non.taxels = {list:?}\n").as_bytes());
    let holed = "0 0 0 0 0 0\n".to_string() + &"0 0 0.1 0 0 1\n".repeat(2047);
    let holed = file("holed.txt", holed.as_bytes());
    let holed =
        file("holed.toml", format!("[[patches]]\npanel = \"mat\"\non.taxels = {holed:?}\n").as_bytes());
    let table = answer(&["body", "check", &holed, "--garment", "mat-64x32"]);
    assert!(
        table.starts_with("mat  on base  2047 taxels, without a place: taxel 0, neighbours at"),
        "{table}"
    );
    let over = run(&["body", "places", &fitted, "--garment", "mat-64x32", "-o", &list, "--force"]);
    assert!(!over.status.success() && std::fs::read(&list).unwrap().len() == 14 * 2048);
    let printed =
        answer(&["live", "--source", "sim:pat", "--body", "reference", "--frames", "120", "--json"]);
    let pressing =
        printed.lines().filter(|line| line.starts_with("{\"type\":\"pressing\"")).collect::<Vec<_>>();
    assert!(pressing.len() > 10 && pressing[0].contains("\"link\":\"torso\""), "{pressing:?}");
    let other = run(&["body", "check", "reference", "--garment", "mat-64x32"]);
    let printed = String::from_utf8(other.stderr).unwrap();
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
    assert!(!other.status.success() && printed.contains(what), "{printed}");
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
        let (code, printed) = said(args);
        assert!(code == status && printed.contains(what), "{code}: {printed}");
    }
    // A robot that is read is never overwritten.
    let trunk = b"<robot><link name=\"trunk\"/></robot>";
    let urdf = file("robot.urdf", trunk);
    let over = run(&["body", "places", "reference", "--robot", &urdf, "-o", &urdf, "--force"]);
    assert!(!over.status.success() && std::fs::read(&urdf).unwrap() == trunk);
    let (code, printed) = said(&["--robot", &urdf]);
    let what = format!("reference, line 6, `patches[0].panel`: {urdf}: there is no link \"torso\"");
    assert!(code == 1 && printed.contains(&what), "{printed}");
}

#[test]
fn a_panel_is_draped_over_a_mesh_and_put_on() {
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
    let named = "<robot>\n<link name=\"torso\">\n<visual><origin xyz=\"0.01 0 0\"/><geometry><mesh filename=\"package://meshes/board.obj\" \
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
    let package = ["--package", &format!("meshes={folder}")];
    let listed = answer(&[&on[..], &package].concat());
    // As over the mesh itself, 1 cm farther to the front.
    let first = |list: &str| list.lines().nth(1).unwrap().to_string();
    let list = std::fs::read_to_string(&list).unwrap();
    assert_eq!(first(&listed), first(&list).replace("0.050000", "0.060000"));
    let lost = said(&on);
    let what =
        format!("{urdf}, line 3, link \"torso\": mesh package://meshes/board.obj: no folder above the file");
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
        let printed = String::from_utf8(done.stderr).unwrap();
        assert!(done.status.code() == Some(2) && printed.contains(what), "{printed}");
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
