//! Forces of the contacts of a robot's boards, each by the calibration of its board.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use taxel::client::Event;
use taxel::files::calibrate::{Calibration, Curve, Fitted, ForceScale, Residuals, Rest};
use taxel::robot::{BoardContact, ReadRobot};
use taxel::virtual_board::VirtualBoard;
use taxel_core::condition::UNITY;
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout};
use taxel_core::scene::Scene;
use taxel_core::wire::Request;

const TAXELS: usize = 64;
/// Counts per newton that the boards' calibrations say.
const BOARDS: [(&str, u32); 2] = [("one", 1000), ("two", 500)];
/// Taxels that are pressed.
const PRESSED: [usize; 4] = [20, 21, 36, 37];

/// A straight line of so many counts per newton.
fn calibration(counts: u32, taxels: usize) -> Calibration {
    let layout = Layout::build(&Garment::block(), TAXELS, 4095).unwrap();
    let fitted = Fitted {
        gains: vec![UNITY; taxels],
        curves: vec![Some(Curve::new(vec![[16 * counts, 1_000_000]]).unwrap())],
        silent: Vec::new(),
        residuals: Residuals { error: 0.01, worst: 0.02, hysteresis: 0.01, noise: 0.01, rest: 0.0 },
        weights: Vec::new(),
    };
    let rest = Rest { codes: vec![200.0; taxels], noise: 2.0 };
    Calibration::of(fitted, &layout, &rest, ["block-4x16", "Anna", "plates of 5 N", "sim"])
}

/// The folder with the calibrations.
static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("newtons");
    std::fs::create_dir_all(&folder).unwrap();
    for (file, counts, taxels) in [("one", 1000, TAXELS), ("two", 500, TAXELS), ("other", 500, 12)] {
        let text = calibration(counts, taxels).text().unwrap();
        std::fs::write(folder.join(format!("{file}-force.toml")), text).unwrap();
    }
    folder
});

fn read(calibrations: [Option<&str>; 2]) -> taxel::Result<ReadRobot> {
    let mut text = "name = \"two\"\n".to_string();
    for ((name, _), calibration) in BOARDS.iter().zip(calibrations) {
        let calibration = calibration.map_or(String::new(), |file| format!("calibration = \"{file}\"\n"));
        text += &format!("[[boards]]\nname = \"{name}\"\nsource = \"sim:press\"\n{calibration}");
        text += "garment = \"block-4x16\"\n";
    }
    ReadRobot::parse("newtons.toml".into(), text, &FOLDER)
}

/// The contact of a board that is pressed on four taxels.
fn reported(robot: &ReadRobot, number: usize) -> BoardContact {
    let of = &robot.boards[number];
    let mut board = VirtualBoard::new(Garment::block(), Scene::shipped()).unwrap();
    board.client().weigh_by(ForceScale::new(of.calibration.clone(), None));
    let requests = of.calibration.iter().flat_map(Calibration::requests);
    requests.chain([Request::Tare { frames: 8 }]).for_each(|it| board.client().request(&it).unwrap());
    let (mut codes, mut reported) = (vec![200; TAXELS], Vec::new());
    for scan in 0..40 {
        if scan == 20 {
            PRESSED.into_iter().for_each(|taxel| codes[taxel] += 700);
        }
        let mut hear = |client: &taxel::client::Client, event: &Event| {
            reported = BoardContact::all(client, event).unwrap_or_else(|| std::mem::take(&mut reported));
            Ok(())
        };
        board.step(&codes, Micros(5_000 * scan), &mut hear).unwrap();
    }
    let [contact] = &reported[..] else { panic!("{reported:?}") };
    contact.clone()
}

#[test]
fn a_contact_has_the_force_that_its_boards_calibration_says() {
    let robot = read([Some("one-force.toml"), Some("two-force.toml")]).unwrap();
    for (number, (name, counts)) in BOARDS.into_iter().enumerate() {
        let contact = reported(&robot, number);
        let newtons = contact.newtons_per_count.unwrap() * f64::from(contact.total);
        let want = f64::from(contact.total) / f64::from(counts);
        assert!(contact.total > 2_000 && (newtons / want - 1.0).abs() < 0.01, "{name}: {newtons} {want}");
    }
}

#[test]
fn without_a_calibration_of_its_board_a_contact_has_no_force() {
    let robot = read([Some("one-force.toml"), None]).unwrap();
    assert!(
        reported(&robot, 0).newtons_per_count.is_some() && reported(&robot, 1).newtons_per_count.is_none()
    );
}

#[test]
fn a_calibration_of_another_garment_is_refused() {
    let error = read([Some("one-force.toml"), Some("other-force.toml")]).unwrap_err();
    let reported = taxel::text::words::sentence(&error);
    let why = "newtons.toml, line 10, `boards[1].calibration`: board two: the calibration ";
    assert!(
        reported.starts_with(why) && reported.ends_with("is of a garment of 12 taxels, this one has 64"),
        "{reported}"
    );
}
