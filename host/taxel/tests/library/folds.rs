//! What the garment's folds press: learned from scripts of bending arms, subtracted by the board.

use crate::random::Noise;
use std::path::PathBuf;
use taxel::client::{Client, Event, ImageNews};
use taxel::error::{ErrorKind, LearnError};
use taxel::files::scripts;
use taxel::learn::folds::{FoldSettings, FoldSweep, LearnedFolds, learn};
use taxel::session::setting;
use taxel::sim::{FRAME_PERIOD_US, Player, Script};
use taxel::virtual_board::VirtualBoard;
use taxel_core::fold::{FoldTable, JointAngle, Posture};
use taxel_core::format::Micros;
use taxel_core::garment::Layout;
use taxel_core::intent::Leading;
use taxel_core::scene::Scene;
use taxel_core::wire::{FoldsReport, Request};

/// The shipped script of a bending arm as on another day: ridges elsewhere, of another force, bent at another
/// pace.
fn bending(day: u64) -> Script {
    let mut script = scripts::load("elbow").expect("built in");
    let mut random = Noise(day);
    let mut drawn = |from: f64, to: f64| from + (to - from) * random.unit();
    let (rise, hold, fall) = (drawn(0.6, 1.4), drawn(0.2, 0.6), drawn(0.6, 1.4));
    let (along, across, force) = (drawn(-0.8, 0.8), drawn(-0.8, 0.8), drawn(0.85, 1.15));
    script.seed = day;
    script.duration_s = 0.4 + rise + hold + fall;
    for joint in &mut script.joints {
        (joint.rise_s, joint.hold_s, joint.fall_s) = (rise, hold, Some(fall));
    }
    for touch in &mut script.touches {
        (touch.rise_s, touch.hold_s, touch.fall_s) = (rise, hold, fall);
        touch.force_n *= force;
        touch.at = touch.at.map(|[x, y]| [x + across, y + along]);
    }
    script
}

/// What a board says of a script.
#[derive(Default)]
struct Seen {
    sweep: FoldSweep,
    contacts: Vec<(u64, u32, u32)>,
    leading: Vec<Leading>,
    reported: Vec<FoldsReport>,
}

fn layout(script: &Script) -> Layout {
    Layout::build(&scripts::garment(script).expect("it is a preset"), 2048, 4095).expect("it is checked")
}

/// Plays a script to a board that is sent the angles at 50 Hz, with a table in force or none.
fn play(script: &Script, folds: Option<&LearnedFolds>) -> Seen {
    let garment = scripts::garment(script).expect("it is a preset");
    let mut board = VirtualBoard::new(garment.clone(), Scene::shipped()).expect("they fit");
    let mut player = Player::new(script, &garment).expect("the script is checked");
    let mut codes = vec![0u16; board.taxels()];
    let mut seen = Seen { sweep: FoldSweep::new(vec!["left_elbow".into()], codes.len()), ..Seen::default() };
    let frames = (script.duration_s * 1e6) as u64 / FRAME_PERIOD_US;
    let begin = beginning(script, folds);
    board.client().request(&Request::Tare { frames: script.tare_frames as u16 }).expect("it fits");
    let mut angle = 0.0;
    for step in 0..begin + frames {
        let time = step * FRAME_PERIOD_US;
        let start = step.saturating_sub(begin) * FRAME_PERIOD_US;
        if let Some(folds) = folds.filter(|_| step == TARED + u64::from(script.tare_frames)) {
            setting::set_folds(board.client(), &written(folds)).expect("it is a table");
        }
        player.frame(start, &mut codes);
        if step % 4 == 0 {
            angle = script.posture(start as f64 / 1e6).map(|(_, angle)| angle).next().expect("it bends");
            let joint = JointAngle { joint: 0, centidegrees: (100.0 * angle) as i16 };
            let posture = Posture { joints: [joint].into_iter().collect() };
            board.client().request(&Request::Posture(posture)).expect("it fits");
        }
        board
            .step(&codes, Micros(time), &mut |client, event| {
                match event {
                    Event::Frame { image: ImageNews::Whole, .. } if step > begin => {
                        let image = client.image().expect("it is whole").1;
                        seen.sweep.push(&[angle as f32], image)?;
                    }
                    // Before the tare the garment at rest looks like a touch.
                    Event::Contacts { .. } if step > begin => {
                        let reported =
                            client.contacts().iter().map(|it| (time, it.contact.id, it.contact.total));
                        seen.contacts.extend(reported);
                    }
                    Event::Intent(report) if step > begin => seen.leading.push(report.leading),
                    Event::Folds(report) => seen.reported.push((**report).clone()),
                    Event::Answer { refusal: Some(why), .. } => panic!("{why}"),
                    _ => {}
                }
                Ok(())
            })
            .expect("the codes are of this garment");
    }
    assert!(
        folds.is_none() || seen.reported.last().is_some_and(|reported| reported.followed),
        "no table in force"
    );
    seen
}

/// Frames after a tare in which a touch that was none ends, and means nothing any more.
const TARED: u64 = 200;

/// Frames before the script: the board is tared, and stores the table, a piece with each frame.
fn beginning(script: &Script, folds: Option<&LearnedFolds>) -> u64 {
    let storing = folds.map_or(0, |folds| folds.table.len() as u64 / 256 + 4);
    TARED + u64::from(script.tare_frames) + storing
}

/// The table in a file.
fn written(folds: &LearnedFolds) -> PathBuf {
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("elbow.folds");
    std::fs::write(&file, &folds.table).expect("the folder of tests is there");
    file
}

fn learned() -> LearnedFolds {
    let sweeps: Vec<FoldSweep> = (1..=6).map(|day| play(&bending(day), None).sweep).collect();
    learn(&layout(&bending(1)), &sweeps, &FoldSettings::default()).expect("it folds")
}

#[test]
fn a_bending_arm_is_no_touch_and_a_hand_on_it_is() {
    let folds = learned();
    let [fold] = &folds.folds[..] else { panic!("{:?}", folds.folds) };
    println!("{fold:?}");
    assert_eq!(fold.joints, ["left_elbow"]);
    assert!(fold.explained > 0.9, "{fold:?}");

    // The script that ships, and days that nobody has learned from.
    let others = (21..=26).map(bending).chain([scripts::load("elbow").expect("built in")]);
    for script in others {
        assert!(!play(&script, None).contacts.is_empty(), "without the table it is a touch");
        let seen = play(&script, Some(&folds));
        assert_eq!(seen.contacts, [], "seed {}", script.seed);
        assert!(seen.leading.iter().all(|leading| *leading == Leading::None), "{:?}", seen.leading);
    }

    // A palm of 12 N on the bent arm, beside and on the ridges.
    for (seed, row) in [(31, 6.0), (32, 12.0), (33, 16.0), (34, 19.5)] {
        let mut script = bending(seed);
        let elbow = &script.joints[0];
        let (bent_s, hold_s) = (elbow.start_s + elbow.rise_s, 1.6);
        script.joints[0].hold_s = hold_s;
        script.touches.iter_mut().for_each(|ridge| ridge.hold_s = hold_s);
        let mut palm = script.touches[0].clone();
        (palm.shape, palm.size_mm, palm.force_n) = (taxel::sim::Shape::Ball, None, 12.0);
        palm.at = Some([7.5, row]);
        (palm.start_s, palm.rise_s, palm.hold_s, palm.fall_s) = (bent_s + 0.2, 0.2, 0.8, 0.2);
        script.duration_s += 1.6;
        script.touches.push(palm);
        let alone = {
            let mut alone = script.clone();
            alone.touches.drain(..2);
            let held = (bent_s + 0.6) * 1e6;
            let seen = play(&alone, None);
            total_at(&seen, held as u64, beginning(&alone, None))
        };
        let seen = play(&script, Some(&folds));
        let begin = beginning(&script, Some(&folds));
        let held = ((bent_s + 0.6) * 1e6) as u64;
        let felt = total_at(&seen, held, begin);
        let doubt = seen
            .reported
            .iter()
            .filter(|reported| reported.time.0 >= held + begin * FRAME_PERIOD_US)
            .find_map(|reported| reported.contacts.first().map(|it| it.doubt))
            .unwrap_or(0);
        println!("row {row}: {felt} of {alone} counts, doubt {doubt}");
        assert!(f64::from(felt.abs_diff(alone)) <= (0.1 * f64::from(alone)).max(doubt.into()), "{row}");
    }
}

/// Sum of the contacts at a time of the script.
fn total_at(seen: &Seen, at_us: u64, begin: u64) -> u32 {
    let from = at_us + begin * FRAME_PERIOD_US;
    let first = seen.contacts.iter().find(|(time, ..)| *time >= from).map_or(0, |(time, ..)| *time);
    seen.contacts.iter().filter(|(time, ..)| *time == first).map(|(.., total)| total).sum()
}

/// What is learned from one sweep to 100 degrees and back, of 600 frames each.
fn learned_once(felt: impl FnMut(f32) -> Vec<u16>, shift_mm: f32) -> LearnedFolds {
    let (mut sweep, mut felt) = (FoldSweep::new(vec!["left_elbow".into()], 2048), felt);
    for frame in 0..1200 {
        let angle = 50.0 - 50.0 * (frame as f32 / 50.0).cos();
        sweep.push(&[angle], &felt(angle)).expect("it fits");
    }
    let settings = FoldSettings { shift_mm, ..FoldSettings::default() };
    learn(&layout(&bending(1)), &[sweep], &settings).expect("it folds")
}

/// A bulge that presses on a taxel of the reference garment with so many counts: it appears at one angle,
/// degrees, and stays until another.
fn at_once(taxel: usize, counts: u16, [from, until]: [f32; 2]) -> impl FnMut(f32) -> Vec<u16> {
    let mut is_out = false;
    move |degrees| {
        is_out = degrees > if is_out { until } else { from };
        let mut felt = vec![0; 2048];
        felt[taxel] = if is_out { counts } else { 0 };
        felt
    }
}

/// A bulge that presses on two taxels, so many counts each at 100 degrees.
fn growing(first: usize, counts: f32) -> impl FnMut(f32) -> Vec<u16> {
    move |degrees| {
        let mut felt = vec![0; 2048];
        felt[first..first + 2].fill((counts * degrees / 100.0) as u16);
        felt
    }
}

#[test]
fn a_bulge_that_appears_at_once_may_do_so_beside_where_it_did() {
    let (pressed, beside, away) = (100, 101, 102);
    let learned = learned_once(at_once(pressed, 300, [60.0, 40.0]), 24.0);
    let table = FoldTable::view(&learned.table).expect("it is one");
    let cells = table.folds()[0].cells();
    let spread = |taxel: usize| {
        let its = (0..cells).map(|knot| table.cell(taxel as u16, knot).expect("it is in the table"));
        its.map(|cell| u16::from(cell.spread) * table.unit()).max().expect("it has knots")
    };
    assert!(spread(pressed) > 100, "{}", spread(pressed));
    assert_eq!(spread(beside), spread(pressed));
    // A whole shift away: its doubt is that of days, which falls as the day is learned.
    assert_eq!(spread(away), 0);
}

#[test]
fn one_day_leaves_room_for_another_that_is_twice_as_strong() {
    let learned = learned_once(growing(101, 600.0), 30.0);
    let table = FoldTable::view(&learned.table).expect("it is one");
    let last = table.folds()[0].cells() - 1;
    for taxel in [99, 101, 104] {
        let cell = table.cell(taxel, last).expect("it is within the shift");
        let level = [cell.mean, cell.days].map(|units| u32::from(units) * u32::from(table.unit()));
        assert!((1150..1300).contains(&level.iter().sum::<u32>()), "{taxel}: {level:?}");
        assert!(cell.mean.max(cell.days) <= 127, "{cell:?}");
    }
}

/// Feels a garment of which that was learned on another day, on an arm that bends to `degrees` in so many
/// frames. Returns the number of frames with a contact, and what is expected at the end, counts.
fn on_another_day(
    learned: &LearnedFolds,
    mut felt: impl FnMut(f32) -> Vec<u16>,
    frames: u64,
    degrees: impl Fn(u64) -> f32,
) -> (usize, u32) {
    /// Frames in which the board is tared and stores the table.
    const PREPARED: u64 = 400;
    let script = scripts::load("elbow").expect("built in");
    let mut board =
        VirtualBoard::new(scripts::garment(&script).expect("it is a preset"), Scene::shipped()).unwrap();
    let request = |board: &mut VirtualBoard, request| board.client().request(&request).expect("it fits");
    request(&mut board, Request::Tare { frames: 16 });
    let (mut contacts, mut expected) = (0, 0);
    for step in 0..PREPARED + frames {
        if step == TARED {
            setting::set_folds(board.client(), &written(learned)).expect("it is a table");
        }
        let degrees = degrees(step.saturating_sub(PREPARED));
        if step % 4 == 0 {
            let joint = JointAngle { joint: 0, centidegrees: (100.0 * degrees) as i16 };
            request(&mut board, Request::Posture(Posture { joints: [joint].into_iter().collect() }));
        }
        let codes: Vec<u16> = felt(degrees).iter().map(|counts| 100 + counts).collect();
        let mut take = |client: &Client, event: &Event| {
            match event {
                Event::Contacts { .. } if step > PREPARED => {
                    contacts += usize::from(!client.contacts().is_empty());
                }
                Event::Folds(report) => expected = report.total,
                Event::Answer { refusal: Some(why), .. } => panic!("{why}"),
                _ => {}
            }
            Ok(())
        };
        board.step(&codes, Micros(step * FRAME_PERIOD_US), &mut take).expect("the codes are of this garment");
    }
    (contacts, expected)
}

#[test]
fn a_board_learns_all_that_another_day_brings() {
    // The bulge lies two taxels from where it lay, and presses 1.7 times as strongly.
    let learned = learned_once(growing(101, 600.0), 30.0);
    // Five times there and back within 6.4 s, and there.
    let degrees = |step| 50.0 - 50.0 * (step as f32 / 200.0).min(11.0 * std::f32::consts::PI).cos();
    let (contacts, expected) = on_another_day(&learned, growing(103, 1000.0), 7200, degrees);
    assert_eq!(contacts, 0);
    assert!((1900..2100).contains(&expected), "{expected} of 2000 counts");
}

#[test]
fn a_bulge_that_appears_at_once_may_do_so_later_and_be_stronger() {
    // Thirty times there and back within 3.2 s each.
    let degrees = |step| 50.0 - 50.0 * (step as f32 / 100.0).cos();
    for [from, until] in [[60.0, 40.0], [50.0, 50.0], [62.0, 60.0]] {
        let learned = learned_once(at_once(100, 300, [from, until]), 30.0);
        let all = [-16.0, -4.0, 6.0, 16.0, -14.0, -8.0, 2.0, 11.0, 14.0];
        let campaign = std::env::var_os("TAXEL_CAMPAIGN").is_some();
        for later in &all[..if campaign { all.len() } else { 4 }] {
            let bulge = at_once(101, 450, [from + later, until + later]);
            let (contacts, _) = on_another_day(&learned, bulge, 18_800, degrees);
            assert_eq!(contacts, 0, "{from} to {until} degrees, {later} later");
        }
    }
}

#[test]
fn what_cannot_be_learned_is_said() {
    let layout = layout(&bending(1));
    let refused = |sweeps: &[FoldSweep], folds: &[&[&str]]| {
        let folds = folds.iter().map(|fold| fold.iter().map(|it| it.to_string()).collect()).collect();
        let error = learn(&layout, sweeps, &FoldSettings { folds, ..FoldSettings::default() }).unwrap_err();
        assert!(matches!(error.kind(), ErrorKind::Learn(LearnError::Data(_) | LearnError::TooLarge(_))));
        error.to_string()
    };
    assert_eq!(refused(&[], &[]), "there are no sweeps to learn from");
    let sweep = |frames: usize, taxels: usize, felt: u16| {
        let mut sweep = FoldSweep::new(vec!["elbow".into()], taxels);
        for frame in 0..frames {
            let mut all = vec![0; taxels];
            all[7..7 + 600].fill(if frame > 50 { felt } else { 0 });
            sweep.push(&[frame as f32 / 2.0], &all).unwrap();
        }
        sweep
    };
    assert_eq!(refused(&[sweep(80, 1000, 9)], &[]), "sweep 1: 1000 taxels, the garment has 2048");
    assert_eq!(refused(&[sweep(9, 2048, 9)], &[]), "sweep 1: 9 frames are too few, 50 at least");
    assert_eq!(
        refused(&[sweep(80, 2048, 0)], &[]),
        "no taxel is pressed while the joints move: nothing folds"
    );
    assert_eq!(refused(&[sweep(80, 2048, 90)], &[&["knee"]]), "joint knee: no sweep reports its angle");
    let three = ["elbow", "elbow", "elbow"];
    assert_eq!(refused(&[sweep(80, 2048, 90)], &[&three]), "a fold has one joint or two, not 3");
    let many = refused(&[sweep(80, 2048, 90)], &[]);
    assert!(many.ends_with("taxels fold or may, a board holds 512: state a smaller shift"), "{many}");
    let mut other = FoldSweep::new(vec!["elbow".into()], 4);
    let error = other.push(&[f32::NAN], &[0; 4]).unwrap_err().to_string();
    assert_eq!(error, "frame 0: angles must be -180 to 180 degrees");
    let error = other.push(&[0.0], &[0; 3]).unwrap_err().to_string();
    assert_eq!(error, "frame 0: 1 angles and 3 taxels instead of 1 and 4");
}
