//! A board that refuses raw codes.

use super::stage::{file, plan, record};
use taxel::client::{Client, Event};
use taxel::record::{Plan, Play, Recorder};
use taxel::session::Show;
use taxel_cli::fault::status;

/// A client after the `Hello` of a board that sends no raw codes.
fn acquainted() -> Client {
    record("sim:idle", plan("raw-idle.mcap", "sim", None, false));
    let mut play = Play::open(&file("raw-idle.mcap").into()).unwrap();
    while play.client().worn().is_none() {
        play.next_event().unwrap().expect("it says what it is");
    }
    play.client().clone()
}

/// Hands an event to a recorder.
fn hand(recorder: &mut Recorder, client: &Client, event: &Event) -> anyhow::Result<()> {
    recorder.event(client, event)
}

/// Lets a recorder ask for raw codes.
fn idle(recorder: &mut Recorder, client: &mut Client) -> anyhow::Result<bool> {
    recorder.idle(client)
}

#[test]
fn a_refusal_of_raw_codes_ends_the_recording() {
    let client = acquainted();
    let begin = |name: &str| Recorder::create(Plan { raw: true, ..plan(name, "sim", None, false) }).unwrap();
    let answer = |refusal: Option<&str>| Event::Answer { request: 4, refusal: refusal.map(String::from) };
    let mut refused = begin("raw-refused.mcap");
    // No request was made yet: the answer is for another program.
    hand(&mut refused, &client, &answer(Some("no"))).unwrap();
    assert!(idle(&mut refused, &mut client.clone()).unwrap());
    let error = hand(&mut refused, &client, &answer(Some("the link is too slow"))).unwrap_err();
    let told = "--raw: the board refuses raw codes: the link is too slow";
    assert_eq!((error.to_string().as_str(), status(&error)), (told, 3));
    refused.finish().unwrap();
    // A board without the request answers that it cannot read it.
    let mut older = begin("raw-older.mcap");
    idle(&mut older, &mut client.clone()).unwrap();
    let unread = Event::Answer { request: 255, refusal: Some("no message".into()) };
    let error = hand(&mut older, &client, &unread).unwrap_err();
    assert_eq!(
        (error.to_string().as_str(), status(&error)),
        ("--raw: the board refuses raw codes: no message", 3)
    );
    older.finish().unwrap();
    let mut done = begin("raw-done.mcap");
    assert!(idle(&mut done, &mut client.clone()).unwrap());
    hand(&mut done, &client, &answer(None)).unwrap();
    // A later refusal is for another program.
    hand(&mut done, &client, &answer(Some("no"))).unwrap();
    done.finish().unwrap();
}
