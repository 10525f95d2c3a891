//! Admits clients: one thread accepts, and another serves each client. If all places are taken, the client
//! served longest is disconnected, unless it may stay; so idle connections keep nobody out.

use anyhow::{Context, Result};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// Longest time that a read or a write may block.
const PATIENCE: Duration = Duration::from_secs(5);

/// The admitted clients.
#[derive(Debug, Default)]
struct Inside {
    /// Number and connection of each client that may be disconnected, in order of arrival.
    passing: Vec<(u64, TcpStream)>,
    next: u64,
}

/// An admitted client. Dropping it frees its place.
#[derive(Debug)]
pub struct Guest {
    number: u64,
    inside: Arc<Mutex<Inside>>,
}

fn lock(inside: &Mutex<Inside>) -> MutexGuard<'_, Inside> {
    // A panic of another thread leaves the list intact.
    inside.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Guest {
    /// Keeps the client for good. The caller limits the number of such clients.
    pub fn stay(&self) {
        lock(&self.inside).passing.retain(|(number, _)| *number != self.number);
    }
}

impl Drop for Guest {
    fn drop(&mut self) {
        self.stay();
    }
}

/// Admits up to `places` clients besides those that stay, and serves each in a thread of its own. Returns the
/// port. `name` is that of the threads.
pub fn open(
    name: &'static str,
    listener: TcpListener,
    places: usize,
    serve: impl Fn(TcpStream, Guest) -> Result<()> + Send + Sync + 'static,
) -> Result<u16> {
    let port =
        listener.local_addr().with_context(|| format!("the server of the {name} has no address"))?.port();
    let (inside, serve) = (Arc::new(Mutex::new(Inside::default())), Arc::new(serve));
    let accept = move || {
        for stream in listener.incoming() {
            let Ok(stream) = stream else {
                // For example, too many open files: it may pass.
                thread::sleep(Duration::from_millis(50));
                continue;
            };
            let Some((stream, guest)) = come_in(stream, &inside, places) else { continue };
            let serve = serve.clone();
            // A disconnect is not an error, and a client without a thread may retry.
            let _ = thread::Builder::new().name(name.into()).spawn(move || _ = serve(stream, guest));
        }
    };
    thread::Builder::new().name(format!("{name} door")).spawn(accept)?;
    Ok(port)
}

/// Assigns a place; none if the connection is closed.
fn come_in(stream: TcpStream, inside: &Arc<Mutex<Inside>>, places: usize) -> Option<(TcpStream, Guest)> {
    stream.set_read_timeout(Some(PATIENCE)).ok()?;
    stream.set_write_timeout(Some(PATIENCE)).ok()?;
    stream.set_nodelay(true).ok()?;
    let end = stream.try_clone().ok()?;
    let mut list = lock(inside);
    while list.passing.len() >= places.max(1) {
        // Its thread notices at its next read or write.
        let _ = list.passing.remove(0).1.shutdown(Shutdown::Both);
    }
    let number = list.next;
    list.next += 1;
    list.passing.push((number, end));
    Some((stream, Guest { number, inside: inside.clone() }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Read, Write};
    use std::net::Ipv4Addr;

    /// Greets, and waits for a word; "stay" makes the client stay.
    fn house(places: usize) -> u16 {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let serve = |mut stream: TcpStream, guest: Guest| {
            stream.write_all(b"hi")?;
            let mut word = [0; 4];
            stream.read_exact(&mut word)?;
            guest.stay();
            stream.write_all(b"ok")?;
            Ok(_ = stream.read(&mut word)?)
        };
        open("guest", listener, places, serve).unwrap()
    }

    fn greeted(port: u16) -> TcpStream {
        let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        let mut word = [0; 2];
        stream.read_exact(&mut word).unwrap();
        assert_eq!(&word, b"hi");
        stream
    }

    #[test]
    fn the_newest_is_always_let_in_and_who_stays_is_not_sent_away() {
        let port = house(3);
        let mut stays = greeted(port);
        stays.write_all(b"stay").unwrap();
        let mut word = [0; 2];
        stays.read_exact(&mut word).unwrap();
        let mut held: Vec<TcpStream> = (0..40).map(|_| greeted(port)).collect();
        let open = held.split_off(37);
        for mut gone in held {
            assert_eq!(gone.read(&mut word).unwrap_or(0), 0);
        }
        for mut stream in open.into_iter().chain([stays]) {
            stream.set_nonblocking(true).unwrap();
            let still = stream.read(&mut word).unwrap_err();
            assert_eq!(still.kind(), std::io::ErrorKind::WouldBlock);
        }
    }
}
