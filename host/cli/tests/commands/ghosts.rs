//! Ghosts of a passive matrix with exactly solved currents: three pressed corners create a fourth, and only
//! this one is reported as a ghost.

use std::sync::atomic::{AtomicU32, Ordering};
use taxel_cli::commands::board::health::{HealthArgs, HealthText, candidates, look};
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{Board, BoardInfo, Input};
use taxel_core::body::Placed;
use taxel_core::contact::Phase;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Pins};
use taxel_core::scene::Scene;
use taxel_core::wire::{Receiver, Report, Request, decode, encode};

const ROWS: usize = 4;
const COLUMNS: usize = 16;
/// Conductances at rest and under pressure.
const REST: f64 = 1e-4;
const PRESSED: f64 = 1.0;

/// Codes of a matrix of conductances between rows and columns. To read a taxel, its row is at 1 and its
/// column at 0; all others float.
fn codes(conductance: &[[f64; COLUMNS]; ROWS]) -> Vec<Code> {
    let read = |row: usize, column: usize| {
        let (mut rows, mut columns) = ([0.5; ROWS], [0.5; COLUMNS]);
        // Gauss-Seidel: each floating node takes the mean of its neighbours.
        for _ in 0..2000 {
            (rows[row], columns[column]) = (1.0, 0.0);
            for r in (0..ROWS).filter(|r| *r != row) {
                let sum: f64 = (0..COLUMNS).map(|c| conductance[r][c] * columns[c]).sum();
                rows[r] = sum / conductance[r].iter().sum::<f64>();
            }
            for c in (0..COLUMNS).filter(|c| *c != column) {
                let sum: f64 = (0..ROWS).map(|r| conductance[r][c] * rows[r]).sum();
                columns[c] = sum / (0..ROWS).map(|r| conductance[r][c]).sum::<f64>();
            }
        }
        (0..ROWS).map(|r| conductance[r][column] * rows[r]).sum::<f64>()
    };
    let taxels = (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| (row, column)));
    taxels.map(|(row, column)| Code((2000.0 * read(row, column)).round() as u16)).collect()
}

/// Contacts of a board at rest on which these taxels are then pressed.
fn contacts(pressed: &[(usize, usize, f64)]) -> Vec<Placed> {
    let mut scene = Scene::shipped();
    scene.condition.filter = taxel_core::condition::Filter::Off;
    let info =
        BoardInfo { firmware: "", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };
    let mut board = Box::new(Board::<64, 32>::new(info, Garment::block(), scene).unwrap());
    for request in [Request::Start, Request::Tare { frames: 4 }] {
        let mut wire = [0; 64];
        let frame = encode(&request, &mut wire).unwrap();
        board.step(Micros(0), Input::Received(frame), &mut ());
    }
    let mut matrix = [[REST; COLUMNS]; ROWS];
    let rest = codes(&matrix);
    pressed.iter().for_each(|(row, column, conductance)| matrix[*row][*column] = *conductance);
    let touched = codes(&matrix);
    let mut present = Vec::new();
    for frame in 0..40u64 {
        let codes = if frame < 10 { &rest } else { &touched };
        let report = ScanReport { start: Micros(frame * 5_000), ..ScanReport::default() };
        board.step(report.start, Input::Scanned(Ok(Scan { codes, report })), &mut ());
        let mut receiver = Box::new(Receiver::<8192>::new());
        while let [byte, ..] = board.pending(report.start, &mut ()) {
            if let Some(Ok(body)) = receiver.push(*byte)
                && let (0u32.., Report::Contacts(list)) = decode(body).unwrap()
            {
                present = list.contacts.to_vec();
            }
            board.sent(1);
        }
    }
    present.retain(|placed| placed.contact.phase != Phase::Released);
    present
}

/// Sorted places of the peaks of contacts.
fn places<'a>(contacts: impl IntoIterator<Item = &'a Placed>) -> Vec<(u16, u16)> {
    let mut places: Vec<_> =
        contacts.into_iter().map(|p| (p.contact.peak_at.row, p.contact.peak_at.column)).collect();
    places.sort_unstable();
    places
}

#[test]
fn the_fourth_corner_of_three_is_a_candidate() {
    let garment = Garment::block();
    let present = contacts(&[(0, 3, PRESSED), (0, 11, PRESSED), (3, 3, PRESSED)]);
    assert_eq!(places(&present), [(0, 3), (0, 11), (3, 3), (3, 11)], "a third of the signal is a contact");
    assert_eq!(places(candidates(&garment, &present)), [(3, 11)]);
}

#[test]
fn what_makes_no_rectangle_is_no_candidate() {
    let garment = Garment::block();
    for pressed in [
        vec![(0, 3, PRESSED), (3, 11, PRESSED)],
        vec![(0, 1, PRESSED), (0, 5, PRESSED), (0, 9, PRESSED), (0, 13, PRESSED)],
        // Four, pressed equally.
        vec![(0, 3, PRESSED), (0, 11, PRESSED), (3, 3, PRESSED), (3, 11, PRESSED)],
    ] {
        let present = contacts(&pressed);
        assert_eq!(present.len(), pressed.len());
        assert!(candidates(&garment, &present).is_empty(), "{pressed:?}");
    }
}

/// Result of `taxel health` for pens on a simulated board with passive or other wiring. They press the
/// corners of a rectangle on the first and the last row, each within its row: on four rows, wider ones would
/// merge to two contacts.
fn health(garment: &str, wiring: &str, corners: &[(f64, f64)], passive: Option<bool>) -> HealthText {
    static FILES: AtomicU32 = AtomicU32::new(0);
    let pen = |(row, column): &(f64, f64)| {
        format!(
            "[[touch]]\npanel = \"mat\"\nshape = \"plate\"\nsize_mm = [24, 6]\nat = [{column}, {row}]\nforce_n = 4.5\n\
             start_s = 0.3\nrise_s = 0.02\nhold_s = 3\n"
        )
    };
    let pens: String = corners.iter().map(pen).collect();
    let text = format!("duration_s = 2\ngarment = \"{garment}\"\n[wiring]\n{wiring}\n{pens}");
    let name = format!("ghosts-{}-{}.toml", std::process::id(), FILES.fetch_add(1, Ordering::Relaxed));
    let file = std::env::temp_dir().join(name);
    std::fs::write(&file, text).unwrap();
    let source = format!("sim:{}", file.display()).parse().unwrap();
    // A single block is scanned in a sixteenth of the time, as often as the link allows.
    let frames = if garment == "block-4x16" { 1_500 } else { 200 };
    let reported = look(&HealthArgs { source, frames, tare: None, self_test: false, passive, json: true });
    std::fs::remove_file(&file).unwrap();
    reported.unwrap()
}

const CORNERS: [(f64, f64); 4] = [(0.0, 3.0), (0.0, 11.0), (3.0, 3.0), (3.0, 11.0)];

const UNFILTERED: &str = "\n[scene.condition]\nfilter = \"off\"";

#[test]
fn the_fourth_corner_of_a_passive_block_is_named_by_the_command() {
    // The second is a block among others, declared as passive. Its pens are too narrow for the filter.
    let unfiltered = format!("passive = true{UNFILTERED}");
    for (garment, wiring, passive) in
        [("block-4x16", "passive = true", None), ("mat-64x32", unfiltered.as_str(), Some(true))]
    {
        let reported = health(garment, wiring, &CORNERS[..3], passive);
        let ghosts = reported.json["ghosts"].as_array().unwrap();
        // Its peak alternates between taxels, all of the fourth corner.
        let is_there = |ghost: &serde_json::Value| {
            let column = ghost["column"].as_u64().unwrap();
            ghost["panel"] == "mat" && ghost["row"] == 3 && (10..=12).contains(&column)
        };
        assert!(!ghosts.is_empty() && ghosts.iter().all(is_there), "{garment}: {}", reported.text);
        let times: u64 = ghosts.iter().map(|ghost| ghost["times"].as_u64().unwrap()).sum();
        assert!(times >= 100, "{garment}: {times} times");
        assert!(reported.text.contains("ghost?   mat, row 3, column 1"), "{}", reported.text);
    }
}

#[test]
fn nothing_that_is_pressed_is_called_a_ghost() {
    // With amplifiers, or a diode at each taxel, three corners create no fourth.
    let reported = health("mat-64x32", UNFILTERED, &CORNERS[..3], Some(true));
    assert_eq!(reported.json["ghosts"], serde_json::json!([]), "{}", reported.text);
    let reported = health("mat-64x32", UNFILTERED, &CORNERS[..3], None);
    assert!(reported.json["ghosts"].is_null());
    // Two create none on a passive matrix.
    let reported = health("block-4x16", "passive = true", &CORNERS[..2], None);
    assert_eq!(reported.json["ghosts"], serde_json::json!([]), "{}", reported.text);
}
