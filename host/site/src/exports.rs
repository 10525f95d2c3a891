//! Functions for the worker. Texts and bytes are passed by two buffers: the worker writes `taxel_room(length)`, whose
//! length it names in the call that takes them, and reads `taxel_out()`, of the length that a call has returned.
#![allow(unsafe_code)] // names that are not mangled; nothing here is unsafe otherwise

use crate::lines::{lines, lines_of};
use crate::worker::Worker;
use std::cell::RefCell;
use taxel_cli::view::Parcel;

thread_local! {
    static WORKER: RefCell<Option<Worker>> = const { RefCell::new(None) };
    static IN: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static OUT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Begin of the buffer that the worker writes, of this length.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_room(length: usize) -> *mut u8 {
    IN.with_borrow_mut(|room| {
        room.clear();
        room.resize(length, 0);
        room.as_mut_ptr()
    })
}

/// Begin of the buffer that the worker reads.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_out() -> *const u8 {
    OUT.with_borrow(|out| out.as_ptr())
}

/// Fills the buffer that the worker reads. Returns its length.
fn put(bytes: Vec<u8>) -> usize {
    OUT.set(bytes);
    OUT.with_borrow(Vec::len)
}

/// The text that the worker has written.
fn text() -> String {
    IN.with_borrow(|bytes| String::from_utf8_lossy(bytes).into_owned())
}

/// Fills it with bytes, or with a sentence that says why there are none. Returns the length, negative for a sentence.
fn answer(bytes: anyhow::Result<Vec<u8>>) -> i32 {
    match bytes {
        Ok(bytes) => put(bytes) as i32,
        Err(error) => -(put(format!("{error:#}").into_bytes()) as i32),
    }
}

/// Calls a function of the worker; none before a board is open.
fn with<T>(act: impl FnOnce(&mut Worker) -> T) -> Option<T> {
    WORKER.with_borrow_mut(|worker| worker.as_mut().map(act))
}

/// Sets the clock, us: steady, and since 1970.
#[cfg(target_family = "wasm")]
#[unsafe(no_mangle)]
pub extern "C" fn taxel_clock(steady_us: f64, calendar_us: f64) {
    taxel::time::set_page_clock(steady_us as u64, calendar_us as u64);
}

/// Opens the board that the text asks for, a JSON object of [`crate::Opening`]. Returns 0, or the negative
/// length of a sentence.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_open() -> i32 {
    let opened = serde_json::from_str(&text()).map_err(anyhow::Error::from).and_then(Worker::open);
    answer(opened.map(|worker| {
        WORKER.set(Some(worker));
        Vec::new()
    }))
}

/// Handles what has come from the board. Returns true if there may be more at once.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_turn() -> bool {
    with(Worker::turn).unwrap_or(false)
}

/// Handles a request of the page, a JSON text.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_ask() {
    let text = text();
    with(|worker| worker.ask(&text));
}

/// Takes the next message to the page. Returns its length, negative if it is an image; 0 if none is due.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_next() -> i32 {
    match with(|worker| worker.next()).flatten() {
        Some(Parcel::Line(line)) => put(line.as_bytes().to_vec()) as i32,
        Some(Parcel::Image(image)) => -(put(image) as i32),
        Some(Parcel::Closed) | None => 0,
    }
}

/// Makes the file of this name, which the page saves. Returns its length, or the negative one of a sentence.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_file() -> i32 {
    let name = text();
    let file = with(|worker| worker.file(&name));
    answer(file.unwrap_or_else(|| Err(anyhow::anyhow!("no board is open"))))
}

/// Takes bytes that the serial port has received.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_received() {
    IN.with_borrow(|bytes| with(|worker| worker.serial().receive(bytes)));
}

/// Takes the bytes that the serial port is to send. Returns their number.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_to_send() -> usize {
    put(with(|worker| worker.serial().take()).unwrap_or_default())
}

/// The serial port is gone, for the reason in the text; it is there again if that is empty.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_gone() {
    let why = text();
    with(|worker| if why.is_empty() { worker.serial().find() } else { worker.serial().lose(&why) });
}

/// Plays the script of this name once: see [`lines`]. Returns the number of bytes, or the negative length of a
/// sentence.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_lines() -> i32 {
    answer(lines(&text()))
}

/// Follows a board whose bytes come in pieces, each after its length in four bytes, the least first: see [`lines_of`].
/// Returns the number of bytes, or the negative length of a sentence.
#[unsafe(no_mangle)]
pub extern "C" fn taxel_lines_of() -> i32 {
    let pieces = IN.take();
    answer(lines_of(Pieces(&pieces)))
}

/// Pieces, each after its length.
struct Pieces<'a>(&'a [u8]);

impl<'a> Iterator for Pieces<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        let (length, rest) = self.0.split_first_chunk::<4>()?;
        let (piece, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
        self.0 = rest;
        Some(piece)
    }
}
