//! Real links: a closed TCP connection, and a serial port that is unplugged and comes back under the name
//! that leads to it.

use super::restored::{scene, until};
use super::rig::Rig;
use std::io::{ErrorKind, Read, Write};
use std::net::TcpListener;
use std::sync::{Arc, Mutex};
use std::time::Duration;
use taxel::client::Event;
use taxel::session::{Returns, Session};
use taxel::source::{self, SourceOptions};
use taxel_core::wire::Request;

/// Number of breaks of each link, in a test and in a campaign.
fn rounds() -> usize {
    if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 1000 } else { 50 }
}

/// Passes bytes between a stream and the board until its link is cut. The other end may be closed at first.
fn pass(mut stream: impl Read + Write, rig: &Mutex<Rig>, link: u64) {
    let (mut buffer, mut met) = ([0; 1024], false);
    while rig.lock().unwrap().link == link {
        match stream.read(&mut buffer) {
            Ok(0) => return,
            Ok(count) => {
                met = true;
                rig.lock().unwrap().receive(&buffer[..count]);
            }
            Err(_) if !met => {
                std::thread::sleep(Duration::from_millis(1));
                continue;
            }
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
            Err(_) => return,
        }
        let count = rig.lock().unwrap().speak(&mut buffer);
        if stream.write_all(&buffer[..count]).is_err() {
            return;
        }
    }
}

/// Sets a scene, and breaks the link repeatedly, every other time with the power of the board.
fn breaks(spec: &str, rig: &Mutex<Rig>) {
    let source = source::open(&spec.parse().unwrap(), &SourceOptions::default()).unwrap();
    let mut session = Session::new(source, Returns::Always);
    let (client, _) = session.parts();
    client.request(&Request::SetScene(&postcard::to_allocvec(&scene()).unwrap())).unwrap();
    client.start(0).unwrap();
    until(&mut session, |event| matches!(event, Event::Frame { .. }));
    for round in 0..rounds() {
        {
            let mut rig = rig.lock().unwrap();
            if round % 2 == 0 {
                rig.restart();
            }
            rig.cut();
        }
        until(&mut session, |event| matches!(event, Event::Lost { why, .. } if why.contains("is gone: ")));
        until(
            &mut session,
            |event| matches!(event, Event::Back { how, .. } if how.contains("is back after ")),
        );
        until(&mut session, |event| matches!(event, Event::Frame { .. }));
        assert_eq!(rig.lock().unwrap().scene(), &scene(), "round {round}");
    }
    let kind = spec.split(':').next().unwrap_or_default();
    println!(
        "{kind}: {0} disconnects, every other one with a restart; {0} times back, everything set",
        rounds()
    );
}

#[test]
fn a_connection_that_is_closed_is_opened_again() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let spec = format!("tcp:{}", listener.local_addr().unwrap());
    let served = rig.clone();
    std::thread::spawn(move || {
        for stream in listener.incoming() {
            let stream = stream.unwrap();
            stream.set_read_timeout(Some(Duration::from_millis(1))).unwrap();
            let link = served.lock().unwrap().link;
            pass(stream, &served, link);
        }
    });
    breaks(&spec, &rig);
}

/// A board on a terminal that disappears with it; a name leads to it like those in `/dev/serial/by-id`.
#[test]
#[cfg(unix)]
fn a_serial_port_that_is_unplugged_comes_back_under_another_name() {
    use serialport::{SerialPort, TTYPort};
    use std::os::unix::fs::symlink;
    let rig = Arc::new(Mutex::new(Rig::new()));
    let name = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("port-{}", std::process::id()));
    let plug = {
        let name = name.clone();
        move || {
            let (mut master, slave) = TTYPort::pair().unwrap();
            master.set_timeout(Duration::from_millis(1)).unwrap();
            let _ = std::fs::remove_file(&name);
            symlink(slave.name().unwrap(), &name).unwrap();
            // Only the host has it open.
            drop(slave);
            master
        }
    };
    let (first, served) = (plug(), rig.clone());
    std::thread::spawn(move || {
        let mut next = Some(first);
        loop {
            let master = next.take().unwrap_or_else(&plug);
            let link = served.lock().unwrap().link;
            pass(master, &served, link);
        }
    });
    breaks(&format!("serial:{}", name.display()), &rig);
    let _ = std::fs::remove_file(name);
}
