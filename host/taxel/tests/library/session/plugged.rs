//! Ports that a test hands in: which board is opened, and what is reported where none can be.

use super::rig::{self, Rig};
use serialport::{SerialPortInfo, SerialPortType, UsbPortInfo};
use std::io;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use taxel::error::{ErrorKind, SourceError};
use taxel::session::{Returns, Session};
use taxel::source::{self, Port, Ports, SerialPorts, Source, SourceOptions};

/// USB ids of a board and of a probe.
const BOARD: (u16, u16) = (0x1209, 0x0001);
const PROBE: (u16, u16) = (0x2e8a, 0x000c);

/// What is behind a port.
enum Behind {
    Board(Arc<Mutex<Rig>>),
    Nothing,
    Bytes(&'static [u8]),
    Fault(fn(String) -> SourceError),
}

/// A port: USB id, serial number, and what is behind.
type BenchPort = ((u16, u16), Option<&'static str>, Behind);

/// Ports of a machine.
struct Bench(Vec<BenchPort>);

impl Ports for Bench {
    fn list(&self) -> Vec<SerialPortInfo> {
        let port = |(at, ((vid, pid), serial, _)): (usize, &BenchPort)| {
            let (vid, pid, serial_number) = (*vid, *pid, serial.map(String::from));
            let usb = UsbPortInfo { vid, pid, serial_number, manufacturer: None, product: None };
            SerialPortInfo { port_name: format!("port{at}"), port_type: SerialPortType::UsbPort(usb) }
        };
        self.0.iter().enumerate().map(port).collect()
    }

    fn open(&self, name: &str, _: u32) -> Result<Box<dyn Port>, SourceError> {
        let at: usize = name.trim_start_matches("port").parse().unwrap();
        match &self.0[at].2 {
            Behind::Board(rig) => Ok(rig::open(rig).unwrap().port),
            Behind::Nothing => Ok(Box::new(Says(b""))),
            Behind::Bytes(bytes) => Ok(Box::new(Says(bytes))),
            Behind::Fault(fault) => Err(fault(format!("{name} is at fault"))),
        }
    }
}

/// A port that says the same again and again.
struct Says(&'static [u8]);

impl Port for Says {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        std::thread::sleep(Duration::from_millis(5));
        buffer[..self.0.len()].copy_from_slice(self.0);
        Ok(Some(self.0.len()))
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len())
    }
}

/// A board that streams already.
fn board() -> Behind {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let mut session = Session::new(rig::source(&rig), Returns::Never);
    session.parts().0.start(0).unwrap();
    while session.client().description().is_none() {
        session.poll().unwrap();
    }
    Behind::Board(rig)
}

fn open(spec: &str, first: bool, ports: Vec<BenchPort>) -> taxel::Result<Source> {
    let options = SourceOptions { first, ports: SerialPorts::new(Bench(ports)), ..SourceOptions::default() };
    source::open(&spec.parse().unwrap(), &options)
}

/// Kind and sentence of the error, which comes within 3 s.
fn fault(spec: &str, ports: Vec<BenchPort>) -> (&'static str, String) {
    let began = Instant::now();
    let Err(error) = open(spec, false, ports) else { panic!("{spec}: it is open") };
    assert!(began.elapsed() < Duration::from_secs(3), "{error}: {:?}", began.elapsed());
    let kind = match error.kind() {
        ErrorKind::Source(SourceError::NoBoard(_)) => "none",
        ErrorKind::Source(SourceError::Silent(_)) => "silent",
        ErrorKind::Source(SourceError::Busy(_)) => "busy",
        ErrorKind::Source(SourceError::NotPermitted(_)) => "not permitted",
        ErrorKind::Source(SourceError::SeveralBoards(_)) => "several",
        ErrorKind::Source(SourceError::Foreign(_)) => "foreign",
        other => panic!("{other:?}"),
    };
    (kind, error.to_string())
}

#[test]
fn a_board_that_cannot_be_used_is_reported_by_its_fault_and_nothing_is_simulated() {
    let none = fault("auto", vec![]);
    let ids = "no serial port has the USB id of a board, 1209:0001";
    assert_eq!(none, ("none", format!("no board is plugged in: {ids}, or of a probe")));
    assert_eq!(
        fault("usb", vec![(PROBE, None, board())]),
        ("none", format!("no board is plugged in: {ids}"))
    );
    let hung = "usb:port0 is silent: it sends no Hello of a taxel board in 1.5 s";
    assert_eq!(fault("auto", vec![(BOARD, Some("A1"), Behind::Nothing)]), ("silent", hung.into()));
    let busy = vec![(BOARD, Some("A1"), Behind::Fault(SourceError::Busy))];
    assert_eq!(fault("usb:A1", busy), ("busy", "port0 is at fault".into()));
    // Ports are listened to at the same time, and what the user can mend counts.
    let probes = vec![
        (PROBE, None, Behind::Nothing),
        (PROBE, None, Behind::Nothing),
        (PROBE, None, Behind::Fault(SourceError::NotPermitted)),
    ];
    let (kind, reported) = fault("auto", probes);
    assert_eq!(kind, "not permitted");
    assert!(
        reported.starts_with("serial:port0@921600 is silent: ") && reported.ends_with(", port2 is at fault"),
        "{reported}"
    );
    let (kind, reported) = fault("auto", vec![(PROBE, None, Behind::Bytes(b"1 2 3\n"))]);
    assert!(
        kind == "foreign" && reported.ends_with(" bytes of text lines of 3 numbers: no taxel board"),
        "{reported}"
    );
}

#[test]
fn of_several_boards_none_is_taken_unless_it_is_named_or_the_first_will_do() {
    let two =
        || vec![(BOARD, Some("A1"), board()), (BOARD, Some("B2"), board()), (PROBE, Some("P3"), board())];
    let several = "2 boards are plugged in: name one of usb:A1 (port0), usb:B2 (port1)";
    assert_eq!(fault("auto", two()), ("several", several.into()));
    // The one that is meant may be the one that is busy.
    let busy = vec![(BOARD, Some("A1"), Behind::Fault(SourceError::Busy)), (BOARD, None, board())];
    assert_eq!(fault("usb", busy).1, "2 boards are plugged in: name one of usb:A1 (port0), serial:port1");
    for (spec, label) in [("usb:B2", "usb:port1"), ("usb:P3", "serial:port2@921600")] {
        let source = open(spec, false, two()).unwrap();
        assert_eq!((source.label.as_str(), source.others.len()), (label, 0));
    }
    let first = open("auto", true, two()).unwrap();
    assert_eq!((first.label.as_str(), first.others.join(", ").as_str()), ("usb:port0", "usb:B2 (port1)"));
    let hung = vec![(BOARD, Some("A1"), Behind::Nothing), (BOARD, Some("B2"), board())];
    let first = open("auto", true, hung).unwrap();
    assert_eq!((first.label.as_str(), first.others.join(", ").as_str()), ("usb:port1", "usb:A1 (port0)"));
    let probes =
        vec![(PROBE, Some("P1"), board()), (PROBE, Some("P2"), board()), (PROBE, None, Behind::Nothing)];
    let several = "2 boards are plugged in: name one of usb:P1 (port0), usb:P2 (port1)";
    assert_eq!(fault("auto", probes), ("several", several.into()));
    let (kind, reported) = fault("usb:C3", two());
    assert_eq!(
        (kind, reported.as_str()),
        ("none", "no board on USB has the serial number C3: there are A1 on port0, B2 on port1, P3 on port2")
    );
}

#[test]
fn what_was_heard_while_a_board_was_found_is_not_lost() {
    let source = open("auto", false, vec![(BOARD, Some("A1"), board())]).unwrap();
    assert_eq!(source.usb_serial.as_deref(), Some("A1"));
    let mut session = Session::over(source).unwrap();
    while session.client().counts().frames < 5 {
        session.poll().unwrap();
    }
    assert_eq!(session.client().counts().lost, 0);
}

#[test]
fn something_that_speaks_otherwise_ends_the_session() {
    let source =
        Source::real("serial:x@9600", Says(b"T 21.5\r\n"), || Err(taxel::Error::other("it is there")));
    let mut session = Session::over(source).unwrap();
    let began = Instant::now();
    let error = loop {
        if let Err(error) = session.poll() {
            break error;
        }
        assert!(began.elapsed() < Duration::from_secs(20), "it goes on");
    };
    assert!(matches!(error.kind(), ErrorKind::Source(SourceError::Foreign(_))), "{error}");
    assert!(error.to_string().ends_with(" bytes of text: no taxel board"), "{error}");
}
