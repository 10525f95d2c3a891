//! A recording of a calibrated garment contains the calibration, and exported tables are in its unit.

use super::stage::{file, plan};
use crate::mat::{box_for, knee};
use std::path::Path;
use taxel::files::calibrate::Calibration;
use taxel::files::calibrate::ForceScale;
use taxel::record::{Origin, Plan, PlannedBoard, Recorder};
use taxel::recording::CALIBRATION;
use taxel::recording::Overview;
use taxel::robot::BoardConfig;
use taxel::source::{self, SourceOptions};
use taxel_cli::commands::recordings::export::{ExportArgs, Form, run};
use taxel_cli::watch::{BoardArgs, Overwrite, WatchOptions, watch};

/// Records the scene with the calibration and raw codes.
fn recorded(name: &str, calibration: &Calibration) {
    let (scene, certificate) = (file(&format!("{name}.scene.toml")), file(&format!("{name}.toml")));
    std::fs::write(&scene, box_for(1)).unwrap();
    calibration.write(&certificate).unwrap();
    let spec: source::SourceSpec = format!("sim:{}", scene.display()).parse().unwrap();
    let source = source::open(&spec, &SourceOptions::default()).unwrap();
    let origin = Origin { scale: ForceScale::new(Some(calibration.clone()), None), ..Origin::default() };
    let recorder = recorder(origin, &format!("{name}.mcap"));
    let config = BoardConfig { calibration: Some(certificate), raw: true, ..BoardConfig::of(spec) };
    watch(&WatchOptions::on(BoardArgs { config, ..BoardArgs::default() }), source, &mut recorder.board(0))
        .unwrap();
    recorder.finish().unwrap();
}

/// A recorder of a board of this origin.
fn recorder(origin: Origin, name: &str) -> Recorder {
    let boards = vec![PlannedBoard { origin, ..PlannedBoard::default() }];
    Recorder::create(Plan { boards, ..plan(name, "sim", None, false) }).unwrap()
}

fn table(path: &Path, output: &str, counts: bool) -> Vec<Vec<String>> {
    let output = file(output);
    let force = Overwrite { force: true };
    run(ExportArgs { counts, force, ..ExportArgs::of(path.to_path_buf(), Form::Csv, output.clone()) })
        .unwrap();
    let text = std::fs::read_to_string(output).unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(String::from).collect()).collect()
}

#[test]
fn who_calibrated_when_and_how_is_in_it() {
    let calibration = knee();
    recorded("calibrated", &calibration);
    let path = file("calibrated.mcap");
    let scan = taxel::recording::scan(&path).unwrap();
    let text =
        String::from_utf8(Overview::of(&path).unwrap().attached(CALIBRATION).unwrap().unwrap()).unwrap();
    assert_eq!(Calibration::parse(&text, "attached").unwrap(), calibration);
    let words = &scan.metadata.iter().rfind(|words| words.name == "taxel").unwrap().metadata;
    assert!(words["calibration"].starts_with(&format!("id {}, {}", calibration.id, calibration.date)));
    assert_eq!([&words["calibration_by"], &words["calibration_how"]], ["Anna", "plates of 5 N"]);
    assert_eq!(
        words["calibration_fit"],
        "forces within 1.25 % rms, 3.00 % at most; hysteresis 2.00 %, noise of a taxel 1.50 %"
    );
    assert!(Overview::of(&path).unwrap().attached("nothing").unwrap().is_none());
}

#[test]
fn one_that_is_not_in_force_is_not_in_it() {
    let calibration = knee();
    let spec: source::SourceSpec = "sim:pat".parse().unwrap();
    let source = source::open(&spec, &SourceOptions::default()).unwrap();
    let origin = Origin { scale: ForceScale::new(Some(calibration), None), ..Origin::default() };
    let recorder = recorder(origin, "unstated.mcap");
    watch(&WatchOptions::of(spec), source, &mut recorder.board(0)).unwrap();
    recorder.finish().unwrap();
    let scan = taxel::recording::scan(&file("unstated.mcap")).unwrap();
    assert!(Overview::of(&file("unstated.mcap")).unwrap().attached(CALIBRATION).unwrap().is_none());
    assert!(scan.metadata.iter().all(|metadata| !metadata.metadata.contains_key("calibration_by")));
    // Newtons of the simulation, and not those of the calibration.
    let words = &scan.metadata.iter().rfind(|words| words.name == "taxel").unwrap().metadata;
    assert_eq!(words["counts_per_newton"], "1000");
}

#[test]
fn a_table_is_in_volts_and_in_the_unit_of_the_calibration() {
    recorded("in-kpa", &knee());
    let path = file("in-kpa.mcap");
    let (printed, plain) = (table(&path, "in-kpa.csv", false), table(&path, "in-counts.csv", true));
    assert_eq!((printed.len(), printed.len() % 64), (plain.len(), 0));
    let (mut most, mut raised) = (0f64, 0.0);
    for (printed, plain) in printed.iter().zip(&plain) {
        assert_eq!((printed[..11].to_vec(), printed[12].as_str()), (plain[..11].to_vec(), "kPa"));
        let [column, x]: [f64; 2] = [&printed[3], &printed[4]].map(|text| text.parse().unwrap());
        assert_eq!((x, printed[6].as_str(), plain[12].as_str()), (10.0 * column, "base", "counts"));
        assert!(printed[7..10].iter().all(String::is_empty), "a panel's place on its link is not known");
        let counts: f64 = plain[11].parse().unwrap();
        let newtons = (counts / 1000.0).min(1.0) + (counts - 1000.0).max(0.0) / 500.0;
        let kpa: f64 = printed[11].parse().unwrap();
        // A square of 10 mm: 1 N is 10 kPa. The curve is in whole uN.
        assert!((kpa - 10.0 * newtons).abs() < 2e-4, "{printed:?} {plain:?}");
        let volts: f64 = printed[10].parse().unwrap();
        assert!(volts < 3.3);
        // The filter smooths counts and the volts of a touch say when they rise: 1,000 counts are 0.806 V.
        (most, raised) = (f64::max(most, kpa), f64::max(raised, volts));
    }
    assert!(most > 5.0 && raised > 0.5, "{most} kPa, {raised} V");
}
