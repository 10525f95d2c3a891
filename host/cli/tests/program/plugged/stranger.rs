//! Something on a port that is no board.

use super::stage::{command, ended, folder, stranger};
use std::thread;

/// Lines of 252 numbers.
fn rows() -> Vec<u8> {
    let row = (0..252).map(|number| (number * 7 % 100).to_string()).collect::<Vec<_>>().join(",");
    format!("{row}\r\n").into_bytes()
}

#[test]
fn a_port_that_speaks_otherwise_is_reported_as_that() {
    let lines = [
        "live",
        "live --json --frames 5",
        "view --port 0",
        "record -o a.mcap",
        "save",
        "health",
        "doctor",
        "setup",
    ];
    let cells = lines.map(|line| {
        thread::spawn(move || {
            let here = folder(&format!("stranger-{}", line.split(' ').collect::<Vec<_>>().join("-")));
            let source = format!("serial:{}@115200", stranger(rows()));
            let words: Vec<&str> = line.split(' ').chain(["--source", &source]).collect();
            let end = ended(command(&here, "", &words));
            let (error, output) = (&end.error, &end.output);
            assert_eq!(end.status, Some(3), "{line}: {output}{error}");
            assert!(
                error.contains(" bytes of text lines of 252 numbers: no taxel board"),
                "{line}: {output}{error}"
            );
            let advice = format!(
                "`taxel live numbers:{}@115200,rows=14,columns=18` reads it as numbers",
                &source[7..source.len() - 7]
            );
            assert!(error.contains(&advice), "{line}: {output}{error}");
            assert!(!error.contains("flash") && !output.contains("flash"), "{line}: {output}{error}");
            assert!(end.seconds < 20.0, "{line}: {:.1} s", end.seconds);
        })
    });
    cells.into_iter().for_each(|cell| cell.join().unwrap());
}

#[test]
fn bytes_at_another_speed_are_reported_as_that() {
    let here = folder("speed");
    let noise = (0..3000u32).map(|number| (number.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let source = format!("serial:{}@9600", stranger(noise));
    let end = ended(command(&here, "", &["live", "--source", &source]));
    assert_eq!(end.status, Some(3), "{}", end.error);
    assert!(end.error.contains(" bytes of unknown form: no taxel board, or another speed"), "{}", end.error);
}

#[test]
fn a_stranger_is_named_with_the_command_that_reads_it() {
    let here = folder("overheard");
    let ports = format!("[[port]]\nname = \"/dev/ttyMAT\"\nopens = \"{}\"\n", stranger(rows()));
    let end = ended(command(&here, &ports, &["ports", "--listen"]));
    let wanted = "`taxel live numbers:/dev/ttyMAT@115200,rows=14,columns=18` reads it as numbers: the shape is a guess";
    assert!(end.status == Some(0) && end.output.contains(wanted), "{}{}", end.output, end.error);
}
