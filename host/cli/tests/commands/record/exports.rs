//! Exports contain what was recorded.

use super::stage::{Seen, file, plan, record};
use std::num::NonZeroU64;
use std::path::PathBuf;
use taxel::files::arrays;
use taxel_cli::commands::recordings::export::{ExportArgs, Form, run};
use taxel_cli::watch::Overwrite;

const PANELS: [&str; 4] = ["chest", "back", "left arm", "right arm"];

fn exported(seen_as: &str, to: Form, output: &str, every: u64) -> (Seen, PathBuf) {
    let name = format!("{seen_as}.mcap");
    let seen = record("sim:two-hands", plan(&name, "sim", None, false));
    let output = file(output);
    let every = NonZeroU64::new(every).unwrap();
    let plain = ExportArgs::of(file(&name), to, output.clone());
    let table = to == Form::Csv;
    let counts = to != Form::Npz;
    run(ExportArgs { force: Overwrite { force: true }, touched: table, counts, every, ..plain }).unwrap();
    (seen, output)
}

#[test]
fn numpy_arrays_hold_every_frame() {
    let (seen, path) = exported("npz", Form::Npz, "exported.npz", 1);
    for (index, panel) in PANELS.iter().enumerate() {
        let frames = arrays::read(&path, Some(panel)).unwrap();
        assert_eq!((frames.count, frames.rows, frames.columns), (seen.frames.len(), 32, 16));
        for (frame, (_, _, image)) in frames.iter().zip(&seen.frames) {
            assert_eq!(frame, &image[512 * index..][..512]);
        }
    }
}

#[test]
fn a_table_holds_every_taxel_that_is_touched() {
    let (seen, path) = exported("csv", Form::Csv, "exported.csv", 10);
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    assert_eq!(
        lines.next().unwrap(),
        "time_us,panel_name,row,column,x_mm,y_mm,link,x_m,y_m,z_m,volts,pressure,unit,force_basis"
    );
    let expected = seen.frames.iter().step_by(10).flat_map(|(_, time, image)| {
        let touched = image.iter().enumerate().filter(|(_, value)| **value > 0);
        touched.map(move |(taxel, value)| {
            let (panel, local) = (PANELS[taxel / 512], taxel % 512);
            (format!("{time},{panel},{},{},", local / 16, local % 16), *value)
        })
    });
    let mut rows = 0;
    for ((place, value), line) in expected.zip(lines.by_ref()) {
        assert!(
            line.starts_with(&place) && line.ends_with(&format!(",,,,,{value},counts,")),
            "{line} is not {place}"
        );
        rows += 1;
    }
    assert!(rows > 1000 && lines.next().is_none());
}

#[test]
fn images_hold_the_counts() {
    let (seen, folder) = exported("png", Form::Png, "images", 50);
    let legend: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.join("scale.json")).unwrap()).unwrap();
    for (number, _, image) in seen.frames.iter().step_by(50) {
        let path = folder.join(format!("{:05}/{number:08}.png", number / 1000));
        let mut reader = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()))
            .read_info()
            .unwrap();
        let mut grey = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut grey).unwrap();
        assert_eq!((info.width, info.height), (64, 32));
        let values: Vec<u16> = grey.chunks(2).map(|two| u16::from_be_bytes([two[0], two[1]])).collect();
        for (index, panel) in PANELS.iter().enumerate() {
            let printed = &legend["panels"][index];
            let left = printed["left"].as_u64().unwrap() as usize;
            assert_eq!((printed["name"].as_str(), left), (Some(*panel), 16 * index));
            for row in 0..32 {
                assert_eq!(values[64 * row + left..][..16], image[512 * index + 16 * row..][..16]);
            }
        }
    }
}
