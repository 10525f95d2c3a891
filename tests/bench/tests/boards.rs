//! A board that is played is a board: whoever follows it gets all of the stream, at its time.

use std::net::TcpListener;
use std::path::Path;
use std::sync::mpsc::channel;
use std::thread;
use std::time::{Duration, Instant};
use taxel::client::Event;
use taxel::session::Session;
use taxel_bench::boards::player::serve;
use taxel_bench::boards::stream::{Brought, Stream};

#[test]
fn all_that_is_played_arrives() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let made = Stream::make(folder, 1.0).unwrap();
    made.write(&folder.join("two.stream")).unwrap();
    let stream = Stream::read(&folder.join("two.stream")).unwrap();
    assert!(stream.messages == made.messages && stream.hello == made.hello);
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    let (sender, played) = channel();
    let each = stream.brought();
    let board = thread::spawn(move || serve(&listener, &stream, &sender).unwrap());
    let mut session = Session::open(&format!("tcp:{address}")).unwrap();
    let (begun, mut came) = (Instant::now(), Brought { frames: 0, contacts: 0 });
    let mut is_played = false;
    while !is_played || came != each {
        match session.wait().unwrap().unwrap() {
            Event::Frame { .. } => came.frames += 1,
            Event::Contacts { .. } => came.contacts += 1,
            _ => {}
        }
        is_played |= played.try_recv().is_ok();
        assert!(begun.elapsed() < Duration::from_secs(60), "{came:?} of {each:?}");
    }
    assert!(
        begun.elapsed() >= Duration::from_secs(1) && each.frames > 190 && each.contacts > 150,
        "{each:?}"
    );
    let counts = session.client().counts();
    assert_eq!((counts.lost, counts.thinned, counts.undecoded, counts.restarts), (0, 0, 0, 0));
    drop(session);
    board.join().unwrap();
}
