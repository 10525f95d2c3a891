//! The bytes of an array are in its recording, and what is perceived in them again is the same.

use crate::tools::{file, refused, run, said};
use serde_json::Value;
use std::io::Write;
use std::net::{TcpListener, TcpStream, UdpSocket};
use std::thread;
use std::time::Duration;

const KEYS: &str = "rows=6,columns=8,range=0..4095";

/// A line of 48 numbers: a hand from frame 60 on.
fn line(frame: u32) -> String {
    let taxel = |at: u32| {
        let (row, column) = (f64::from(at / 8), f64::from(at % 8));
        let press = 1500.0 * (-((row - 2.0).powi(2) + (column - 3.0).powi(2)) / 2.0).exp();
        let noise = (at * 7 + frame * 3) % 5;
        200 + noise + if frame >= 60 { press as u32 } else { 0 }
    };
    (0..48).map(|at| taxel(at).to_string()).collect::<Vec<_>>().join(" ") + "\n"
}

/// The contacts of a source, without the host's times.
fn contacts(source: &str) -> Vec<Value> {
    let lines = said(&["live", source, "--json"]);
    let contacts = lines.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let mut contacts: Vec<Value> = contacts.filter(|line| line["type"] == "frame").collect();
    for contact in &mut contacts {
        let fields = contact.as_object_mut().unwrap();
        fields.retain(|key, _| !key.starts_with("host_"));
    }
    contacts
}

/// Records a source, and perceives it twice: by what the board said, and by the array's bytes.
fn compare(name: &str, source: &str) {
    let path = file(name);
    let path = path.to_str().unwrap();
    _ = said(&["record", source, "-o", path, "--frames", "90"]);
    let [known, again] =
        [path.to_string(), format!("numbers:file:{path},{KEYS}")].map(|source| contacts(&source));
    let pressed =
        |frames: &[Value]| frames.iter().filter(|it| it["contacts"] != Value::Array(vec![])).count();
    assert!(known.len() >= 90 && pressed(&known) > 20, "{} frames, {} pressed", known.len(), pressed(&known));
    assert!(again.len() >= known.len(), "{} of {}", again.len(), known.len());
    for (known, again) in known.iter().zip(&again) {
        assert_eq!(known, again);
    }
}

#[test]
fn a_stream_is_recorded_and_perceived_again() {
    let server = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = server.local_addr().unwrap();
    let device = thread::spawn(move || {
        let (mut device, _): (TcpStream, _) = server.accept().unwrap();
        // A first line may be the rest of one.
        for frame in 0..400 {
            if device.write_all(line(frame).as_bytes()).is_err() {
                return;
            }
            thread::sleep(Duration::from_millis(5));
        }
    });
    compare("stream.mcap", &format!("numbers:tcp:{address},{KEYS}"));
    device.join().unwrap();
}

#[test]
fn datagrams_are_recorded_and_perceived_again() {
    let port = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let device = UdpSocket::bind("127.0.0.1:0").unwrap();
    thread::spawn(move || {
        for frame in (0..).map(|frame| frame % 400) {
            // Nobody may listen yet.
            _ = device.send_to(line(frame).as_bytes(), ("127.0.0.1", port));
            thread::sleep(Duration::from_millis(5));
        }
    });
    compare("datagrams.mcap", &format!("numbers:udp:{port},{KEYS}"));
}

#[test]
fn a_recording_without_an_array_is_told_as_that() {
    let path = file("board.mcap");
    let path = path.to_str().unwrap();
    _ = run(&["record", "sim:pat", "-o", path, "--frames", "5"]);
    let why = refused(2, &["live", &format!("numbers:file:{path},{KEYS}"), "--json"]);
    assert!(why.contains("holds no bytes of an array"), "{why}");
}
