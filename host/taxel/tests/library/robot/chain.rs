//! Three boards in a chain, whose panels differ in pitch and scan at times of their own: one touch lies over
//! both seams at once.

use super::scanning::{self, BEGAN_US, Scanning};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use taxel::robot::{ReadRobot, RobotContact, RobotContacts, ScanReader};
use taxel_core::condition::Filter;
use taxel_core::contact::Phase;
use taxel_core::garment::Garment;
use taxel_sim::{Script, World};

/// Name, blocks of four rows, distance of the rows, mm, times of the first scan and between two, us.
const BOARDS: [(&str, u16, f64, [u64; 2]); 3] =
    [("upper", 4, 5.0, [900, 5_100]), ("middle", 1, 8.0, [0, 8_300]), ("lower", 4, 10.0, [3_000, 12_500])];
/// Distance of the columns of all panels, mm.
const COLUMN_MM: f64 = 5.0;
/// Begin, speed and end of the touch: s, mm/s, s.
const TOUCH: [f64; 3] = [0.3, 100.0, 1.7];
/// Depth of the touch in the upper panel when it begins, mm.
const FROM_MM: f64 = 25.0;

/// A garment of one panel of 16 columns.
fn garment(blocks: u16, row_mm: f64) -> Garment {
    scanning::panel([4 * blocks, 16], [COLUMN_MM, row_mm].map(|mm| (mm * 1000.0) as u32))
}

fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("chain");
    std::fs::create_dir_all(&folder).unwrap();
    for (name, blocks, row_mm, _) in BOARDS {
        let text = toml::to_string(&garment(blocks, row_mm)).unwrap();
        std::fs::write(folder.join(format!("{name}.toml")), text).unwrap();
    }
    folder
}

/// The robot: the boards' panels, from top to bottom.
fn robot() -> ReadRobot {
    let mut text = "name = \"chain\"\n".to_string();
    for (name, ..) in BOARDS {
        text +=
            &format!("[[boards]]\nname = \"{name}\"\nsource = \"sim:press\"\ngarment = \"{name}.toml\"\n");
    }
    for [above, below] in [["upper", "middle"], ["middle", "lower"]] {
        let edge = |board: &str, side: &str| {
            format!("{{ board = \"{board}\", panel = \"mat\", side = \"{side}\" }}")
        };
        let [a, b] = [edge(above, "bottom"), edge(below, "top")];
        text += &format!("[[seams]]\na = {a}\nb = {b}\nlength = 16\n");
    }
    ReadRobot::parse("chain.toml".into(), text, &folder()).unwrap()
}

/// Place of the upper edge of each panel, mm.
fn tops() -> [f64; 3] {
    let mut at = 0.0;
    BOARDS.map(|(_, blocks, row_mm, _)| {
        at += f64::from(4 * blocks) * row_mm;
        at - f64::from(4 * blocks) * row_mm
    })
}

/// The touch as one board's panel sees it: 60 mm long, more than the middle panel.
fn world(number: usize) -> World {
    let (_, blocks, row_mm, _) = BOARDS[number];
    let [start_s, mm_s, end_s] = TOUCH;
    // From the centre of the panel's first taxel.
    let y_mm = FROM_MM - tops()[number] - row_mm / 2.0;
    let text = format!(
        "name = \"chain\"\nduration_s = 60\n[idle]\nbase_code = 200\nnoise_counts = 2\n\
         [[touch]]\npanel = \"mat\"\nshape = \"palm\"\nsize_mm = [40, 60]\nforce_n = 12\nat_mm = [37.5, {y_mm}]\n\
         velocity = [0, {}]\nstart_s = {start_s}\nrise_s = 0.05\nhold_s = {}\nfall_s = 0.05\n",
        mm_s / row_mm,
        end_s - start_s - 0.1
    );
    let script: Script = toml::from_str(&text).unwrap();
    World::build(&script, &garment(blocks, row_mm)).unwrap()
}

#[test]
fn a_touch_over_two_seams_is_one_contact_in_its_place() {
    let robot = robot();
    let worlds = [0, 1, 2].map(world);
    let mut boards = [0, 1, 2].map(|number| {
        let (_, blocks, row_mm, times_us) = BOARDS[number];
        let reader = ScanReader::new(&robot, number);
        Scanning::new(&worlds[number], 0, garment(blocks, row_mm), reader, Filter::default(), times_us)
    });
    let mut contacts = RobotContacts::new(&robot);
    let mut told: Vec<(u64, RobotContact)> = Vec::new();
    while boards.iter().any(|board| (board.next_us as f64) < (TOUCH[2] + 0.2) * 1e6) {
        let next = (0..3).min_by_key(|number| boards[*number].next_us).unwrap();
        let (time, scans) = boards[next].scan();
        for scan in scans {
            let now = BEGAN_US + time;
            told.extend(contacts.scan(next, &scan, now).into_iter().map(|contact| (now, contact)));
        }
    }
    let ids: BTreeSet<u32> = told.iter().map(|(_, contact)| contact.id).collect();
    assert_eq!(ids, [1].into());
    assert_eq!(told.iter().filter(|(_, contact)| contact.phase == Phase::Released).count(), 1);
    let boards_of =
        |contact: &RobotContact| contact.touch.parts.iter().map(|part| part.board).collect::<BTreeSet<_>>();
    let over_both = told.iter().filter(|(_, contact)| boards_of(contact).len() == 3).count();
    assert!(over_both > 50, "{over_both}");
    // While it is held, its centroid and its force are those of the touch.
    let (mut sum, mut worst_mm): (Vec<f64>, f64) = (Vec::new(), 0.0);
    let [start_s, mm_s, end_s] = TOUCH;
    for (_, contact) in &told {
        let at_s = (contact.touch.host_us - BEGAN_US) as f64 / 1e6 - start_s;
        let y_mm = FROM_MM + mm_s * at_s;
        let is_whole = y_mm > 32.0 && y_mm < tops()[2] + 160.0 - 32.0;
        if contact.phase != Phase::Held || at_s < 0.08 || at_s > end_s - start_s - 0.08 || !is_whole {
            continue;
        }
        let (_, _, row_mm, _) = BOARDS[contact.touch.board];
        let told_mm = tops()[contact.touch.board] + (contact.touch.centroid[1] + 0.5) * row_mm;
        worst_mm = worst_mm.max((told_mm - y_mm).abs());
        sum.push(f64::from(contact.touch.total));
    }
    let mean = sum.iter().sum::<f64>() / sum.len() as f64;
    let off = sum.iter().map(|total| (total / mean - 1.0).abs()).fold(0.0, f64::max);
    println!(
        "{} lists, {over_both} over both seams: centroid {worst_mm:.2} mm off, force {:.1} %",
        sum.len(),
        100.0 * off
    );
    assert!(sum.len() > 200 && worst_mm <= 2.0 && off <= 0.05);
}
