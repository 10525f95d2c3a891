//! Commands that show a board where none, or several are plugged in.

use super::stage::{board, boards, command, ended, folder, opened, terminal, wait};
use std::io::Read;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Runs a command at a terminal, until it ends or has said these words. Returns its status, what it has written to
/// the terminal, and its errors.
fn at_terminal(folder: &Path, ports: &str, words: &[&str], until: &str) -> (Option<i32>, String, String) {
    let (mut master, name) = terminal();
    // As long as it is open here, what the program has written can be read after its end.
    let held = opened(&name);
    let mut command = command(folder, ports, words);
    let errors = folder.join("errors.txt");
    command.stdout(opened(&name)).stderr(std::fs::File::create(&errors).unwrap());
    let mut child = command.spawn().unwrap();
    drop(command);
    let (mut seen, mut buffer, began) = (Vec::new(), [0; 4096], Instant::now());
    let mut status = None;
    while !String::from_utf8_lossy(&seen).contains(until) && began.elapsed() < Duration::from_secs(60) {
        match master.read(&mut buffer) {
            Ok(count) => seen.extend_from_slice(&buffer[..count]),
            // It has ended, and all that it has written is read.
            Err(_) if status.is_some() => break,
            Err(_) => status = child.try_wait().unwrap().and_then(|ended| ended.code()),
        }
    }
    if status.is_none() {
        let _ = child.kill();
    }
    child.wait().unwrap();
    drop(held);
    (status, String::from_utf8_lossy(&seen).into_owned(), std::fs::read_to_string(errors).unwrap())
}

#[test]
fn a_bare_call_plays_a_simulation_only_where_no_board_is_plugged_in() {
    let here = folder("bare");
    let end = ended(command(&here, "", &[]));
    let first = "playing sim:pat, a simulated board: no board is plugged in: ";
    assert_eq!(end.status, Some(0), "{}", end.error);
    assert!(end.error.starts_with(first), "{}", end.error);
    assert!(end.output.contains("hello: simulated board, taxel-sim "), "{}", end.output);
    for opens in ["hung", "busy", "not permitted"] {
        let end = ended(command(&here, &boards(&[("A1", opens)]), &[]));
        assert_eq!((end.status, end.output.as_str()), (Some(3), ""), "{opens}: {}", end.error);
    }
}

#[test]
fn a_command_at_a_terminal_plays_a_simulation_only_where_no_board_is_plugged_in() {
    let here = folder("terminal");
    let live = ["live", "--json", "--frames", "2"];
    let (status, seen, errors) = at_terminal(&here, "", &live, "\"type\":\"frame\"");
    assert!(seen.contains("\"simulated\":true"), "{status:?} {seen} {errors}");
    assert!(errors.starts_with("playing sim:pat, a simulated board: no board is plugged in"), "{errors}");
    let (_, seen, errors) = at_terminal(&here, "", &["view", "--port", "0"], "(Ctrl-C ends)");
    assert!(seen.starts_with("sim:pat at http://127.0.0.1:"), "{seen} {errors}");
    assert!(errors.starts_with("playing sim:pat, a simulated board: no board is plugged in"), "{errors}");
    for words in [&["live", "--source", "auto", "--json"][..], &["view", "--source", "auto", "--port", "0"]] {
        let (status, seen, errors) = at_terminal(&here, "", words, "nothing says this");
        assert_eq!((status, seen.as_str()), (Some(3), ""), "{words:?}: {errors}");
    }
    let hung = boards(&[("A1", "hung")]);
    let (status, _, errors) = at_terminal(&here, &hung, &live, "nothing says this");
    assert_eq!(status, Some(3), "{errors}");
}

#[test]
fn of_several_boards_the_shown_one_is_named_and_a_serial_number_names_another() {
    let here = folder("several");
    let ports = boards(&[("A1", &board()), ("B2", &board())]);
    let live = ["live", "--json", "--frames", "2"];
    let end = ended(command(&here, &ports, &live));
    assert_eq!(end.status, Some(0), "{}", end.error);
    let first = "usb:/dev/ttyTAXEL0 is shown; other boards are plugged in: usb:B2 (/dev/ttyTAXEL1)\n";
    assert!(end.error.starts_with(first), "{}", end.error);
    let end = ended(command(&here, &ports, &["doctor", "--source", "usb:B2", "--for", "1s"]));
    assert!(end.output.starts_with("usb:/dev/ttyTAXEL1\n"), "{} {}", end.output, end.error);
    assert!(end.output.contains("this is a simulated board"), "{}", end.output);
    let end = ended(command(&here, &ports, &["save", "--source", "usb:A1"]));
    let words = "usb:/dev/ttyTAXEL0 is simulated: what it has saved is gone once it ends, nothing lasts.\n";
    assert_eq!((end.status, end.output.as_str()), (Some(0), words), "{}", end.error);
    let end = ended(command(&here, &ports, &["save", "--source", "usb:C3"]));
    assert!(
        end.error.contains("no board on USB has the serial number C3: there are A1 on /dev/ttyTAXEL0, B2 on"),
        "{}",
        end.error
    );
    assert_eq!(end.status, Some(3));
}

#[test]
fn what_is_simulated_says_so_in_lines_recordings_and_reports() {
    let here = folder("says-so");
    let run = |words: &[&str]| {
        let end = ended(command(&here, "", words));
        assert_eq!(end.status, Some(0), "{words:?}: {}", end.error);
        end.output
    };
    let lines = run(&["live", "--source", "sim:pat", "--frames", "2", "--json"]);
    assert!(lines.starts_with("{\"type\":\"hello\",") && lines.contains("\"simulated\":true"), "{lines}");
    run(&["record", "--source", "sim:pat", "--frames", "20", "-o", "a.mcap"]);
    assert!(run(&["info", "a.mcap"]).contains("  simulated          true\n"));
    run(&["report", "a.mcap", "-o", "a.html"]);
    let page = std::fs::read_to_string(here.join("a.html")).unwrap();
    assert!(page.contains("<p>simulated board, taxel-sim "), "{}", &page[..2000]);
}

#[test]
fn a_board_that_is_waited_for_is_followed_once_it_is_plugged_in() {
    let here = folder("waited");
    let mut command = command(&here, "", &["live", "--json", "--frames", "2", "--wait"]);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut errors = std::io::BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    std::io::BufRead::read_line(&mut errors, &mut line).unwrap();
    assert!(
        line.starts_with("no board is plugged in: ") && line.ends_with("; waiting for it (Ctrl-C ends)\n"),
        "{line}"
    );
    // In one step: the program reads the list at any time.
    std::fs::write(here.join("new.toml"), boards(&[("A1", &board())])).unwrap();
    std::fs::rename(here.join("new.toml"), here.join("ports.toml")).unwrap();
    let mut output = String::new();
    child.stdout.take().unwrap().read_to_string(&mut output).unwrap();
    assert_eq!((wait(&mut child), output.matches("\"type\":\"frame\"").count()), (Some(0), 2), "{output}");
}
