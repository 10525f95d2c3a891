//! Small reports that are kept encoded until the link has room: of each number the newest.

use super::reports::{Reports, only};
use crate::wire::write;
use heapless::Vec;
use serde::ser::{Serialize, SerializeTuple, Serializer};

/// Longest body of such a report: that of a `Budget`.
const LONGEST: usize = 64;
/// Greatest number of them.
const NUMBERS: usize = 4;

/// The bodies of reports that wait, with their numbers.
pub(super) struct Latest {
    bodies: [Option<(u32, NotedBody)>; NUMBERS],
}

/// The fields of a report as they are written.
pub(super) struct NotedBody(Vec<u8, LONGEST>);

impl Latest {
    pub const fn new() -> Latest {
        Latest { bodies: [const { None }; NUMBERS] }
    }

    /// The reports that wait.
    pub fn due(&self) -> Reports {
        self.bodies.iter().flatten().fold(0, |all, (number, _)| all | only(*number))
    }

    /// True if such a report waits.
    pub fn has(&self, number: u32) -> bool {
        self.due() & only(number) != 0
    }

    /// Puts a report in place of an older one of its number.
    #[inline(never)]
    pub fn put(&mut self, number: u32, report: &impl Serialize) {
        self.take(number);
        let mut body = [0; LONGEST];
        let written = write(report, &mut body).ok().and_then(|bytes| body.get(..bytes));
        // There are as many places as reports that are kept here, and each has room.
        let Some(body) = written.and_then(|bytes| Vec::from_slice(bytes).ok()) else { return };
        if let Some(place) = self.bodies.iter_mut().find(|place| place.is_none()) {
            *place = Some((number, NotedBody(body)));
        }
    }

    /// Takes the report of this number.
    pub fn take(&mut self, number: u32) -> Option<NotedBody> {
        let waits = |place: &mut Option<(u32, NotedBody)>| place.take_if(|(waits, _)| *waits == number);
        self.bodies.iter_mut().find_map(waits).map(|(_, body)| body)
    }

    /// Drops all of them.
    pub fn clear(&mut self) {
        self.bodies.fill_with(|| None);
    }
}

impl Serialize for NotedBody {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_tuple(self.0.len())?;
        for byte in &self.0 {
            fields.serialize_element(byte)?;
        }
        fields.end()
    }
}
