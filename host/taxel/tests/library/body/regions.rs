//! Named regions of the surface: which taxels they hold, contacts, and what is refused.

use std::path::Path;
use std::sync::Arc;
use taxel::body::robot;
use taxel::body::{self, Body, Surface};
use taxel::error::Result;
use taxel_core::garment::{Garment, Layout};

const OUTER: &str = "[[regions]]
name = \"left upper arm, outer\"
link = \"left_upper_arm\"
within.sector = { at = [0, 0, 0], axis = [0, 0, -1], along = [0, 0.5], facing = [0, 1, 0], around = [-60, 60] }
";
const HEART: &str = "[[regions]]
name = \"heart\"
link = \"torso\"
within.box = { from = [0, 0, 0.2], to = [0.1, 0.05, 0.3] }
";

fn surfaced(regions: &str) -> Result<(Surface, Layout)> {
    let garment = Garment::reference();
    let layout = Layout::build(&garment, 2048, 4095).unwrap();
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(
        format!("regions-{}-{:?}.toml", std::process::id(), std::thread::current().id())
            .replace(['(', ')'], ""),
    );
    let text = include_str!("../../../bodies/reference.toml").to_string() + "\n" + regions;
    std::fs::write(&path, text).unwrap();
    let read = body::read(path.to_str().unwrap()).unwrap();
    std::fs::remove_file(&path).unwrap();
    Ok((read.surface(&garment, &layout)?, layout))
}

/// Each taxel is in the region in whose solid its place is, by the solid's own formula here.
#[test]
fn a_region_holds_the_taxels_of_its_solid() {
    let (surface, _) = surfaced(&format!("{OUTER}{HEART}")).unwrap();
    assert_eq!(surface.regions(), ["left upper arm, outer", "heart"]);
    let mut counts = [0; 3];
    for place in surface.places().iter().flatten() {
        let [x, y, z] = place.at.to_array();
        let link = surface.links()[place.link].as_str();
        // A third of a turn about y; with the axis down, angles to the right go towards -x.
        let outer = link == "left_upper_arm" && x.abs() < y * 3f64.sqrt();
        let heart = link == "torso" && x >= 0.0 && (0.0..0.05).contains(&y) && (0.2..0.3).contains(&z);
        let name =
            [outer, heart].iter().position(|holds| *holds).map(|at| ["left upper arm, outer", "heart"][at]);
        assert_eq!(surface.region(place), name, "{place:?}");
        counts[name.map_or(2, |name| usize::from(name == "heart"))] += 1;
    }
    assert_eq!([surface.of_region(0).len(), surface.of_region(1).len()], counts[..2]);
    assert!(counts.iter().all(|count| *count > 30), "{counts:?}");
}

/// A side of an angle is the side to which columns run.
#[test]
fn angles_run_as_columns_do() {
    let right = OUTER.replace("[-60, 60]", "[0, 60]");
    let (surface, layout) = surfaced(&right).unwrap();
    let base = usize::from(layout.areas()[2].base);
    let columns: Vec<usize> = surface.of_region(0).iter().map(|taxel| (taxel - base) % 16).collect();
    assert!(!columns.is_empty() && columns.iter().all(|column| *column >= 8), "{columns:?}");
    // A turn further is the same.
    for other in ["[360, 420]", "[-360, -300]"] {
        let Ok((again, _)) = surfaced(&right.replace("[0, 60]", other)) else { continue };
        assert_eq!(again.of_region(0), surface.of_region(0), "{other}");
    }
}

/// A contact has the region of the taxel that is nearest, in the frame of any link.
#[test]
fn a_contact_has_the_name_of_its_region() {
    let (surface, layout) = surfaced(&format!("{OUTER}{HEART}")).unwrap();
    for panel in 0..4 {
        for (x, y) in [(3.4, 20.7), (7.6, 10.2), (8.0, 3.0), (9.5, 12.9)] {
            let place = surface.at(&layout, panel, x, y).unwrap();
            let taxel = usize::from(panel) * 512 + (y.round() as usize) * 16 + x.round() as usize;
            let nearest = surface.places()[taxel].unwrap();
            // Half way between two columns either is the nearest.
            if x.fract() != 0.5 {
                assert_eq!(surface.region(&place), surface.region(&nearest), "{panel} {x} {y}");
            }
        }
    }
    let body: Body =
        toml::from_str(&(include_str!("../../../bodies/reference.toml").to_string() + "\n" + OUTER)).unwrap();
    let robot = Arc::new(robot::read("reference").unwrap());
    let surfaced = body::RobotSurface::build(&body, &Garment::reference(), &layout, robot.clone()).unwrap();
    let posture = robot.posture_of("left_shoulder_roll=90deg").unwrap();
    let seen = surfaced.seen_from(&posture, 0).unwrap();
    assert_eq!(seen.of_region(0), surfaced.surface().of_region(0));
    let contact = seen.at(&layout, 2, 7.6, 10.2).unwrap();
    assert_eq!(seen.region(&contact), Some("left upper arm, outer"));
}

#[test]
fn regions_that_cannot_be_are_reported_with_file_line_and_name() {
    let why = |regions: &str| {
        let reported = format!("{:#}", surfaced(regions).err().unwrap());
        reported.split_once(".toml, ").unwrap().1.to_string()
    };
    // The reference body has 20 lines.
    for (regions, what) in [
        (
            format!("{OUTER}{HEART}").replace("\"heart\"", "\"left upper arm, outer\""),
            "line 27, `regions[1].name`: is that of another region already: \"left upper arm, outer\"",
        ),
        (HEART.replace("\"heart\"", "\" \""), "line 23, `regions[0].name`: must not be empty"),
        (
            HEART.replace("torso", "tors"),
            "line 24, `regions[0].link`: of region \"heart\" must be one that panels lie on: there is no link \"tors\": did you mean \"torso\"? Known are torso, left_upper_arm, right_upper_arm",
        ),
        (
            HEART.replace("0.3]", "0.1]"),
            "line 25, `regions[0].within.box.to`: of region \"heart\" must be above `from` in each coordinate",
        ),
        (
            HEART.replace("[0.1, ", "[0.01, "),
            "line 25, `regions[0].within`: of region \"heart\" must hold a taxel of torso",
        ),
        (
            format!("{HEART}{}", HEART.replace("heart", "breast")),
            "line 29, `regions[1].within`: of region \"breast\" must not hold taxel 104: region \"heart\" does",
        ),
        (
            OUTER.replace("[-60, 60]", "[60, -60]"),
            "line 25, `regions[0].within.sector.around`: of region \"left upper arm, outer\" must be two angles from -360 to 360 degrees, the least first, at most a turn apart",
        ),
        (
            OUTER.replace("[-60, 60]", "[0, 361]"),
            "line 25, `regions[0].within.sector.around`: of region \"left upper arm, outer\" must be two angles from -360 to 360 degrees, the least first, at most a turn apart",
        ),
        (
            OUTER.replace("[0, 0.5]", "[0.5, inf]"),
            "line 25, `regions[0].within.sector.along`: of region \"left upper arm, outer\" must be two lengths, the least first",
        ),
        (
            OUTER.replace("[0, 1, 0]", "[0, 0, 1]"),
            "line 25, `regions[0].within.sector.facing`: of region \"left upper arm, outer\" must be a direction across `axis`",
        ),
    ] {
        assert_eq!(why(&regions), what);
    }
}
