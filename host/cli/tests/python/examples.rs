//! The examples in Python.

use crate::python;
use crate::start::{root, taxel};
use std::io::Write;
use std::net::TcpListener;
use std::process::{Command, Stdio};

fn said(args: &[&str]) -> String {
    let output = Command::new(taxel()).args(args).output().unwrap();
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_python_example_draws_from_a_pipe_and_from_tcp() {
    let lines = said(&["live", "--source", "sim:press", "--frames", "120", "--json", "--pixels"]);
    let script = root().join("examples/python/draw.py");
    assert!(std::fs::read_to_string(&script).unwrap().lines().count() <= 30);
    let mut child = python().arg(&script).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let (mut pipe, sent) = (child.stdin.take().unwrap(), lines.clone());
    let writer = std::thread::spawn(move || pipe.write_all(sent.as_bytes()));
    let piped = child.wait_with_output().unwrap();
    writer.join().unwrap().unwrap();
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port().to_string();
    let server = std::thread::spawn(move || listener.accept().unwrap().0.write_all(lines.as_bytes()));
    let streamed = python().arg(&script).args(["127.0.0.1", &port]).output().unwrap();
    server.join().unwrap().unwrap();
    for output in [piped, streamed] {
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert!(text.contains("chest, ") && text.contains("contact 1 at ") && text.contains('#'), "{text}");
    }
}

/// There is no launch of ROS here: only its syntax is checked, and its options in `tests/program/ros2.rs`.
#[test]
fn the_launch_file_is_python() {
    let file = root().join("examples/ros2/taxel.launch.py");
    let check = "import ast, sys; ast.parse(open(sys.argv[1]).read())";
    assert!(python().args(["-c", check]).arg(file).status().unwrap().success());
}
