//! The program from outside: one sentence and an exit status for bad
//! input.

use crate::called::{answer, file, json, refused, run, said};
use crate::start::taxel;
use npyz::WriterBuilder;
use std::io::{Cursor, Write as _};
use std::process::{Command, Stdio};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

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
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for name in ["a.npy", "b.npy"] {
        writer.start_file(name, SimpleFileOptions::default()).unwrap();
        writer.write_all(&npy(&[2, 3], &[1u16, 2, 3, 4, 5, 6])).unwrap();
    }
    writer.finish().unwrap().into_inner()
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
    refused(1, &["process", &cut], &["cut.npy", "truncated", "12 bytes", "9"]);
    refused(1, &["process", &flat], &["flat.npy", "[6]", "[frames, rows, columns]"]);
    refused(1, &["process", &nan], &["nan.npy", "frame 1, row 0, column 1", "NaN"]);
    refused(1, &["process", &half], &["half.csv", "line 2", "row 1, column 1", "4.5"]);
    refused(1, &["process", &text, "--json"], &["text.npy", "not a NumPy array"]);
    refused(1, &["process", &missing], &["missing.npy", "cannot be read"]);
}

#[test]
fn what_speaks_against_recorded_frames_is_reported() {
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
}

#[test]
fn what_is_not_in_a_file_is_refused_by_name() {
    let two = file("two.npz", &two_images());
    refused(2, &["process", &two, "--array", "c"], &["two.npz", "no array c", "a, b"]);
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
    refused(1, &["live", "--source", "replay:/no/such/bytes"], &["/no/such/bytes"]);
    let garbage = file("garbage.bin", &[0x5a; 4000]);
    refused(1, &["live", "--source", &format!("replay:{garbage}"), "--json"], &["garbage.bin"]);
}

/// An unreadable argument has the same status; clap adds how to get help.
#[test]
fn bad_arguments_have_the_same_status() {
    for args in
        [&["process"][..], &["process", "x.npy", "--full-scale", "-1"], &["nothing"], &["fcm", "x", "--no"]]
    {
        let output = run(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(String::from_utf8_lossy(&output.stderr).starts_with("error: "), "{args:?}");
    }
}

#[test]
fn scripts_of_touches_are_listed() {
    let touches = json(&["config", "touches", "--json"]);
    let names: Vec<&str> =
        touches.as_array().unwrap().iter().map(|script| script["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"pat") && names.contains(&"lash"));
    let table = answer(&["config", "touches"]);
    assert_eq!(table.lines().count(), names.len());
    assert!(names.iter().zip(table.lines()).all(|(name, line)| line.starts_with(name)));
}

#[test]
fn every_subcommand_has_a_help_with_an_example() {
    assert!(answer(&["--help"]).contains("Example"));
    for command in ["process", "fcm", "config", "body"] {
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
