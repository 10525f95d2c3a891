//! `taxel body fit` from outside: marks that a simulated garment feels, touches of a file, and what is
//! refused.

use crate::start::taxel;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

fn run(args: &[&str]) -> Output {
    Command::new(taxel()).args(args).stdin(Stdio::null()).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fitted");
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn file(name: &str, text: &str) -> String {
    let path = folder().join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().into()
}

/// Link and place of a taxel of the reference garment, as `taxel body places` has them.
fn places() -> Vec<(String, [f64; 3])> {
    let table = run(&["body", "places", "reference", "-o", "-"]).stdout;
    let line = |line: &str| {
        let parts: Vec<&str> = line.split(',').collect();
        let number = |at: usize| parts[at].parse::<f64>().unwrap();
        (parts[1].to_string(), [number(2), number(3), number(4)])
    };
    String::from_utf8(table).unwrap().lines().skip(1).map(line).collect()
}

/// Marks on the chest and the left arm are touched while the garment sits a taxel (12 mm) too far to the left
/// and two (20 mm) too high on the chest, and as it should be on the arm. The fourth mark is missed: the back
/// is touched, which lies on the torso, too, and the chest's next touch comes when a mark of the arm is asked
/// for.
#[test]
fn a_garment_is_fitted_by_marks_that_a_simulation_touches() {
    let places = places();
    let (mut marks, mut script) = (String::from("# on the robot\n"), String::from("duration_s = 8\n"));
    let touched =
        [(0, 8, 4), (0, 20, 10), (0, 28, 5), (0, 6, 12), (2, 8, 4), (2, 20, 10), (2, 26, 5), (2, 8, 11)];
    let mut start = 0.6;
    let mut touch = |panel: usize, row: usize, column: usize| {
        let panel = ["chest", "back", "left arm"][panel];
        let _ = write!(
            script,
            "[[touch]]\npanel = \"{panel}\"\nshape = \"finger\"\nforce_n = 5\nat = [{column}, {row}]\nstart_s = {start}\n\
             hold_s = 0.1\n"
        );
        start += 0.6;
    };
    for (number, (panel, row, column)) in touched.into_iter().enumerate() {
        let (link, [x, y, z]) = &places[panel * 512 + row * 16 + column];
        let _ = writeln!(marks, "{link} {x} {y} {z}");
        if number == 3 {
            touch(1, 5, 5);
        }
        let (down, right) = if panel == 0 { (2, 1) } else { (0, 0) };
        touch(panel, row + down, column + right);
    }
    let (marks, script) = (file("marks.txt", &marks), file("marks.toml", &script));
    let source = format!("sim:{script}");
    let fitted = folder().join("fitted.toml").to_str().unwrap().to_string();
    let done =
        run(&["body", "fit", "reference", "--marks", &marks, "--source", &source, "-o", &fitted, "--force"]);
    let (words, table) = (said(&done), String::from_utf8_lossy(&done.stdout).into_owned());
    assert!(done.status.success(), "{words}");
    assert!(words.starts_with("Touch mark 1 of 8: torso, "), "{words}");
    assert!(words.contains("That was chest, on torso; the mark is on left_upper_arm. Once more:"), "{words}");
    assert!(table.contains("chest: ") && table.contains("  worst: touch "), "{table}");
    let text = std::fs::read_to_string(&fitted).unwrap();
    assert!(text.contains("# The reference garment on a robot of a child's size"));
    let body: toml::Table = text.parse().unwrap();
    let patches = body["patches"].as_array().unwrap();
    let of = |patch: usize, key: &str| patches[patch]["offset"][key].as_float().unwrap();
    for (key, exact, within) in [("right", -0.012, 1e-3), ("down", -0.02, 1e-3), ("turn", 0.0, 0.6)] {
        assert!((of(0, key) - exact).abs() < within, "{key}: {text}");
        assert!((of(2, key) - exact * 0.0).abs() < within, "{key}: {text}");
    }
    assert!(patches[1].get("offset").is_none() && patches[3].get("offset").is_none());
    // So placed, the chest lies on the back's edge.
    let printed = said(&run(&["body", "check", &fitted]));
    assert!(
        printed.contains("fitted.toml, line 11, `patches[1].panel`: back lies on the panel chest"),
        "{printed}"
    );
    // Never over what it reads, and not over another file unasked.
    for (output, force) in [(&marks, true), (&script, true), (&fitted, false)] {
        let before = std::fs::read(output).unwrap();
        let mut args = vec!["body", "fit", "reference", "--marks", &marks, "--source", &source, "-o", output];
        args.extend(force.then_some("--force"));
        let done = run(&args);
        assert!(!done.status.success() && std::fs::read(output).unwrap() == before, "{}", said(&done));
    }
}

#[test]
fn a_garment_is_fitted_by_touches_of_a_file() {
    let places = places();
    let mut touches = String::from("panel,column,row,link,x,y,z\n");
    for taxel in [50, 130, 300, 400, 470] {
        let (link, [x, y, z]) = &places[taxel];
        let _ = writeln!(touches, "chest,{},{},{link},{x},{y},{z}", taxel % 16, taxel / 16);
    }
    touches.push_str("back,3,3,torso,-0.06,0,0.2\n");
    let file_of = file("known.csv", &touches);
    let done = run(&["body", "fit", "reference", "--touches", &file_of, "-o", "-", "--json"]);
    let fit: serde_json::Value = serde_json::from_slice(&done.stderr).unwrap();
    assert_eq!((&fit["panels"][0]["panel"], &fit["few"][0]["touches"]), (&"chest".into(), &1.into()));
    assert!(fit["panels"][0]["rms"].as_f64().unwrap() < 1e-5, "{fit}");
    let text = String::from_utf8(done.stdout).unwrap();
    assert!(text.contains("offset = { right = 0.0, down = 0.0, turn = 0.0 }"), "{text}");
    let why = |args: &[&str]| {
        let done = run(&[&["body", "fit", "reference", "-o", "-"][..], args].concat());
        (done.status.code().unwrap(), said(&done))
    };
    let lines =
        |count: usize| touches.lines().take(count).map(|line| format!("{line}\n")).collect::<String>();
    let few = file("few.csv", &lines(3));
    let wrong = file("wrong.csv", &touches.replace("back", "bck"));
    let marks = file("unknown.txt", "head 0 0 0\n");
    for (args, status, what) in [
        (
            &["--touches", &few][..],
            1,
            "no panel has been touched at three places or more: nothing is written",
        ),
        (&["--touches", &wrong], 1, "touch 6: the garment has no panel \"bck\""),
        (&["--touches", "no.csv"], 1, "cannot read no.csv"),
        (
            &["--marks", &marks, "--source", "sim:pat"],
            1,
            "unknown.txt: no panel lies on a link \"head\"; panels lie on torso",
        ),
        (&["--pick", "3", "--source", "sim:nobody"], 2, "nobody"),
        (&["--pick", "2"], 2, "--pick"),
        (&[], 2, "--touches"),
        (&["--touches", &few, "--source", "sim:pat"], 2, "--source"),
    ] {
        let (code, printed) = why(args);
        assert!(code == status && printed.contains(what), "{args:?} {code}: {printed}");
    }
    // A list lies beside the body that names it.
    let row = "0 0 0.1 0 0 1\n".repeat(2048);
    file("list.txt", &row);
    let listed = file("listed.toml", "[[patches]]\npanel = \"mat\"\non.taxels = \"list.txt\"\n");
    let done =
        run(&["body", "fit", &listed, "--garment", "mat-64x32", "--touches", &few, "-o", "elsewhere.toml"]);
    let printed = said(&done);
    assert!(
        done.status.code() == Some(2) && printed.contains("elsewhere.toml: must lie beside "),
        "{printed}"
    );
}
