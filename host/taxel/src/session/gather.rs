//! Bytes that are read together: a processor's caches hold the state of one board, not of a hundred, so that whoever
//! handles much, and not at once, handles several frames of a board at a time.

use std::time::Duration;

/// Time at which to read again.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Gather {
    /// Time in which bytes gather.
    pub time: Duration,
    /// The last read left bytes behind.
    is_behind: bool,
}

impl Gather {
    /// Returns how long to wait before the next read, of a link that keeps bytes for a time, so long after the last
    /// bytes.
    pub fn pause(&self, keeps: Duration, since: Duration) -> Duration {
        if self.is_behind { Duration::ZERO } else { self.time.min(keeps).saturating_sub(since) }
    }

    /// So many bytes were read into this room. If they fill it, more wait, and a pause after each read would hold
    /// back a board that sends more in that time.
    pub fn read(&mut self, count: usize, room: usize) {
        self.is_behind = count == room;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_gather_as_long_as_the_link_keeps_them_and_none_wait_behind_a_full_room() {
        let ms = Duration::from_millis;
        let mut gather = Gather { time: ms(40), ..Gather::default() };
        assert_eq!(gather.pause(ms(100), ms(0)), ms(40));
        assert_eq!(gather.pause(ms(100), ms(15)), ms(25));
        assert_eq!(gather.pause(ms(10), ms(4)), ms(6));
        assert_eq!(gather.pause(ms(10), ms(90)), ms(0));
        assert_eq!(gather.pause(ms(0), ms(0)), ms(0));
        gather.read(4096, 4096);
        assert_eq!(gather.pause(ms(100), ms(0)), ms(0));
        gather.read(4095, 4096);
        assert_eq!(gather.pause(ms(100), ms(0)), ms(40));
        assert_eq!(Gather::default().pause(ms(100), ms(0)), ms(0));
    }
}
