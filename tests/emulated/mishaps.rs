//! What goes wrong while the firmware image runs, besides what reads a garment wrongly: the DMA, the clock,
//! the links, the stack. `cargo xtask test --only emulator-mishaps`.

use crate::board::Emulated;
use std::time::Instant;
use taxel_core::boot::BootCause;
use taxel_core::capacity::TAXELS;
use taxel_core::garment::Garment;
use taxel_core::wire::{Frame, Hello, Report, Request};

/// A frame, us.
const FRAME_US: u64 = 5_120;
/// The brown-out detector's register: 0.946 V, switched on.
const BROWN_OUT: u64 = 0xb1;

fn start(options: &[&str]) -> Emulated {
    let mut board = Emulated::start(&Garment::reference(), &[100; TAXELS], 100, options);
    board.receive();
    board
}

/// Number and time of the next frame.
fn next_frame(board: &mut Emulated) -> (u32, u64) {
    loop {
        if let Report::Frame(Frame { frame, time, .. }) = board.receive().report() {
            return (frame, time.0);
        }
    }
}

#[test]
fn a_chain_that_a_bus_error_has_broken_begins_anew() {
    let mut board = start(&[]);
    board.ask(&Request::Start);
    next_frame(&mut board);
    for _ in 0..3 {
        let broken = board.look("dma-error").as_f64().unwrap() as u64;
        let mut reported = false;
        loop {
            match board.receive().report() {
                Report::Log(log) => reported |= log.text == "scan: the converter stands still",
                Report::Frame(Frame { time, .. }) if reported => {
                    let after_ms = (time.0 - broken) as f64 / 1e3;
                    println!("a bus error: frames again {after_ms:.1} ms later");
                    assert!(after_ms < 60.0, "{after_ms}");
                    break;
                }
                _ => {}
            }
        }
    }
    board.end();
}

/// The channel of the checksums, as in firmware/src/sniffer.rs.
const CHECKSUMS: u32 = 11;

#[test]
fn checksums_are_computed_by_table_when_their_dma_does_not_end() {
    let mut board = start(&[]);
    board.ask(&Request::Start);
    let sniffed = |board: &mut Emulated| board.look("stats")["sniffed"].as_u64().unwrap();
    // What comes is checked by its sum.
    let twenty = |board: &mut Emulated| {
        let (first, began) = next_frame(board);
        let mut last = (first, began);
        while last.0 < first + 20 {
            last = next_frame(board);
        }
        (last.1 - began) / u64::from(last.0 - first)
    };
    let before = sniffed(&mut board);
    let whole_us = twenty(&mut board);
    let jammed = sniffed(&mut board);
    assert!(jammed > before + 20 * 8, "the DMA computes the sums: {before}, {jammed}");
    board.jam(CHECKSUMS);
    let after = sniffed(&mut board);
    let jammed_us = twenty(&mut board);
    println!("{whole_us} us from frame to frame; {jammed_us} us without the DMA's checksums");
    assert_eq!(sniffed(&mut board), after, "nothing is sniffed any more");
    assert!(jammed_us.abs_diff(FRAME_US) < 100, "{jammed_us}");
    board.end();
}

#[test]
fn the_clock_may_pass_the_lower_half_of_its_word() {
    let turn = 1u64 << 32;
    let begin = (turn - 700_000).to_string();
    let mut board = start(&["--clock", &begin]);
    board.ask(&Request::Start);
    let (mut last, mut passed) = (next_frame(&mut board), 0);
    while passed < 20 {
        let next = next_frame(&mut board);
        let (frames, us) = (u64::from(next.0 - last.0), next.1 - last.1);
        assert!(us.abs_diff(frames * FRAME_US) < 100, "{frames} frames in {us} us at {}", next.1);
        passed += u32::from(next.1 > turn);
        last = next;
    }
    println!("frames go on at {} us, past 2^32", last.1);
    board.end();
}

#[test]
fn a_program_that_has_usb_open_and_does_not_read_leaves_the_uart_speaking() {
    let mut board = start(&["--link", "usb"]);
    board.ask(&Request::Start);
    next_frame(&mut board);
    let uart = |board: &mut Emulated| board.look("stats")["uart"].as_u64().unwrap();
    let began = board.look("stats")["emulated_us"].as_u64().unwrap();
    let before = uart(&mut board);
    board.read_on(false);
    let limit = Instant::now();
    while uart(&mut board) < before + 1_000 {
        assert!(limit.elapsed().as_secs() < 120, "the UART stays silent");
    }
    let after_s = (board.look("stats")["emulated_us"].as_u64().unwrap() - began) as f64 / 1e6;
    println!("the UART speaks {after_s:.1} s after the program stopped reading");
    assert!(after_s < 4.0, "{after_s}");
    board.forgiving = true;
    board.read_on(true);
    let (first, _) = next_frame(&mut board);
    let (second, _) = next_frame(&mut board);
    println!("and USB again, from frame {first} on");
    assert!(second > first);
    board.end();
}

#[test]
fn a_stack_that_leaves_the_memory_ends_in_a_restart() {
    let mut board = start(&["--restarts"]);
    board.forgiving = true;
    assert_eq!(board.look("stats")["brown_out"], BROWN_OUT);
    board.look("sink");
    board.wait_for("lockup");
    assert_eq!(board.wait_for("reset")["reset"], "watchdog");
    loop {
        if let Report::Hello(Hello { boot: Some(boot), .. }) = board.receive().report()
            && boot.resets == 1
        {
            assert_eq!(boot.cause, BootCause::Watchdog);
            break;
        }
    }
    board.end();
}
