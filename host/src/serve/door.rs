//! Who is let in: a thread that accepts, and one for each guest. Where all places are taken, who has been
//! served longest goes, unless he may stay; so whoever holds connections open keeps nobody out.

use anyhow::{Context, Result};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// How long a read or a write may stand still.
const PATIENCE: Duration = Duration::from_secs(5);

/// Who is inside.
#[derive(Debug, Default)]
struct Inside {
    /// Number and connection of each guest that does not stay, in the order in which they came.
    passing: Vec<(u64, TcpStream)>,
    next: u64,
}

/// A guest. One that is dropped leaves its place.
#[derive(Debug)]
pub struct Guest {
    number: u64,
    inside: Arc<Mutex<Inside>>,
}

fn lock(inside: &Mutex<Inside>) -> MutexGuard<'_, Inside> {
    // A thread that panicked leaves the list whole.
    inside.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Guest {
    /// Is sent away for nobody from now on: whoever lets guests stay counts them.
    pub fn stay(&self) {
        lock(&self.inside).passing.retain(|(number, _)| *number != self.number);
    }
}

impl Drop for Guest {
    fn drop(&mut self) {
        self.stay();
    }
}

/// Lets guests in, so many at a time beside those that stay, and serves each from a thread of its own; the
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
                // Too many files are open, say: it may pass.
                thread::sleep(Duration::from_millis(50));
                continue;
            };
            let Some((stream, guest)) = come_in(stream, &inside, places) else { continue };
            let serve = serve.clone();
            // A disconnect in the middle is no error of ours, and who finds no thread may come again.
            let _ = thread::Builder::new().name(name.into()).spawn(move || _ = serve(stream, guest));
        }
    };
    thread::Builder::new().name(format!("{name} door")).spawn(accept)?;
    Ok(port)
}

/// Gives a guest a place; none: the connection has gone.
fn come_in(stream: TcpStream, inside: &Arc<Mutex<Inside>>, places: usize) -> Option<(TcpStream, Guest)> {
    stream.set_read_timeout(Some(PATIENCE)).ok()?;
    stream.set_write_timeout(Some(PATIENCE)).ok()?;
    stream.set_nodelay(true).ok()?;
    let end = stream.try_clone().ok()?;
    let mut list = lock(inside);
    while list.passing.len() >= places.max(1) {
        // Its thread notices by its next read or write.
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

    /// Greets, and waits for a word: who says "stay" stays.
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
