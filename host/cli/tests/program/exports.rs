//! Output of `taxel export`: names of columns, units, brightness.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use taxel::files::arrays;

fn taxel(args: &[&str]) -> Output {
    let done = Command::new(env!("CARGO_BIN_EXE_taxel")).args(args).output().unwrap();
    assert!(done.status.success(), "{args:?}: {}", String::from_utf8_lossy(&done.stderr));
    done
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A file of a test in the build folder.
fn file(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("exports");
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

/// A recorded pat, exported in a format.
fn exported(name: &str, raw: bool, to: &str, more: &[&str]) -> (Output, PathBuf) {
    let (recording, output) = (file(&format!("{name}.mcap")), file(name));
    let mut record = vec!["record", "--source", "sim:pat", "--force", "-o", text(&recording)];
    record.extend(raw.then_some("--raw"));
    taxel(&record);
    let args = ["export", text(&recording), "--to", to, "--force", "-o", text(&output)];
    (taxel(&[&args, more].concat()), output)
}

/// Grey levels of an image.
fn grey(path: &Path) -> Vec<u16> {
    let mut reader =
        png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap())).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    bytes.chunks(2).map(|two| u16::from_be_bytes([two[0], two[1]])).collect()
}

#[test]
fn columns_of_the_intent_have_names() {
    let (_, path) = exported("named.npz", false, "npz", &[]);
    let names = arrays::texts(&path, "concepts").unwrap().expect("an array of names");
    assert_eq!((names.len(), names.contains(&"kindness".to_string())), (22, true));
    assert_eq!(arrays::read(&path, Some("back")).unwrap().columns, 16);
}

#[test]
fn volts_are_there_or_said_to_be_missing() {
    let volts = |path: &Path| -> Vec<f64> {
        let table = fs::read_to_string(path).unwrap();
        let cell = |line: &str| line.split(',').nth(10).map(|volts| volts.parse().unwrap_or(f64::NAN));
        table.lines().skip(1).filter_map(cell).collect()
    };
    let (done, path) = exported("no-volts.csv", false, "csv", &["--every", "20"]);
    assert!(String::from_utf8_lossy(&done.stderr).contains("`taxel record --raw` records them"), "{done:?}");
    assert!(volts(&path).iter().all(|volts| volts.is_nan()));
    let (done, path) = exported("volts.csv", true, "csv", &["--every", "20"]);
    assert!(!String::from_utf8_lossy(&done.stderr).contains("raw"), "{done:?}");
    let volts = volts(&path);
    assert!(volts.len() > 2048 && volts.iter().all(|volts| (0.0..3.3).contains(volts)));
}

#[test]
fn the_contacts_are_a_table_of_their_own() {
    let (_, path) = exported("contacts.csv", false, "csv", &["--contacts"]);
    let table = fs::read_to_string(path).unwrap();
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    assert_eq!(names[..5], ["time_us", "frame", "id", "panel_name", "link"]);
    let rows: Vec<_> = lines.collect();
    assert!(rows.len() > 20 && rows.iter().all(|row| row.len() == names.len() && row[3] == "back"));
    for row in &rows {
        let [total, force]: [f64; 2] = [row[9], row[10]].map(|cell| cell.parse().unwrap());
        assert!((total / 1000.0 - force).abs() < 1e-4 && row[11] == "simulated", "{row:?}");
    }
}

#[test]
fn images_are_bright_and_their_scale_is_reported() {
    let (_, bright) = exported("bright", false, "png", &[]);
    let legend: serde_json::Value =
        serde_json::from_slice(&fs::read(bright.join("scale.json")).unwrap()).unwrap();
    let factor = legend["grey_per_count"].as_u64().unwrap() as u16;
    assert!(factor > 1, "{legend}");
    let (_, plain) = exported("plain", false, "png", &["--counts"]);
    let (mut greatest, mut images) = (0, 0);
    for folder in fs::read_dir(&bright).unwrap().map(|entry| entry.unwrap()).filter(|e| e.path().is_dir()) {
        for entry in fs::read_dir(folder.path()).unwrap() {
            let inside = Path::new(&folder.file_name()).join(entry.unwrap().file_name());
            let (bright, plain) = (grey(&bright.join(&inside)), grey(&plain.join(&inside)));
            assert!(bright.iter().zip(&plain).all(|(bright, plain)| *bright == plain * factor));
            greatest = bright.iter().copied().fold(greatest, u16::max);
            images += 1;
        }
    }
    assert!(images > 100 && greatest > u16::MAX / 2, "{images} images, brightest {greatest} of 65535");
}
