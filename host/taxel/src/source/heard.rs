//! A port from which bytes were read already.

use super::Port;
use crate::recording::GapMark;
use std::io;
use std::time::Duration;

/// A port from which bytes were read already; they are read again.
pub struct Heard {
    heard: Vec<u8>,
    next: usize,
    port: Box<dyn Port>,
}

impl Heard {
    /// This port, from which these bytes are read first.
    pub fn new(port: Box<dyn Port>, heard: Vec<u8>) -> Heard {
        Heard { heard, next: 0, port }
    }
}

impl Port for Heard {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        let left = &self.heard[self.next..];
        if left.is_empty() {
            return self.port.read(buffer);
        }
        let count = left.len().min(buffer.len());
        buffer[..count].copy_from_slice(&left[..count]);
        self.next += count;
        if self.next == self.heard.len() {
            (self.heard, self.next) = (Vec::new(), 0);
        }
        Ok(Some(count))
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.port.write(bytes)
    }

    fn own_requests(&mut self) -> Vec<u8> {
        self.port.own_requests()
    }

    fn keeps(&self) -> Duration {
        self.port.keeps()
    }

    fn gap(&mut self) -> Option<GapMark> {
        self.port.gap()
    }

    fn news(&mut self) -> Option<String> {
        self.port.news()
    }

    fn remark(&self) -> Option<String> {
        self.port.remark()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEEPS: Duration = Duration::from_secs(3);

    /// A link with something to say.
    struct Link;

    impl Port for Link {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
            buffer[0] = 3;
            Ok(Some(1))
        }

        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            Ok(bytes.len())
        }

        fn own_requests(&mut self) -> Vec<u8> {
            vec![4]
        }

        fn keeps(&self) -> Duration {
            KEEPS
        }

        fn news(&mut self) -> Option<String> {
            Some("two publish it".into())
        }

        fn remark(&self) -> Option<String> {
            Some("the end".into())
        }
    }

    #[test]
    fn a_link_is_the_same_behind_what_was_heard_of_it() {
        let mut heard = Heard::new(Box::new(Link), vec![1, 2]);
        let mut buffer = [0];
        let read = std::iter::repeat_with(|| heard.read(&mut buffer).unwrap().map(|_| buffer[0]));
        assert_eq!(read.take(4).collect::<Vec<_>>(), [1, 2, 3, 3].map(Some));
        assert_eq!((heard.write(&[5, 6]).unwrap(), heard.own_requests(), heard.keeps()), (2, vec![4], KEEPS));
        assert_eq!(
            (heard.news().as_deref(), heard.remark().as_deref()),
            (Some("two publish it"), Some("the end"))
        );
    }
}
