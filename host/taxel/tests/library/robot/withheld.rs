//! What a board's filter withholds at a seam counts as far as more presses beyond it.

use super::scanning::{self, BEGAN_US};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use taxel::robot::{BoardScan, BoardTouch, ReadRobot, RobotContact, RobotContacts, SeamValue};
use taxel_core::condition::WithheldTaxel;
use taxel_core::garment::Rect;

/// Columns of a panel of four rows.
const COLUMNS: u16 = 16;

static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("withheld");
    std::fs::create_dir_all(&folder).unwrap();
    let garment = toml::to_string(&scanning::panel([4, COLUMNS], [10_000; 2])).unwrap();
    std::fs::write(folder.join("panel.toml"), garment).unwrap();
    folder
});

/// The right side of board `one` is sewn to the left side of board `two`, row by row.
fn contacts() -> RobotContacts {
    let board =
        |name| format!("[[boards]]\nname = \"{name}\"\nsource = \"sim:press\"\ngarment = \"panel.toml\"\n");
    let text = format!(
        "name = \"two\"\n{}{}[[seams]]\na = {{ board = \"one\", panel = \"mat\", side = \"right\" }}\n\
         b = {{ board = \"two\", panel = \"mat\", side = \"left\" }}\nlength = 4\n",
        board("one"),
        board("two")
    );
    RobotContacts::new(&ReadRobot::parse("withheld.toml".into(), text, &FOLDER).unwrap())
}

fn taxel(row: u16, column: u16) -> u16 {
    row * COLUMNS + column
}

/// A contact of a board on some columns of rows 1 and 2.
fn touch(left: u16, right: u16, total: u32, peak: u16) -> BoardTouch {
    BoardTouch {
        contact: Some(1),
        begins: false,
        panel: 0,
        total,
        peak,
        area: 2 * (right + 1 - left),
        bounds: Rect { panel: 0, top: 1, bottom: 2, left, right },
        centroid: [f64::from(left + right) / 2.0, 1.5],
        velocity: [0.0; 2],
        newtons_per_count: None,
    }
}

/// A contact on the last columns of board `one`, with what its filter withheld.
fn on_one(withheld: &[WithheldTaxel]) -> BoardScan {
    BoardScan {
        contacts: Some(vec![touch(14, 15, 1_000, 400)]),
        withheld: withheld.to_vec(),
        ..BoardScan::default()
    }
}

/// A contact on the first columns of board `two`.
fn on_two() -> BoardScan {
    BoardScan { contacts: Some(vec![touch(0, 1, 2_000, 700)]), ..BoardScan::default() }
}

/// The image of board `two`, which presses on these taxels at the seam.
fn image(pressed: &[(u16, u16)]) -> BoardScan {
    let value =
        |(taxel, value): &(u16, u16)| (*taxel, SeamValue { told: *value, value: *value, beside: u16::MAX });
    let edge = Some(pressed.iter().map(value).collect());
    BoardScan { faint: Some(Vec::new()), edge, ..BoardScan::default() }
}

fn total(told: &[RobotContact]) -> u32 {
    let [contact] = told else { panic!("{told:?}") };
    contact.touch.total
}

/// Total of both together, scanned at one time, when board `two` presses so at the seam, and the filter of board `one` withheld this.
fn told(pressed: &[(u16, u16)], withheld: WithheldTaxel) -> u32 {
    let mut contacts = contacts();
    contacts.scan(1, &on_two(), BEGAN_US);
    contacts.scan(1, &image(pressed), BEGAN_US);
    total(&contacts.scan(0, &on_one(&[withheld]), BEGAN_US))
}

#[test]
fn as_much_counts_as_presses_beside_it_beyond_the_seam() {
    let withheld = WithheldTaxel { taxel: taxel(1, 15), value: 900, filtered: 100 };
    for (row, counts) in [(0, 400), (1, 400), (2, 400), (3, 0)] {
        assert_eq!(told(&[(taxel(row, 0), 500)], withheld), 3_000 + counts, "row {row}");
    }
    assert_eq!(told(&[(taxel(1, 0), 5_000)], withheld), 3_800, "no more than presses");
    assert_eq!(told(&[(taxel(1, 0), 90)], withheld), 3_000, "no less than is told");
    let inside = WithheldTaxel { taxel: taxel(1, 0), ..withheld };
    assert_eq!(told(&[(taxel(1, 0), 500)], inside), 3_000, "at another edge");
    let nowhere = WithheldTaxel { taxel: u16::MAX, ..withheld };
    assert_eq!(told(&[(taxel(1, 0), 500)], nowhere), 3_000, "there is no such taxel");
    let away = WithheldTaxel { taxel: taxel(3, 15), ..withheld };
    assert_eq!(told(&[(taxel(3, 0), 500)], away), 3_400, "beside the contact's corner");
}

#[test]
fn until_the_image_comes_it_is_at_most_what_the_contact_beyond_presses() {
    let mut contacts = contacts();
    let withheld = [WithheldTaxel { taxel: taxel(1, 15), value: 900, filtered: 100 }];
    contacts.scan(0, &on_one(&withheld), BEGAN_US);
    // Board `two` is heard later, and tells what pressed when board `one` withheld.
    assert_eq!(total(&contacts.scan(1, &on_two(), BEGAN_US)), 2_000 + 1_000 + 600);
}

/// What the image of board `one` tells of the taxel at its seam, whose neighbours press 300.
fn image_of_one(told: u16, value: u16) -> BoardScan {
    let edge = Some([(taxel(1, 15), SeamValue { told, value, beside: 300 })].into());
    BoardScan { faint: Some(Vec::new()), edge, ..BoardScan::default() }
}

#[test]
fn what_a_filter_restored_because_it_lacks_the_neighbours_beyond_does_not_count() {
    // In the first scan as much pressed beyond: over both panels, it stands out for the first time in the second.
    for (before, want) in [(900, 1_600), (0, 2_000)] {
        let mut contacts = contacts();
        contacts.scan(0, &on_one(&[]), BEGAN_US);
        contacts.scan(0, &image_of_one(300, 900), BEGAN_US);
        contacts.scan(1, &image(&[(taxel(1, 0), before)]), BEGAN_US);
        contacts.scan(0, &on_one(&[]), BEGAN_US + 5_000);
        contacts.scan(0, &image_of_one(900, 900), BEGAN_US + 5_000);
        contacts.scan(1, &image(&[(taxel(1, 0), 500)]), BEGAN_US + 5_000);
        let told = contacts.scan(1, &on_two(), BEGAN_US + 5_000);
        assert_eq!(total(&told), 1_000 + want, "{before}");
    }
}

#[test]
fn what_pressed_long_ago_or_on_a_lost_board_says_nothing() {
    let withheld = [WithheldTaxel { taxel: taxel(1, 15), value: 900, filtered: 100 }];
    for (later_us, want) in [(90_000, 1_400), (110_000, 1_000)] {
        let mut contacts = contacts();
        contacts.scan(1, &image(&[(taxel(1, 0), 500)]), BEGAN_US);
        assert_eq!(total(&contacts.scan(0, &on_one(&withheld), BEGAN_US + later_us)), want);
    }
    let mut contacts = contacts();
    contacts.scan(1, &image(&[(taxel(1, 0), 500)]), BEGAN_US + 120_000);
    contacts.forget(1, BEGAN_US + 125_000);
    assert_eq!(total(&contacts.scan(0, &on_one(&withheld), BEGAN_US + 130_000)), 1_000);
}

#[test]
fn what_is_withheld_where_nothing_touches_is_no_contact() {
    let withheld = vec![WithheldTaxel { taxel: taxel(1, 15), value: 4_000, filtered: 0 }];
    let mut contacts = contacts();
    contacts.scan(1, &on_two(), BEGAN_US);
    contacts.scan(1, &image(&[(taxel(1, 0), 500)]), BEGAN_US);
    let alone = BoardScan { contacts: Some(Vec::new()), withheld, ..BoardScan::default() };
    assert_eq!(total(&contacts.scan(0, &alone, BEGAN_US + 5_000)), 2_000);
}
