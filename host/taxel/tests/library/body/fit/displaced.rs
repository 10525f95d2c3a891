//! Garments on bodies of each kind, displaced from where their files say.

use crate::random::Noise;
use taxel::body::fit::{BodyFit, FeltTouch, KnownTouch};
use taxel::body::{self, DVec3, PatchOffset, ReadBody, Surface};
use taxel_core::garment::{Garment, Layout};

/// The garment, and the body file, without `offset`.
pub struct Case {
    pub name: &'static str,
    pub garment: Garment,
    pub body: String,
}

impl Case {
    pub fn layout(&self) -> Layout {
        Layout::build(&self.garment, 2048, 4095).unwrap()
    }

    /// Number of its patches, which are the garment's panels in their order.
    pub fn patches(&self) -> usize {
        self.body.matches("[[patches]]").count()
    }
}

fn mat(name: &'static str, on: &str) -> Case {
    Case { name, garment: Garment::mat(), body: format!("[[patches]]\npanel = \"mat\"\n{on}\n") }
}

/// The reference garment, and mats of 32 x 64 taxels on other surfaces.
pub fn cases() -> Vec<Case> {
    let reference = Case { name: "reference", garment: Garment::reference(), body: BODY.into() };
    let row = |z: f64| {
        let point = |y: f64| format!("[{:.4}, {y}, {z}]", 0.14 - 1.5 * y * y - 0.2 * z * z);
        format!("[{}]", [-0.15, -0.075, 0.0, 0.075, 0.15].map(point).join(", "))
    };
    let grid = [0.3, 0.15, 0.0, -0.15, -0.3].map(row).join(", ");
    vec![
        reference,
        mat("plane", "on.plane = { at = [0.4, -0.2, 1.1], normal = [1, 2, 3], down = [0, -3, 2] }"),
        mat(
            "cylinder",
            "turn = 20\non.cylinder = { at = [0, 0.1, 0.4], axis = [0, 0, -1], radius = 0.11, facing = [1, 0, 0] }",
        ),
        mat(
            "cone",
            "on.cone = { at = [0, 0, -0.16], axis = [0, 0, -1], radius = 0.15, angle = 7, facing = [0, 1, 0] }",
        ),
        mat("grid", &format!("on.grid = {{ points = [{grid}] }}")),
        mat("list", "on.taxels = \"list.txt\""),
    ]
}

const BODY: &str = include_str!("../../../../bodies/reference.toml");

/// A body file and its list, in a folder of its own.
pub fn read(case: &Case, run: &str, offsets: &[PatchOffset]) -> ReadBody {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!(
        "fit-{}-{}-{run}",
        std::process::id(),
        case.name
    ));
    std::fs::create_dir_all(&folder).unwrap();
    let listed = |y: f64, z: f64| {
        let at = DVec3::new(0.3 - y * y, y, z);
        let normal = DVec3::new(1.0, 2.0 * y, 0.0).normalize();
        format!("{:.6} {:.6} {:.6} {:.6} {:.6} {:.6}\n", at.x, at.y, at.z, normal.x, normal.y, normal.z)
    };
    let places =
        (0..2048).map(|taxel| ((taxel % 32) as f64 * 0.01 - 0.155, 0.315 - (taxel / 32) as f64 * 0.01));
    std::fs::write(folder.join("list.txt"), places.map(|(y, z)| listed(y, z)).collect::<String>()).unwrap();
    let mut text = case.body.clone();
    for (number, offsets) in offsets.iter().enumerate() {
        let PatchOffset { right, down, turn } = offsets;
        let at = text.match_indices("panel = ").nth(number).unwrap().0;
        text.insert_str(at, &format!("offset = {{ right = {right:?}, down = {down:?}, turn = {turn:?} }}\n"));
    }
    let path = folder.join("body.toml");
    std::fs::write(&path, text).unwrap();
    let read = body::read(path.to_str().unwrap()).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    read
}

/// Displaced by up to 20 mm and 5 degrees.
pub fn displaced_at_random(random: &mut Noise) -> PatchOffset {
    let mut within = |most: f64| random.range(-most, most);
    PatchOffset { right: within(0.014), down: within(0.014), turn: within(5.0) }
}

/// Distance of each taxel of a panel from where it truly is: the greatest.
pub fn worst(found: &Surface, truly: &Surface, layout: &Layout, panel: usize) -> f64 {
    let area = &layout.areas()[panel];
    let first = usize::from(area.base);
    let taxels = first..first + usize::from(area.rows) * usize::from(area.columns);
    let off = |taxel: usize| {
        let [found, truly] = [found, truly].map(|surface| surface.places()[taxel].unwrap().at);
        found.distance(truly)
    };
    taxels.map(off).fold(0.0, f64::max)
}

/// The surface with what was found.
pub fn surface_of(fit: &BodyFit, case: &Case) -> Surface {
    let offsets: Vec<PatchOffset> = fit.panels.iter().map(|panel| panel.offset).collect();
    let all = case.patches();
    assert_eq!(offsets.len(), all, "{}: {:?}", case.name, fit.few);
    read_again(case, &offsets)
}

pub fn read_again(case: &Case, offsets: &[PatchOffset]) -> Surface {
    let run = format!("{:?}", std::thread::current().id()).replace(['(', ')'], "-");
    read(case, &run, offsets).surface(&case.garment, &case.layout()).unwrap()
}

/// A touch at a place that is truly there, but for errors of the mark, m.
pub fn known(truly: &Surface, layout: &Layout, felt: FeltTouch, at: DVec3) -> KnownTouch {
    let area = &layout.areas()[usize::from(felt.panel)];
    let place = truly.places()[usize::from(area.base)].unwrap();
    let DVec3 { x, y, z } = at;
    let link = truly.links()[place.link].clone();
    KnownTouch { panel: area.name.to_string(), column: felt.x, row: felt.y, link, x, y, z }
}
