//! Forces of the robot's contacts, by the calibrations of the boards on which they are.

use super::scanning::{self, BEGAN_US, Scanning};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use taxel::files::calibrate::{Calibration, Curve, Fitted, Residuals, Rest};
use taxel::robot::{ReadRobot, RobotContact, RobotContacts, ScanReader};

use taxel_core::condition::{Filter, UNITY};
use taxel_core::garment::Layout;
use taxel_sim::{Script, World};

const TAXELS: usize = 64;
const PITCH_MM: f64 = 10.0;
/// Counts per newton that the boards' calibrations say.
const BOARDS: [(&str, u32); 2] = [("one", 1000), ("two", 500)];

/// A straight line of so many counts per newton.
fn calibration(counts: u32, taxels: usize) -> Calibration {
    let layout = Layout::build(&scanning::panel([4, 16], [10_000; 2]), TAXELS, 4095).unwrap();
    let fitted = Fitted {
        gains: vec![UNITY; taxels],
        curves: vec![Some(Curve::new(vec![[16 * counts, 1_000_000]]).unwrap())],
        silent: Vec::new(),
        residuals: Residuals { error: 0.01, worst: 0.02, hysteresis: 0.01, noise: 0.01, rest: 0.0 },
        weights: Vec::new(),
    };
    let rest = Rest { codes: vec![200.0; taxels], noise: 2.0 };
    Calibration::of(fitted, &layout, &rest, ["panel", "Anna", "plates of 5 N", "sim"])
}

/// The folder with the garment and the calibrations.
static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("newtons");
    std::fs::create_dir_all(&folder).unwrap();
    let garment = toml::to_string(&scanning::panel([4, 16], [10_000; 2])).unwrap();
    std::fs::write(folder.join("panel.toml"), garment).unwrap();
    for (file, counts, taxels) in [("one", 1000, TAXELS), ("two", 500, TAXELS), ("other", 500, 12)] {
        std::fs::write(
            folder.join(format!("{file}-force.toml")),
            calibration(counts, taxels).text().unwrap(),
        )
        .unwrap();
    }
    folder
});

fn read(calibrations: [Option<&str>; 2]) -> taxel::Result<ReadRobot> {
    let mut text = "name = \"two\"\n".to_string();
    for ((name, _), calibration) in BOARDS.iter().zip(calibrations) {
        let calibration = calibration.map_or(String::new(), |file| format!("calibration = \"{file}\"\n"));
        text += &format!("[[boards]]\nname = \"{name}\"\nsource = \"sim:press\"\n{calibration}");
        text += "garment = \"panel.toml\"\n";
    }
    text += "[[seams]]\na = { board = \"one\", panel = \"mat\", side = \"bottom\" }\n\
             b = { board = \"two\", panel = \"mat\", side = \"top\" }\nlength = 16\n";
    ReadRobot::parse("newtons.toml".into(), text, &FOLDER)
}

/// The contacts of a touch that lies over the seam, more of it on the first board.
fn told(robot: &ReadRobot) -> Vec<RobotContact> {
    let worlds = [3.2, -0.8].map(|row: f64| {
        let text = format!(
            "name = \"newtons\"\nduration_s = 60\n[idle]\nbase_code = 200\nnoise_counts = 2\n\
             [[touch]]\npanel = \"mat\"\nshape = \"ball\"\nsize_mm = {}\nforce_n = 6\nat = [7.3, {row}]\n\
             start_s = 0.2\nrise_s = 0.05\nhold_s = 60\n",
            4.0 * PITCH_MM
        );
        let script: Script = toml::from_str(&text).unwrap();
        World::build(&script, &scanning::panel([4, 16], [10_000; 2])).unwrap()
    });
    let mut boards = [0, 1].map(|number| {
        let (reader, garment) = (ScanReader::new(robot, number), scanning::panel([4, 16], [10_000; 2]));
        let times_us = [900 * number as u64, 5_000];
        let mut scanning = Scanning::new(&worlds[number], 0, garment, reader, Filter::default(), times_us);
        let calibration = &robot.boards[number].calibration;
        let requests = calibration.iter().flat_map(Calibration::requests);
        requests.for_each(|request| scanning.board.client().request(&request).unwrap());
        scanning
    });
    let mut contacts = RobotContacts::new(robot);
    let mut told = Vec::new();
    for scan in 0..200 {
        let (time, scans) = boards[scan % 2].scan();
        let now = BEGAN_US + time;
        told = scans
            .iter()
            .map(|told| contacts.scan(scan % 2, told, now))
            .find(|told| !told.is_empty())
            .unwrap_or(told);
    }
    told
}

#[test]
fn a_force_on_two_boards_is_the_sum_by_both_calibrations() {
    let told_now = told(&read([Some("one-force.toml"), Some("two-force.toml")]).unwrap());
    let [contact] = &told_now[..] else { panic!("{told_now:?}") };
    let parts: Vec<(usize, u32)> = contact.touch.parts.iter().map(|part| (part.board, part.total)).collect();
    let [(0, one), (1, two)] = parts[..] else { panic!("{parts:?}") };
    assert!(one > two && two > 200, "{one} {two}");
    let want: f64 = BOARDS.iter().zip([one, two]).map(|((_, each), n)| f64::from(n) / f64::from(*each)).sum();
    // The faint border belongs to the force, not to the pressure; the parts are told in whole counts.
    let newtons = contact.touch.newtons.unwrap();
    let rounding: f64 = BOARDS.iter().map(|(_, each)| 0.5 / f64::from(*each)).sum();
    assert!((want - rounding..1.05 * want).contains(&newtons), "{newtons} {want}");
}

#[test]
fn without_a_calibration_on_all_boards_there_is_no_force() {
    let told = told(&read([Some("one-force.toml"), None]).unwrap());
    let [contact] = &told[..] else { panic!("{told:?}") };
    assert_eq!((contact.touch.parts.len(), contact.touch.newtons), (2, None));
}

#[test]
fn a_calibration_of_another_garment_is_refused() {
    let error = read([Some("one-force.toml"), Some("other-force.toml")]).unwrap_err();
    let told = taxel::tell::words::sentence(&error);
    let why = "newtons.toml, line 10, `boards[1].calibration`: board two: the calibration ";
    assert!(
        told.starts_with(why) && told.ends_with("is of a garment of 12 taxels, this one has 64"),
        "{told}"
    );
}
