//! The board's surface, in fixed point, against the host's, in f64.

use crate::random::Noise;
use taxel::body::{self, Body, DVec3, Surface, wrenches};
use taxel::client::{Client, Event, SceneChange};
use taxel::session::setting;
use taxel::virtual_board::VirtualBoard;
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{Contact, ContactConfig, ContactState, Contacts};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout};
use taxel_core::health::{FaultyTaxel, TaxelHealth};
use taxel_core::scene::Scene;
use taxel_core::surface::{
    CARRIED_US, Landed, LinkFrames, LinkMotion, LinkName, LinkPose, ONE, Pose, Pressing, SurfaceState, Table,
    TaxelLimits, Wrench, table_bytes,
};
use taxel_core::wire::Request;

/// Bodies of different kinds, each for the mat or for the reference garment.
const BODIES: [(&str, &str); 5] = [
    (
        "mat",
        "[[patches]]\npanel = \"mat\"\non.plane = { at = [0.4, -0.2, 1.1], normal = [1, 2, 3], down = [0, -3, 2] }",
    ),
    (
        "mat",
        "[[patches]]\npanel = \"mat\"\non.cylinder = { at = [0, 0, 0.4], axis = [0, 0, -1], radius = 0.06, facing = [1, 0, 0] }",
    ),
    (
        "mat",
        "[[patches]]\npanel = \"mat\"\nturn = 30\non.cylinder = { at = [0.1, 0.3, 0], axis = [1, 0, 1], radius = 0.25, facing = [-1, 0, 1] }",
    ),
    (
        "mat",
        "[[patches]]\npanel = \"mat\"\non.cone = { at = [0, 0, -0.16], axis = [0, 0, -1], radius = 0.15, angle = 7, facing = [0, 1, 0] }",
    ),
    ("reference", ""),
];

struct Dressed {
    layout: Layout,
    surface: Surface,
    table: Vec<u8>,
}

fn dressed((garment, text): (&str, &str)) -> Dressed {
    let garment = if garment == "mat" { Garment::mat() } else { Garment::reference() };
    let body: Body =
        if text.is_empty() { body::read("reference").unwrap().body } else { toml::from_str(text).unwrap() };
    let layout = Layout::build(&garment, 2048, 65_535).unwrap();
    let surface = Surface::build(&body, &garment, &layout).unwrap();
    let table = body::table(&surface, &layout).unwrap();
    Dressed { layout, surface, table }
}

/// What a board says of an image.
struct Felt {
    contacts: Vec<Landed>,
    links: Vec<Wrench>,
}

/// What a board makes of an image; also the contacts.
fn felt(dressed: &Dressed, values: &[u16], frames: &LinkFrames) -> (Felt, Vec<Contact>) {
    let contacts = contacts(&dressed.layout, values);
    let table = Table::check(&dressed.table, &dressed.layout).unwrap();
    let mut pressing = Pressing::new();
    pressing.sum(&table, &contacts, &dressed.layout, [values; 2]);
    let owned = |wrench: Wrench<&str>| Wrench {
        link: wrench.link,
        name: LinkName::try_from(wrench.name).unwrap(),
        force: wrench.force,
        moment: wrench.moment,
        pressed: wrench.pressed,
        center: wrench.center,
    };
    let links = pressing.links(&table).map(owned).collect();
    (Felt { contacts: pressing.contacts(frames).collect(), links }, contacts.present().to_vec())
}

/// The contacts of an image, each taxel of which counts.
fn contacts(layout: &Layout, values: &[u16]) -> Box<ContactState<32, 1024, 512>> {
    let stage: Contacts = ContactConfig { low: 1, high: 2, ..ContactConfig::default() }.build().unwrap();
    let mut contacts = Box::new(ContactState::new());
    let image = Image { values, rows: &Rows::of(layout, values) };
    stage.process(&mut contacts, layout, &image, Micros(0));
    contacts
}

/// An image of a few presses, of up to `most` counts.
fn image(random: &mut Noise, layout: &Layout, most: f64) -> Vec<u16> {
    let mut values = vec![0.0f64; layout.taxels()];
    for _ in 0..1 + random.below(6) as usize {
        let area = &layout.areas()[random.below(layout.areas().len() as u64) as usize];
        let [x, y] = [area.columns, area.rows].map(|count| random.unit() * f64::from(count - 1));
        let [wide, high] = [0.7 + 4.0 * random.unit(), 0.7 + 4.0 * random.unit()];
        let peak = most * random.unit();
        for row in 0..area.rows {
            for column in 0..area.columns {
                let [dx, dy] = [(f64::from(column) - x) / wide, (f64::from(row) - y) / high];
                let taxel = area.base + row * area.columns + column;
                values[usize::from(taxel)] += peak * (-(dx * dx + dy * dy)).exp();
            }
        }
    }
    values.into_iter().map(|value| value.min(65_535.0) as u16).collect()
}

fn called(link: &str) -> LinkName {
    LinkName::try_from(link).unwrap()
}

fn metres(um: [i32; 3]) -> DVec3 {
    DVec3::from(um.map(|um| f64::from(um) * 1e-6))
}

/// Places within 0.1 mm, normals and forces within a thousandth, moments within a thousandth of the force
/// times one metre, and half a count: on every kind of body, at every height.
#[test]
fn contacts_and_wrenches_are_those_of_the_host() {
    let mut random = Noise(22);
    let mut worst = [0.0f64; 4];
    for kind in BODIES {
        let dressed = dressed(kind);
        for most in [40.0, 4000.0, 65_535.0] {
            for _ in 0..20 {
                let values = image(&mut random, &dressed.layout, most);
                let (pressing, contacts) = felt(&dressed, &values, &LinkFrames::NONE);
                assert_eq!(pressing.contacts.len(), contacts.len());
                for (landed, contact) in pressing.contacts.iter().zip(&contacts) {
                    let [x, y] = [contact.x, contact.y].map(|at| at.to_f64());
                    let want = dressed.surface.at(&dressed.layout, contact.panel, x, y).unwrap();
                    assert_eq!((landed.id, usize::from(landed.spot.link)), (contact.id, want.link));
                    worst[0] = worst[0].max((metres(landed.spot.at) - want.at).length());
                    let normal = DVec3::from(landed.spot.normal.map(|n| f64::from(n) / f64::from(ONE)));
                    worst[1] = worst[1].max((normal - want.normal).length());
                }
                // All taxels of contacts: an image of presses has a few that are of none.
                let touched = touched(&dressed.layout, &values, &contacts);
                let wanted = wrenches(&dressed.surface, &touched);
                for wrench in &pressing.links {
                    let want = &wanted[usize::from(wrench.link)];
                    assert_eq!(f64::from(wrench.pressed), want.pressed);
                    let force = DVec3::from(wrench.force.map(f64::from));
                    let moment = DVec3::from(wrench.moment.map(|m| m as f64 * 1e-3));
                    worst[2] = worst[2].max(((force - want.force).length() - 1.0).max(0.0) / want.pressed);
                    worst[3] = worst[3].max(((moment - want.moment).length() - 1.0).max(0.0) / want.pressed);
                }
                let pressed: f64 = wanted.iter().map(|wrench| wrench.pressed).sum();
                assert_eq!(pressing.links.iter().map(|w| f64::from(w.pressed)).sum::<f64>(), pressed);
            }
        }
    }
    println!(
        "place {:.1} um, normal {:.1e}, force {:.1e}, moment {:.1e} m",
        worst[0] * 1e6,
        worst[1],
        worst[2],
        worst[3]
    );
    assert!(worst[0] < 100e-6 && worst[1] < 1e-3 && worst[2] < 1e-4 && worst[3] < 1e-4, "{worst:?}");
}

/// The values of taxels that are of a contact.
fn touched(layout: &Layout, values: &[u16], contacts: &[Contact]) -> Vec<f64> {
    let total: u64 = contacts.iter().map(|contact| u64::from(contact.total)).sum();
    // Below two counts a component is none: the low threshold is 1, the high one 2.
    let all: u64 = values.iter().map(|value| u64::from(*value)).sum();
    if total == all {
        return values.iter().map(|value| f64::from(*value)).collect();
    }
    let state = self::contacts(layout, values);
    let of = |taxel: usize| state.contact_at(layout, layout.place(taxel).unwrap()).is_some();
    (0..values.len()).map(|taxel| if of(taxel) { f64::from(values[taxel]) } else { 0.0 }).collect()
}

/// Quaternion of a random rotation, as the wire carries it, and what it stands for.
fn rotation(random: &mut Noise) -> ([i32; 4], glam::DQuat) {
    let parts = [0; 4].map(|_| 2.0 * random.unit() - 1.0);
    let quaternion = glam::DQuat::from_array(parts).normalize();
    (quaternion.to_array().map(|part| (part * f64::from(1 << 30)).round() as i32), quaternion)
}

/// The board's path from taxel to base: at most 0.1 mm off, with links up to 2 m from each other.
#[test]
fn contacts_in_the_base_frame_are_within_a_tenth_of_a_millimetre() {
    let mut random = Noise(23);
    let (mut at, mut turned, mut pushed) = (0.0f64, 0.0f64, 0.0f64);
    for kind in BODIES {
        let dressed = dressed(kind);
        for _ in 0..40 {
            let values = image(&mut random, &dressed.layout, 4000.0);
            let mut state = SurfaceState::new();
            let links = dressed.surface.links().len();
            let poses: Vec<_> = (0..links)
                .map(|_| ([0; 3].map(|_| random.below(4_000_001) as i32 - 2_000_000), rotation(&mut random)))
                .collect();
            let reported = poses.iter().zip(dressed.surface.links());
            let reported: Vec<LinkPose> = reported
                .map(|((at, (turn, _)), link)| (called(link), Pose { at: *at, turn: *turn }, None))
                .collect();
            state.accept(&reported, &Table::view(&dressed.table).unwrap(), Micros(7)).unwrap();
            assert_eq!(state.updated(), Some(Micros(7)));
            let (pressing, contacts) = felt(&dressed, &values, &state.at(Micros(7)));
            for (landed, contact) in pressing.contacts.iter().zip(&contacts) {
                let [x, y] = [contact.x, contact.y].map(|at| at.to_f64());
                let want = dressed.surface.at(&dressed.layout, contact.panel, x, y).unwrap();
                let (origin, (_, turn)) = poses[want.link];
                let base = landed.base.unwrap();
                at = at.max((metres(base.at) - (metres(origin) + turn * want.at)).length());
                let normal = DVec3::from(base.normal.map(|n| f64::from(n) / f64::from(ONE)));
                turned = turned.max((normal - turn * want.normal).length());
                let force = turn * DVec3::from(landed.force.map(f64::from));
                pushed = pushed.max((DVec3::from(base.force.map(f64::from)) - force).length());
            }
        }
    }
    println!("place {:.1} um, normal {turned:.1e}, force {pushed:.2} counts", at * 1e6);
    assert!(at < 100e-6 && turned < 1e-3 && pushed < 1.0, "{at} {turned} {pushed}");
}

/// A link that moves is carried on as in f64, before and after the time of its pose, and the bound grows as it
/// says; no longer than 0.2 s.
#[test]
fn links_that_move_are_carried_on() {
    let (mut random, dressed) = (Noise(25), dressed(BODIES[1]));
    let table = Table::view(&dressed.table).unwrap();
    let mut worst = 0.0f64;
    for _ in 0..400 {
        let at = [0; 3].map(|_| random.below(2_000_001) as i32 - 1_000_000);
        let (turn, exact) = rotation(&mut random);
        let velocity = [0; 3].map(|_| random.below(4_000_001) as i32 - 2_000_000);
        let spin = [0; 3].map(|_| random.below(5 << 20) as i32 - (5 << 19));
        let motion = LinkMotion { velocity, spin, error: 500, drift: 3_000, acceleration: 2_000_000 };
        let mut state = SurfaceState::new();
        let reported = Micros(1_000_000);
        state.accept(&[(called("base"), Pose { at, turn }, Some(motion))], &table, reported).unwrap();
        let us = random.below(2 * u64::from(CARRIED_US) + 1) as i64 - i64::from(CARRIED_US);
        let frames = state.at(Micros(reported.0.wrapping_add_signed(us)));
        let seconds = us as f64 * 1e-6;
        let image = image(&mut random, &dressed.layout, 4000.0);
        let (reported, _) = felt(&dressed, &image, &frames);
        let turned = DVec3::from(spin.map(f64::from)) / f64::from(1 << 20) * seconds;
        for landed in &reported.contacts {
            let own = metres(landed.spot.at);
            let origin = metres(at) + metres(velocity) * seconds;
            let want = origin + glam::DQuat::from_scaled_axis(turned) * exact * own;
            worst = worst.max((metres(landed.base.unwrap().at) - want).length());
        }
        let bound = 500.0 + 3_000.0 * seconds.abs() + 1_000_000.0 * seconds * seconds;
        let (_, said) = frames.errors().next().unwrap();
        assert!((f64::from(said) - bound - 60.0).abs() < 2.0, "{said} {bound}");
        let late = state.at(Micros(1_000_001 + u64::from(CARRIED_US)));
        assert_eq!(late.errors().next(), None);
    }
    println!("places of links that move: {:.1} um", worst * 1e6);
    assert!(worst < 60e-6, "{worst}");
}

/// A press of which some taxels are taken away lies between the bounds that the others leave, and so does its
/// place; a taxel at the end of its range is counted.
#[test]
fn what_faulty_and_saturated_taxels_leave_unknown_is_bounded() {
    let (mut random, dressed) = (Noise(26), dressed(BODIES[4]));
    let table = Table::view(&dressed.table).unwrap();
    let (mut judged, mut held, mut placed) = (0, 0, 0);
    let mut widths = Vec::new();
    for _ in 0..400 {
        let whole = image(&mut random, &dressed.layout, 3000.0);
        let mut faulty = Vec::new();
        let mut values = whole.clone();
        for _ in 0..12 {
            let pressed: Vec<usize> = (0..whole.len()).filter(|taxel| whole[*taxel] > 50).collect();
            let Some(taxel) = pressed.get(random.below(pressed.len().max(1) as u64) as usize) else {
                continue;
            };
            if !faulty.iter().any(|it: &FaultyTaxel| usize::from(it.taxel) == *taxel) {
                faulty.push(FaultyTaxel { taxel: *taxel as u16, health: TaxelHealth::Dead, gain: 4096 });
                values[*taxel] = 0;
            }
        }
        let (truth, _) = felt(&dressed, &whole, &LinkFrames::NONE);
        let contacts = contacts(&dressed.layout, &values);
        let mut pressing = Pressing::new();
        pressing.sum(&table, &contacts, &dressed.layout, [&values; 2]);
        let senses = TaxelLimits { faulty: &faulty, ceiling: |_| u16::MAX };
        pressing.doubt(&table, &contacts, &dressed.layout, [&values; 2], &senses);
        let doubts: Vec<_> = pressing.doubts_of_links(&table).collect();
        for wrench in pressing.links(&table) {
            let Some(want) = truth.links.iter().find(|it| it.link == wrench.link) else { continue };
            let Some((_, doubt)) = doubts.iter().find(|(link, _)| *link == wrench.link) else { continue };
            let range = wrench.pressed - doubt.less..=wrench.pressed + doubt.more;
            judged += 1;
            held += u32::from(range.contains(&want.pressed));
            let off = (metres(want.center) - metres(wrench.center)).length();
            placed += u32::from(off <= f64::from(doubt.off) * 1e-6);
            widths.push(f64::from(doubt.less + doubt.more) / f64::from(want.pressed));
        }
    }
    widths.sort_by(f64::total_cmp);
    let median = widths[widths.len() / 2];
    println!(
        "{judged} links: force held {held}, centre held {placed}; the median range is {:.1} %",
        median * 1e2
    );
    assert!(judged > 300 && held * 100 >= judged * 95 && placed * 100 >= judged * 95);

    let whole = image(&mut random, &dressed.layout, 4000.0);
    let ceiling = whole.iter().max().unwrap() * 3 / 4;
    let values: Vec<u16> = whole.iter().map(|value| *value.min(&ceiling)).collect();
    let full = values.iter().filter(|value| **value == ceiling).count();
    let contacts = contacts(&dressed.layout, &values);
    let mut pressing = Pressing::new();
    pressing.sum(&table, &contacts, &dressed.layout, [&values; 2]);
    assert!(!pressing.is_in_doubt());
    let senses = TaxelLimits { faulty: &[], ceiling: |_| ceiling };
    pressing.doubt(&table, &contacts, &dressed.layout, [&values; 2], &senses);
    let of = |all: &mut dyn Iterator<Item = u16>| all.map(usize::from).sum::<usize>();
    let reported = of(&mut pressing.doubts_of_contacts(&table).map(|(_, it)| it.saturated));
    let by_link = of(&mut pressing.doubts_of_links(&table).map(|(_, it)| it.saturated));
    assert!(pressing.is_in_doubt() && full > 0);
    assert_eq!([reported, by_link], [full; 2]);
}

/// A table that is damaged anywhere is refused, and none of its readers panics.
#[test]
fn a_damaged_table_is_refused() {
    let dressed = dressed(BODIES[1]);
    let refusal =
        |bytes: &[u8], layout: &Layout| Table::check(bytes, layout).map(|_| ()).map_err(|e| e.to_string());
    assert_eq!(refusal(&dressed.table, &dressed.layout), Ok(()));
    assert_eq!(dressed.table.len(), table_bytes(2048));
    let other = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
    assert_eq!(refusal(&dressed.table, &other), Err("surface must be made for this garment".into()));
    let mut random = Noise(24);
    for _ in 0..400 {
        let mut bytes = dressed.table.clone();
        let at = random.below(bytes.len() as u64) as usize;
        bytes[at] ^= 1 << random.below(8);
        assert!(refusal(&bytes, &dressed.layout).is_err(), "byte {at}");
        if let Some(table) = Table::view(&bytes) {
            let _ = (0..=255).filter_map(|link| table.link(link)).count();
        }
    }
    for length in [0, 1, 15, 143, 144, 163, dressed.table.len() - 1, dressed.table.len() - 20] {
        let must = "surface must be a table of taxels, version 2";
        assert_eq!(refusal(&dressed.table[..length], &dressed.layout), Err(must.into()), "{length}");
    }
}

/// Poses that are none change nothing.
#[test]
fn a_pose_that_is_none_is_refused() {
    let (dressed, mut state) = (dressed(BODIES[1]), SurfaceState::new());
    let table = Table::view(&dressed.table).unwrap();
    let one = 1 << 30;
    let good = Pose { at: [1, 2, 3], turn: [0, 0, 0, one] };
    for (pose, link, why) in [
        (Pose { at: [100_000_001, 0, 0], ..good }, "base", "pose.at must be within 100 m"),
        (Pose { at: [i32::MIN; 3], ..good }, "base", "pose.at must be within 100 m"),
        (Pose { turn: [0; 4], ..good }, "base", "pose.turn must be a quaternion of length 1"),
        (Pose { turn: [i32::MIN; 4], ..good }, "base", "pose.turn must be a quaternion of length 1"),
        (Pose { turn: [one, 0, 0, one], ..good }, "base", "pose.turn must be a quaternion of length 1"),
        (good, "elbow", "pose.link must be a link of the surface"),
    ] {
        let refused = state
            .accept(&[(called("base"), good, None), (called(link), pose, None)], &table, Micros(1))
            .unwrap_err();
        assert_eq!((refused.to_string().as_str(), &state), (why, &SurfaceState::new()));
    }
    state.accept(&[(called("base"), good, None)], &table, Micros(1)).unwrap();
}

/// A body is sent to a board piece by piece, and the board says what presses where.
#[test]
fn a_board_takes_a_body_and_says_what_presses_on_it() {
    let garment = Garment::reference();
    let mut board = VirtualBoard::new(garment.clone(), Scene::shipped()).unwrap();
    let (mut codes, mut frame) = (vec![100; board.taxels()], 0);
    let (mut answers, mut pressed) = (Vec::new(), Vec::new());
    let mut steps = |board: &mut VirtualBoard, codes: &[u16], count: u64| {
        for _ in 0..count {
            frame += 1;
            let mut reported = |_: &Client, event: &Event| {
                match event {
                    Event::Answer { request, refusal } => answers.push((*request, refusal.clone())),
                    Event::Pressing(report) => pressed.push(report.clone()),
                    _ => {}
                }
                Ok(())
            };
            board.step(codes, Micros(frame * 5_128), &mut reported).unwrap();
        }
    };
    setting::set_body(board.client(), "reference", "reference").unwrap();
    board.client().change_scene(SceneChange::pressing(u16::MAX));
    board.client().request(&Request::Tare { frames: 16 }).unwrap();
    steps(&mut board, &codes, 250);
    let turn = [0.0, 0.0, 0.5f64.sqrt(), 0.5f64.sqrt()];
    setting::set_poses(board.client(), [("torso", [0.0, 0.0, 1.0], turn)]).unwrap();
    // A fingertip in the middle of the chest.
    for taxel in [263, 264, 279, 280] {
        codes[taxel] += 500;
    }
    steps(&mut board, &codes, 10);
    let surface = Request::SetTable(&[]).number();
    let pieces = table_bytes(2048).div_ceil(256);
    assert_eq!(answers.iter().filter(|(request, _)| *request == surface).count(), pieces);
    assert!(answers.iter().all(|(_, refusal)| refusal.is_none()), "{answers:?}");
    let last = pressed.last().unwrap();
    let ([contact], [torso]) = (&last.contacts[..], &last.links[..]) else { panic!("{last:?}") };
    assert_eq!((torso.name.as_str(), torso.pressed, torso.center), ("torso", 2000, contact.spot.at));
    let (own, base) = (metres(contact.spot.at), metres(contact.base.unwrap().at));
    assert!((base - DVec3::new(-own.y, own.x, own.z + 1.0)).length() < 5e-6, "{own} {base}");
    for (link, at, turn, why) in [
        ("l".repeat(41).as_str(), [0.0; 3], turn, "its name is longer than 40 bytes"),
        ("torso", [f64::NAN, 0.0, 0.0], turn, "its origin must be within 100 m"),
        ("torso", [0.0; 3], [0.0; 4], "its quaternion must have a length"),
    ] {
        let refused = setting::set_poses(board.client(), [(link, at, turn)]).unwrap_err();
        assert_eq!(refused.to_string(), format!("the pose of {link}: {why}"));
    }
}
