//! What a build without features refuses, and how it names it.

use taxel_core_featureless::acquire::Depth;
use taxel_core_featureless::board::{Board, BoardInfo, Input};
use taxel_core_featureless::format::{Micros, Q15};
use taxel_core_featureless::garment::{Garment, Pins};
use taxel_core_featureless::gesture::GestureConfig;
use taxel_core_featureless::intent::Feed;
use taxel_core_featureless::react::{Cause, ReactionConfig};
use taxel_core_featureless::scene::{Scene, StreamConfig};
use taxel_core_featureless::wire::{Receiver, Report, Request, decode, encode, frame_bound};

type ShippedSize = Board<2048, 1024, 512>;

fn board() -> Box<ShippedSize> {
    let info =
        BoardInfo { firmware: "", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 92_160 };
    Box::new(ShippedSize::new(info, Garment::reference(), Scene::shipped()).expect("what ships fits"))
}

/// The board's answers to a request.
fn answers(board: &mut ShippedSize, request: &Request<'_>) -> Vec<Option<String>> {
    let mut wire = vec![0; 4096];
    board.step(Micros(0), Input::Received(encode(request, &mut wire).unwrap()), &mut ());
    let mut inbox: Receiver<{ frame_bound(8192) }> = Receiver::new();
    let mut answers = Vec::new();
    loop {
        let bytes = board.pending(Micros(0), &mut ()).to_vec();
        if bytes.is_empty() {
            return answers;
        }
        board.sent(bytes.len());
        for byte in bytes {
            let Some(Ok(body)) = inbox.push(byte) else { continue };
            if let Ok((_, Report::Answer(answer))) = decode::<(u32, Report<'_>)>(body) {
                answers.push(answer.refusal.map(str::to_owned));
            }
        }
    }
}

/// The board's only answer to a scene.
fn answer_to_scene(edit: impl FnOnce(&mut Scene)) -> Option<String> {
    let mut scene = Scene::shipped();
    edit(&mut scene);
    let bytes = postcard::to_allocvec(&scene).unwrap();
    let [answer] = answers(&mut board(), &Request::SetScene(&bytes)).try_into().unwrap();
    answer
}

#[test]
fn a_scene_is_refused_by_the_name_of_what_it_asks_for() {
    assert_eq!(answer_to_scene(|scene| scene.contact.low = 20), None, "contacts are all that is left");
    let refused = |edit: fn(&mut Scene)| answer_to_scene(edit).unwrap();
    let pressing = refused(|scene| scene.stream = StreamConfig { pressing_hz: 10, ..scene.stream });
    assert_eq!(pressing, "scene: stream.pressing_hz is left out of this firmware");
    let gestures = refused(|scene| scene.gestures = Some(GestureConfig::default()));
    assert_eq!(gestures, "scene: gestures is left out of this firmware");
    let interlaced = refused(|scene| scene.plan.depth = Depth::Interlaced);
    assert_eq!(interlaced, "plan.depth cannot be interlaced: it is left out of this firmware");
    let flinch = refused(|scene| {
        let row = scene.react[0].clone();
        let cause = Cause::Leading(taxel_core_featureless::intent::Leading::Attack);
        scene.react.push(ReactionConfig { name: "flinch".try_into().unwrap(), cause, ..row }).unwrap();
    });
    assert!(flinch.starts_with("scene: react[1]."), "{flinch}");
}

#[test]
fn a_map_is_refused_before_it_is_read() {
    let mut bytes = postcard::to_allocvec(&Scene::empty()).unwrap();
    // The byte before the lists of friendliness, joints and reactions, and the stream, says that there is no
    // map; a map would follow it.
    let rest = 3 + postcard::to_allocvec(&StreamConfig::default()).unwrap().len();
    let at = bytes.len() - rest - 1;
    assert_eq!(bytes[at], 0);
    bytes[at] = 1;
    let refused = answers(&mut board(), &Request::SetScene(&bytes));
    assert_eq!(refused, [Some("scene: intent is left out of this firmware".to_owned())]);
}

#[test]
fn a_request_is_refused_by_the_name_of_what_it_asks_for() {
    let mut board = board();
    let mut refused = |request: Request<'_>| answers(&mut board, &request);
    let left_out = |name: &str| [Some(format!("{name} is left out of this firmware"))];
    assert_eq!(refused(Request::SetShapes(&[1])), left_out("shapes"));
    assert_eq!(refused(Request::SetShapes(&[])), [None]);
    assert_eq!(refused(Request::AddShapes(&[0])), left_out("shapes"));
    let concept = "warmth".try_into().unwrap();
    let feed = Feed { concept, value: Q15(0), age_ms: 0, timeout_ms: 0, default: Q15(0) };
    assert_eq!(refused(Request::Feed(feed)), left_out("intent"));
    assert_eq!(refused(Request::Stream { raw_hz: 10, budget_hz: 1 }), left_out("raw"));
    assert_eq!(refused(Request::Stream { raw_hz: 0, budget_hz: 9 }), [None]);
    assert_eq!(refused(Request::SetTable(&[0; 4])), left_out("surface"));
    assert_eq!(refused(Request::SetTable(&[1, 0, 0, 0])), left_out("folds"));
    assert_eq!(refused(Request::SetPoses(&[0])), left_out("surface"));
}
