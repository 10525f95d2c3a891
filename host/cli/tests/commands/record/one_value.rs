//! A contact has one value in one unit in JSON and in a table: on three garments, calibrated and not.

use super::stage::{file, plan};
use serde_json::Value;
use std::collections::BTreeMap;
use taxel::files::calibrate::{Calibration, Curve, Fitted, Residuals, Rest};
use taxel::files::garments;
use taxel::json::MessagePrinter;
use taxel::record::{Plan, PlannedBoard, Recorder};
use taxel::robot::BoardConfig;
use taxel::session::Observer;
use taxel::source::SourceOptions;
use taxel_cli::commands::recordings::export::{ExportArgs, Form, run};
use taxel_cli::watch::{BoardArgs, Overwrite, WatchOptions, watch};
use taxel_core::condition::UNITY;
use taxel_core::garment::Layout;

/// A calibration of a garment, whose curves have a knee at 200 counts, which every touch is above.
fn calibration(garment: &str) -> Calibration {
    let read = garments::read(garment).unwrap().garment;
    let layout = Layout::build(&read, 2048, 4095).unwrap();
    let curve = || Curve::new(vec![[3_200, 200_000], [11_200, 1_200_000]]).unwrap();
    let fitted = Fitted {
        gains: vec![UNITY; layout.taxels()],
        curves: layout.areas().iter().map(|_| Some(curve())).collect(),
        silent: Vec::new(),
        residuals: Residuals { error: 0.01, worst: 0.03, hysteresis: 0.02, noise: 0.01, rest: 0.0 },
        weights: Vec::new(),
    };
    let rest = Rest { codes: vec![300.0; layout.taxels()], noise: 2.0 };
    Calibration::of(fitted, &layout, &rest, [garment, "Anna", "plates of 5 N", "sim"])
}

/// Records a script; the lines of its frames, by their numbers.
fn recorded(name: &str, garment: &str, is_calibrated: bool) -> BTreeMap<u64, Value> {
    let certificate = file(&format!("{name}.toml"));
    calibration(garment).write(&certificate).unwrap();
    let mut config = BoardConfig::of("sim:press".parse().unwrap());
    config.garment = Some(garment.into());
    config.calibration = is_calibrated.then_some(certificate);
    let args = BoardArgs { config, ..BoardArgs::default() };
    let (source, _) = args.open(SourceOptions::default()).unwrap();
    let boards = vec![PlannedBoard::default()];
    let plan = plan(&format!("{name}.mcap"), "sim", None, false);
    let recorder = Recorder::create(Plan { boards, ..plan }).unwrap();
    let (mut board, mut printed) = (recorder.board(0), Vec::new());
    let mut lines = MessagePrinter::new(false, &mut printed);
    let mut both: Vec<&mut dyn Observer> = vec![&mut board, &mut lines];
    watch(&WatchOptions::on(args), source, &mut both).unwrap();
    recorder.finish().unwrap();
    let lines = printed.split(|byte| *byte == b'\n').filter(|line| !line.is_empty());
    let lines = lines.map(|line| serde_json::from_slice::<Value>(line).unwrap());
    let frames = lines.filter(|line| line["type"] == "frame" && line["decoded"] == true);
    frames.map(|line| (line["frame"].as_u64().unwrap(), line)).collect()
}

/// Rows of the table of a recording's contacts, each with its columns by name.
fn table(name: &str) -> Vec<BTreeMap<String, String>> {
    let output = file(&format!("{name}.csv"));
    let args = ExportArgs::of(file(&format!("{name}.mcap")), Form::Csv, output.clone());
    run(ExportArgs { contacts: true, force: Overwrite { force: true }, ..args }).unwrap();
    let text = std::fs::read_to_string(output).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(String::from));
    let names: Vec<String> = lines.next().unwrap().collect();
    lines.map(|line| names.iter().cloned().zip(line).collect()).collect()
}

/// Fails unless a cell says what a value does, but for its rounding.
fn same(cell: &str, value: &Value, what: &str) {
    match (cell.parse::<f64>(), value.as_f64()) {
        (Ok(cell), Some(value)) => assert!((cell - value).abs() <= 1e-3, "{what}: {cell}, not {value}"),
        _ => assert_eq!(cell, value.as_str().unwrap_or_default(), "{what}"),
    }
}

#[test]
fn a_contact_has_one_value_in_one_unit_everywhere() {
    for garment in ["reference", "mat-64x32", "block-4x16"] {
        for (is_calibrated, basis) in [(false, "simulated"), (true, "calibrated")] {
            let name = format!("one-value-{garment}-{basis}");
            let frames = recorded(&name, garment, is_calibrated);
            let (rows, mut forces) = (table(&name), 0);
            for row in &rows {
                let line = &frames[&row["frame"].parse().unwrap()];
                let id: u32 = row["id"].parse().unwrap();
                let contacts = line["contacts"].as_array().unwrap();
                let contact = contacts.iter().find(|contact| contact["id"] == id).unwrap();
                for (column, cell) in row {
                    let of_line = ["frame", "time_us", "force_basis"].contains(&column.as_str());
                    same(cell, if of_line { &line[column] } else { &contact[column] }, column);
                }
                // When the certificate is in force depends on the host's threads.
                forces += usize::from(row["force_basis"] == basis);
            }
            assert!(forces > 30, "{name}: {forces} of {} rows", rows.len());
            let share = |row: &BTreeMap<String, String>| -> f64 {
                row["force_n"].parse::<f64>().unwrap() * 1000.0 / row["total"].parse::<f64>().unwrap()
            };
            let most = rows.iter().map(share).fold(0.0, f64::max);
            // Above the knee 500 counts are a newton.
            assert_eq!(is_calibrated, most > 1.2, "{name}: {most}");
        }
    }
}
