//! Touches of the families of one board, spread over two boards: a front and a rear, or a hand and an arm.

use crate::meaning::family::{Act, Expected, Scans};
use crate::meaning::{scripted, strangers};
use crate::people::kind::{Kind, Session};
use crate::people::{hands, scripted as people};
use taxel_core::garment::{Garment, Layout};
use taxel_core::intent::Leading;

/// A millisecond, us.
const MS: u64 = 1000;
/// Time before what a person does, us.
const BEFORE_US: u64 = 800_000;
/// Time after it that is still played, us.
const AFTER_US: u64 = 500_000;

/// A touch of the robot.
pub struct SpreadTouch {
    /// Judgement of a person.
    pub expected: Expected,
    /// Begin and end of its force, us.
    pub span: (u64, u64),
    /// What the two boards scan.
    pub parts: [SpreadPart; 2],
    /// Parameters, to analyse a failure.
    pub note: String,
}

/// A part of the touch, on one board.
pub struct SpreadPart {
    pub garment: Garment,
    /// Link that carries the whole garment; none if its panels say theirs.
    pub link: Option<&'static str>,
    pub period_us: u64,
    pub codes: Scans,
}

/// A family of touches of the robot.
pub struct SpreadFamily {
    pub name: String,
    pub make: Box<dyn Fn(u64) -> SpreadTouch>,
}

/// Panels of a garment without seams, the others left out.
fn part(garment: &Garment, panels: [usize; 2]) -> Garment {
    let mut part = garment.clone();
    part.seams.clear();
    part.panels = panels.map(|panel| garment.panels[panel].clone()).into_iter().collect();
    part.blocks.clear();
    for block in &garment.blocks {
        if let Some(at) = panels.iter().position(|panel| *panel == usize::from(block.panel)) {
            let mut block = block.clone();
            block.panel = at as u8;
            part.blocks.push(block).unwrap();
        }
    }
    part
}

/// The codes of these panels, of a touch of the whole garment. Both parts draw the whole from the same
/// numbers.
fn some(act: Act, panels: [usize; 2]) -> SpreadPart {
    of_panels((act.garment, act.codes), act.period_us, panels)
}

fn of_panels((garment, mut scans): (Garment, Scans), period_us: u64, panels: [usize; 2]) -> SpreadPart {
    let layout = Layout::build(&garment, 2048, 4095).unwrap();
    let mut whole = vec![0; layout.taxels()];
    let of: Vec<std::ops::Range<usize>> = panels
        .map(|panel| {
            let area = &layout.areas()[panel];
            let first = usize::from(area.base);
            first..first + usize::from(area.rows) * usize::from(area.columns)
        })
        .into();
    SpreadPart {
        garment: part(&garment, panels),
        link: None,
        period_us,
        codes: Box::new(move |now, codes| {
            scans(now, &mut whole);
            let taxels = of.iter().cloned().flatten();
            codes.iter_mut().zip(taxels).for_each(|(code, taxel)| *code = whole[taxel]);
        }),
    }
}

/// A touch of the reference garment whose chest and left arm are one board, back and right arm another.
fn split(make: impl Fn() -> Act) -> SpreadTouch {
    let act = make();
    let (expected, span, note) = (act.family.expected, act.span, act.note.clone());
    let parts = [some(act, [0, 2]), some(make(), [1, 3])];
    SpreadTouch { expected, span, parts, note }
}

/// What a person does once, from 0.8 s on, on the reference garment of two boards.
fn of_person(kind: Kind, person: impl Fn() -> Box<dyn Session>) -> SpreadTouch {
    let part = |panels: [usize; 2]| {
        let mut session = person();
        let act = session.acts().iter().find(|act| act.kind == kind).unwrap().clone();
        let garment = session.garment();
        let codes: Scans = Box::new(move |now, codes| {
            // Without what follows: there are 0.9 s until then.
            let time = (now + act.span.0).saturating_sub(BEFORE_US).min(act.span.1 + AFTER_US);
            session.frame(time, codes);
        });
        of_panels((garment, codes), taxel::sim::FRAME_PERIOD_US, panels)
    };
    let act = person().acts().iter().find(|act| act.kind == kind).unwrap().clone();
    let expected = match kind.meaning() {
        Leading::Attack => Expected::Attack,
        Leading::Threat => Expected::Harmful,
        _ => Expected::Kind,
    };
    let span = (BEFORE_US, BEFORE_US + act.span.1 - act.span.0);
    SpreadTouch { expected, span, parts: [part([0, 2]), part([1, 3])], note: act.note }
}

/// A touch later by so many ms.
fn later(part: SpreadPart, ms: u64) -> SpreadPart {
    let mut codes = part.codes;
    let codes: Scans = Box::new(move |now, to| codes(now.saturating_sub(ms * MS), to));
    SpreadPart { codes, ..part }
}

fn strange(name: &str, number: u64) -> Act {
    let family = strangers::FAMILIES.iter().position(|family| family.name == name).unwrap();
    // Even numbers have the reference garment.
    strangers::act(family, 2 * number)
}

/// A stranger's touch on a mat, which lies on this link.
fn on_link(name: &str, number: u64, link: &'static str) -> (SpreadPart, (u64, u64), String) {
    let family = strangers::FAMILIES.iter().position(|family| family.name == name).unwrap();
    let act = strangers::touch_on(family, number, (Garment::mat(), strangers::Make::Uneven), None);
    let (span, note) = (act.span, act.note.clone());
    let part =
        SpreadPart { garment: act.garment, link: Some(link), period_us: act.period_us, codes: act.codes };
    (part, span, note)
}

/// A hand's and an arm's touch at once.
fn hand_and_arm(hand: &str, arm: &str, expected: Expected, number: u64) -> SpreadTouch {
    let (on_hand, span, note) = on_link(hand, number, "left_hand");
    let (on_arm, arm_span, _) = on_link(arm, number + 500, "left_forearm");
    SpreadTouch { expected, span: (span.0, span.1.max(arm_span.1)), parts: [on_hand, on_arm], note }
}

/// The panel of a garment on which a scan has most above another.
fn pressed_panel(garment: &Garment, scans: &mut Scans, [rest_us, pressed_us]: [u64; 2]) -> usize {
    let layout = Layout::build(garment, 2048, 4095).unwrap();
    let mut codes = [vec![0; layout.taxels()], vec![0; layout.taxels()]];
    scans(rest_us, &mut codes[0]);
    scans(pressed_us, &mut codes[1]);
    let risen = |panel: &usize| {
        let area = &layout.areas()[*panel];
        let first = usize::from(area.base);
        let taxels = first..first + usize::from(area.rows) * usize::from(area.columns);
        taxels.map(|at| u64::from(codes[1][at].saturating_sub(codes[0][at]))).sum::<u64>()
    };
    (0..layout.areas().len()).max_by_key(risen).unwrap()
}

/// What a chest meets while the back already leans on something.
fn leaning_back(chest: &str, expected: Expected, number: u64) -> SpreadTouch {
    let on_panel = |name: &str, panel: usize| {
        // Another number until it lies on that panel.
        (0..).find_map(|more| {
            let act = || strange(name, 1000 * more + number);
            let mut tried = act();
            let pressed_us = tried.span.0.midpoint(tried.span.1.min(tried.span.0 + 60 * MS));
            let on = pressed_panel(&tried.garment, &mut tried.codes, [0, pressed_us]);
            (on == panel).then(act)
        })
    };
    let (front, rear) = (on_panel(chest, 0).unwrap(), on_panel("leaning", 1).unwrap());
    let (span, note) = (front.span, front.note.clone());
    let parts = [later(some(front, [0, 2]), 2000), some(rear, [1, 3])];
    SpreadTouch { expected, span: (span.0, span.1 + 2_000 * MS), parts, note }
}

/// Two firm hands, one on the chest and one on the back, which let go within 0.4 s: each alone restrains.
fn firm_hug(number: u64) -> SpreadTouch {
    let on_panel = |panel: usize, from: u64| {
        (from..).find_map(|more| {
            let person =
                || -> Box<dyn Session> { Box::new(hands::Person::new(2 * (1000 * more + number), 1)) };
            let mut tried = person();
            let act = tried.acts().iter().find(|act| act.kind == Kind::Hold).unwrap().clone();
            let garment = tried.garment();
            let mut scans: Scans = Box::new(move |now, codes| tried.frame(now, codes));
            let times = [act.span.0.saturating_sub(200 * MS), act.span.0 + 600 * MS];
            let on = pressed_panel(&garment, &mut scans, times);
            (on == panel).then(|| (of_person(Kind::Hold, person), more))
        })
    };
    let front = on_panel(0, 0).unwrap().0;
    let mut rear = on_panel(1, 0).unwrap();
    while front.span.1.abs_diff(rear.0.span.1) > 400 * MS {
        rear = on_panel(1, rear.1 + 1).unwrap();
    }
    let rear = rear.0;
    let span = (BEFORE_US, front.span.1.max(rear.span.1));
    let ([on_chest, _], [_, on_back]) = (front.parts, rear.parts);
    let note = format!("{}; {}", front.note, rear.note);
    SpreadTouch { expected: Expected::Kind, span, parts: [on_chest, on_back], note }
}

/// All families: those of both authors of the families of one board, and those that two boards need.
pub fn families() -> Vec<SpreadFamily> {
    let mut all: Vec<SpreadFamily> = Vec::new();
    for (index, family) in scripted::FAMILIES.iter().enumerate() {
        let make = move |number| split(|| scripted::act(index, 2 * number));
        all.push(SpreadFamily { name: format!("{}, scripted", family.name), make: Box::new(make) });
    }
    for (index, family) in strangers::FAMILIES.iter().enumerate() {
        let make = move |number| split(|| strangers::act(index, 2 * number));
        all.push(SpreadFamily { name: family.name.into(), make: Box::new(make) });
    }
    for kind in Kind::ALL {
        // Even numbers have the reference garment.
        let tuned = move |number| of_person(kind, || Box::new(people::Person::new(2 * number, 1)));
        all.push(SpreadFamily { name: format!("{kind:?}, person").to_lowercase(), make: Box::new(tuned) });
        let others = move |number| of_person(kind, || Box::new(hands::Person::new(2 * number, 1)));
        all.push(SpreadFamily { name: format!("{kind:?}, hands").to_lowercase(), make: Box::new(others) });
    }
    let mut more = |name: &str, make: Box<dyn Fn(u64) -> SpreadTouch>| {
        all.push(SpreadFamily { name: name.into(), make });
    };
    let pair = |hand, arm, expected| Box::new(move |number| hand_and_arm(hand, arm, expected, number));
    more("handshake, both hands", pair("handshake", "caress", Expected::Kind));
    more("pat on hand and arm", pair("pat", "pat", Expected::Kind));
    more("push on hand and arm", pair("push", "push", Expected::Harmful));
    more("blow on a held hand", pair("handshake", "slap of 80 N", Expected::Attack));
    more("firm hug", Box::new(firm_hug));
    let leaning = |chest, expected| Box::new(move |number| leaning_back(chest, expected, number));
    more("blow against a chair", leaning("slap of 80 N", Expected::Attack));
    more("push against a chair", leaning("push", Expected::Harmful));
    all
}
