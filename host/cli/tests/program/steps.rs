//! Messages about the program's steps: with `-v`, and at the end of a simulated scene.

use std::path::PathBuf;
use std::process::{Command, Output};

fn taxel(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_taxel")).args(args).output().unwrap()
}

fn errors(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn file(name: &str, text: &str) -> String {
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&file, text).unwrap();
    file.to_str().unwrap().into()
}

#[test]
fn verbose_names_source_board_and_files() {
    let scene = file("steps.toml", "duration_s = 1\ngarment = \"block-4x16\"\n");
    let source = format!("sim:{scene}");
    let args = ["live", "--source", &source, "--frames", "3", "--json"];
    let quiet = taxel(&args);
    assert_eq!(errors(&quiet), "");
    let verbose = taxel(&[&["-v"], &args[..]].concat());
    let printed = errors(&verbose);
    for step in [
        format!("taxel: reads {scene}\n"),
        format!("taxel: source {source} is open\n"),
        "garment block-4x16, scene".into(),
        "the board has done start\n".into(),
    ] {
        assert!(printed.contains(&step), "{step}\n{printed}");
    }
    assert_eq!(quiet.stdout, verbose.stdout, "the steps are reported beside the answer");
}

#[test]
fn a_recorded_scene_is_played_once_and_said_to_be_over() {
    let scene = file("once.toml", "duration_s = 0.5\n");
    let (source, output) = (format!("sim:{scene}"), file("once.mcap", ""));
    std::fs::remove_file(&output).unwrap();
    let args = ["record", "--source", &source, "-o", &output, "--force"];
    let printed = errors(&taxel(&args));
    assert!(printed.contains(&format!("{source} is over: a simulated scene is played once")), "{printed}");
    let longer = errors(&taxel(&[&args[..], &["--for", "1s"]].concat()));
    assert!(longer.contains(".mcap: 1.0 s") && !longer.contains("is over"), "{longer}");
    for command in ["record", "live", "report"] {
        let help = String::from_utf8(taxel(&[command, "--help"]).stdout).unwrap();
        assert!(help.contains("a simulated scene is played once"), "{command}: {help}");
    }
}

/// The last touch of a script counts, even if the script ends while it is held.
#[test]
fn shapes_are_learnt_from_every_touch_of_a_script() {
    let touches = |duration_s: f64| {
        let text = format!(
            "duration_s = {duration_s}\ngarment = \"block-4x16\"\n[[touch]]\npanel = \"mat\"\nshape = \"box\"\n\
             force_n = 8\nat = [7, 1.5]\nsize_mm = [20, 20]\nstart_s = 0.3\nrise_s = 0.1\nhold_s = 0.6\n\
             fall_s = 0.1\nrepeat = 3\nperiod_s = 1.0\n"
        );
        let (scene, base) = (file("touches.toml", &text), file("touches.json", ""));
        std::fs::remove_file(&base).unwrap();
        errors(&taxel(&["shapes", "learn", "mug", "--source", &format!("sim:{scene}"), "-o", &base]))
    };
    for duration_s in [3.5, 3.1, 2.8] {
        let printed = touches(duration_s);
        assert!(
            printed.contains("3 of 5: held for") && printed.contains("3 prototypes of mug from 3 touches"),
            "{printed}"
        );
        assert!(printed.contains("touches.toml ended after 3 of 5 touches\n"), "{printed}");
    }
}
