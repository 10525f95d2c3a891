//! Arrays as sources: what a board of this host makes of them, over each link.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream, UdpSocket};
use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant};
use taxel::client::{Event, scene_bytes};
use taxel::session::{Poll, Returns, Session};
use taxel::source::array::NoiseMeter;
use taxel::source::{SourceOptions, open};
use taxel::virtual_board::VirtualBoard;
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::Request;

const ROWS: u16 = 6;
const COLUMNS: u16 = 8;
/// Keys of the numbers below.
const KEYS: &str = "rows=6,columns=8,range=0..4095";
/// Longest time that a test waits.
const LONGEST: Duration = Duration::from_secs(20);

/// Codes of a frame: a hand from frame 60 on, for 30 frames.
fn codes(frame: u64) -> Vec<u16> {
    let taxel = |at: u64| {
        let (row, column) = ((at / 8) as f64, (at % 8) as f64);
        let press = 1500.0 * (-((row - 2.0).powi(2) + (column - 3.0).powi(2)) / 2.0).exp();
        let noise = (at * 7 + frame * 3) % 5;
        200 + noise as u16 + if (60..90).contains(&(frame % 100)) { press as u16 } else { 0 }
    };
    (0..u64::from(ROWS * COLUMNS)).map(taxel).collect()
}

fn line(frame: u64) -> String {
    codes(frame).iter().map(u16::to_string).collect::<Vec<_>>().join(" ") + "\r\n"
}

fn session(source: &str) -> Session {
    Session::over(open(&source.parse().unwrap(), &SourceOptions::default()).unwrap()).unwrap()
}

/// A file of these bytes.
fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

/// Waits for a touch.
fn touched(session: &mut Session) {
    let began = Instant::now();
    while session.client().contacts().is_empty() {
        assert!(began.elapsed() < LONGEST, "nothing is felt");
        let _ = session.poll().unwrap();
    }
}

/// Contacts of a stream, with the number of each frame.
#[derive(Debug, Default, PartialEq)]
struct Felt(Vec<String>);

impl Felt {
    fn note(&mut self, client: &taxel::client::Client, event: &Event) {
        if let Event::Frame { .. } = event {
            let contacts = client.contacts();
            self.0.push(format!("{event:?} {contacts:?}"));
        }
    }
}

#[test]
fn a_file_is_perceived_as_the_same_codes_at_the_same_times() {
    let lines: String =
        "\n".chars().chain((0..200).flat_map(|frame| line(frame).chars().collect::<Vec<_>>())).collect();
    let path = file("array.txt", lines.as_bytes());
    let mut session = session(&format!("numbers:file:{},{KEYS},rate=100", path.display()));
    let mut felt = Felt::default();
    while let Some(event) = session.wait().unwrap() {
        felt.note(session.client(), &event);
    }
    let mut board =
        VirtualBoard::new(Garment::grid("numbers", ROWS, COLUMNS, [0, 0]), Scene::shipped()).unwrap();
    board.client().request(&Request::Tare { frames: 32 }).unwrap();
    let (mut known, mut meter) = (Felt::default(), NoiseMeter::default());
    for frame in 0..200 {
        let noted = &mut |client: &taxel::client::Client, event: &Event| {
            known.note(client, event);
            Ok(())
        };
        board.step(&codes(frame), Micros(frame * 10_000), noted).unwrap();
        if let Some(noise) = meter.add(&codes(frame)) {
            let scene = scene_bytes(&noise.scene(board.areas())).unwrap();
            board.client().request(&Request::SetScene(&scene)).unwrap();
        }
    }
    assert_eq!(felt.0.len(), 200);
    assert!(felt.0.iter().filter(|frame| frame.contains("total")).count() > 40, "{:?}", felt.0[70]);
    assert_eq!(felt, known);
}

#[test]
fn a_device_connects_and_sends_packets() {
    let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let mut session = session(&format!("wiresens:listen:{port},rows=6,columns=8,nodes=20"));
    let device = thread::spawn(move || {
        let mut device = TcpStream::connect(("127.0.0.1", port)).unwrap();
        // Images of falling values, in packets that run over their ends.
        let values: Vec<u16> = (0..400).flat_map(codes).map(|code| 4095 - code).collect();
        for (number, nodes) in values.chunks_exact(20).enumerate() {
            let start = (number * 20 % 48) as u16;
            let nodes: Vec<u8> = nodes.iter().flat_map(|value| value.to_le_bytes()).collect();
            let packet = [&[1][..], &start.to_le_bytes(), &nodes, &(number as u32).to_le_bytes()].concat();
            if device.write_all(&packet).is_err() {
                return;
            }
            thread::sleep(Duration::from_millis(3));
        }
    });
    touched(&mut session);
    let description = session.client().description().unwrap();
    assert!(description.firmware.ends_with(" wiresens"), "{}", description.firmware);
    assert!(description.firmware.starts_with("taxel-host ") && !description.is_simulated());
    let contact = &session.client().contacts()[0];
    assert!((contact.contact.x.to_f64() - 3.0).abs() < 0.3, "{contact:?}");
    drop(session);
    device.join().unwrap();
}

#[test]
fn an_array_that_is_polled_answers_with_frames() {
    let form = "rows = 6\ncolumns = 8\nrange = [0, 255]\n[link]\npoll = \"A\"\n[frame]\nkind = \"bytes\"\nvalue = \"u8\"\n";
    let description = file("polled.toml", form.as_bytes());
    let server = TcpListener::bind("127.0.0.1:0").unwrap();
    let mut session = session(&format!("{}:tcp:{}", description.display(), server.local_addr().unwrap()));
    thread::spawn(move || {
        let (mut device, _) = server.accept().unwrap();
        // A greeting is no answer.
        device.write_all(b"ready\r\n").unwrap();
        let mut asked = [0];
        for frame in 40.. {
            if device.read_exact(&mut asked).is_err() || asked != *b"A" {
                return;
            }
            let codes: Vec<u8> = codes(frame).iter().map(|code| (code / 16) as u8).collect();
            // In two pieces.
            let _ = device.write_all(&codes[..20]).and_then(|()| device.write_all(&codes[20..]));
        }
    });
    touched(&mut session);
}

#[test]
fn datagrams_are_lines_without_an_end() {
    let port = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let mut session = session(&format!("numbers:udp:{port},{KEYS}"));
    thread::spawn(move || {
        let device = UdpSocket::bind("127.0.0.1:0").unwrap();
        for frame in 0..2000 {
            let _ = device.send_to(line(frame).trim().as_bytes(), ("127.0.0.1", port));
            thread::sleep(Duration::from_millis(5));
        }
    });
    touched(&mut session);
}

#[test]
fn a_lost_array_is_back_once_it_is() {
    let server = TcpListener::bind("127.0.0.1:0").unwrap();
    let mut session = session(&format!("numbers:tcp:{},{KEYS}", server.local_addr().unwrap()));
    thread::spawn(move || {
        for frames in [40, 4000] {
            let (mut device, _) = server.accept().unwrap();
            for frame in 0..frames {
                let _ = device.write_all(line(frame).as_bytes());
                thread::sleep(Duration::from_millis(5));
            }
        }
    });
    let (began, mut seen) = (Instant::now(), Vec::new());
    while seen.len() < 2 {
        assert!(began.elapsed() < LONGEST, "{seen:?}");
        match session.wait().unwrap().unwrap() {
            Event::Lost { .. } => seen.push("lost"),
            Event::Back { .. } => seen.push("back"),
            _ => {}
        }
    }
    assert_eq!(seen, ["lost", "back"]);
    touched(&mut session);
}

#[test]
fn nothing_is_felt_before_the_first_tare() {
    let lines: String = std::iter::once("\n".into()).chain((0..40).map(line)).collect();
    let path = file("untared.txt", lines.as_bytes());
    let source = format!("numbers:file:{},{KEYS}", path.display());
    let mut session =
        Session::new(open(&source.parse().unwrap(), &SourceOptions::default()).unwrap(), Returns::Never);
    // As a robot's boards are recognised: their stream is begun before it is tared.
    session.request(&Request::Start).unwrap();
    let mut frames = 0;
    while let Some(event) = session.wait().unwrap() {
        frames += u32::from(matches!(event, Event::Frame { .. }));
        assert!(session.client().contacts().is_empty());
    }
    assert_eq!(frames, 40);
}

/// A serial port whose name is a link to a terminal, so that it may come back as another one.
#[cfg(unix)]
#[test]
fn an_unplugged_array_is_back_once_it_is_plugged_in() {
    use serialport::{SerialPort, TTYPort};
    use std::os::unix::fs::symlink;
    let name = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("ttyMAT");
    let plug = |name: &PathBuf| {
        let (mut master, slave) = TTYPort::pair().unwrap();
        master.set_timeout(Duration::from_millis(1)).unwrap();
        let _ = std::fs::remove_file(name);
        symlink(slave.name().unwrap(), name).unwrap();
        master
    };
    let mut device = plug(&name);
    let mut session = session(&format!("numbers:{},{KEYS}", name.display()));
    let (began, mut seen) = (Instant::now(), Vec::new());
    for frame in 0.. {
        assert!(began.elapsed() < LONGEST, "{seen:?}");
        if frame == 50 {
            let _ = std::fs::remove_file(&name);
            // The first one hangs up.
            device = plug(&name);
        }
        let _ = device.write_all(line(frame).as_bytes());
        match session.poll().unwrap() {
            Poll::Event(Event::Lost { .. }) => seen.push("lost"),
            Poll::Event(Event::Back { .. }) => seen.push("back"),
            _ if seen.len() == 2 && !session.client().contacts().is_empty() => break,
            _ => {}
        }
    }
    assert_eq!(seen, ["lost", "back"]);
}

#[test]
fn damaged_frames_are_failed_scans_and_missing_ones_overruns() {
    let form = "rows = 1\ncolumns = 4\nrange = [0, 255]\n[frame]\nkind = \"bytes\"\nhead = \"A5\"\nbefore = 1\nvalue = \"u8\"\n\
                check = \"sum8\"\nsequence = { at = 1, type = \"u8\" }\n";
    let description = file("counted.toml", form.as_bytes());
    let frame = |number: u16| {
        let frame = [0xA5, number as u8, 1, 2, 3, 4];
        let sum = frame.iter().fold(0u8, |sum, byte| sum.wrapping_add(*byte));
        [&frame[..], &[if number == 150 { !sum } else { sum }]].concat()
    };
    let stream: Vec<u8> = (0..1500).filter(|number| !(60..63).contains(number)).flat_map(frame).collect();
    let path = file("counted.bin", &stream);
    let source = format!("{}:file:{},rate=100", description.display(), path.display());
    let mut session = session(&source);
    let mut health = None;
    while let Some(event) = session.wait().unwrap() {
        if let Event::Health(told) = event {
            health = Some(told);
        }
    }
    let health = health.unwrap();
    assert_eq!((health.failed, health.overruns), (1, 3), "{health:?}");
    let remark = session.source().port.remark().unwrap();
    assert_eq!(remark, "1496 frames came whole, 1 damaged, and 3 did not come");
}

#[test]
fn a_garment_of_another_size_is_refused() {
    let options = SourceOptions { garment: Some("block-4x16".into()), ..SourceOptions::default() };
    let why = open(&"flexitac:udp:7999".parse().unwrap(), &options).err().unwrap().to_string();
    assert_eq!(why, "garment block-4x16 has 64 taxels, a frame of flexitac:udp:7999 512");
}
