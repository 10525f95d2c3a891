//! Runs: pieces of a row in which every taxel is touched.

/// No contact.
pub(super) const NONE: u16 = u16::MAX;

/// A piece of a row in which every taxel is at least the low threshold. The first run of a part stands for the part and
/// carries its sums.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    /// sum f of the part; fits, since taxels and values have 16 bits
    pub mass: u32,
    /// over all panels
    pub row: u16,
    pub left: u16,
    /// last column
    pub right: u16,
    /// A run of the same part with a smaller index, or itself.
    pub parent: u16,
    /// For the first run of a part: the same, between parts that a seam joins.
    pub group: u16,
    /// For the first run of a part: the index of its contact, or [`NONE`].
    pub contact: u16,
    /// taxels of the part
    pub area: u16,
    /// greatest value of the part; of any other run at least its own greatest value
    pub peak: u16,
    pub panel: u8,
    /// The part comes within one taxel of a contact of the previous frame; asked of faint parts only.
    pub held: bool,
    /// A seam joins the part to another.
    pub joined: bool,
    /// How many of the two rows beside it have a run that covers it but for its ends.
    pub covers: u8,
}

impl Run {
    /// The place of the first taxel as one word, in the order of the runs.
    pub const fn key(&self) -> u32 {
        key(self.row, self.left)
    }

    /// Adds the sums of others to those of the part.
    pub fn add(&mut self, mass: u32, area: u16, peak: u16) {
        self.mass = self.mass.wrapping_add(mass);
        self.area = self.area.saturating_add(area);
        self.peak = self.peak.max(peak);
    }

    /// Whether all taxels above and below belong to a run, but for those at the ends.
    pub const fn is_inside(&self) -> bool {
        self.covers == 2
    }

    /// Whether the columns `left ..= right` of its own row all belong to it.
    pub const fn covers(&self, row: u16, left: u16, right: u16) -> bool {
        self.row == row && self.left <= left && self.right >= right
    }
}

/// A place as one word, in the order of the runs.
pub(super) const fn key(row: u16, column: u16) -> u32 {
    (row as u32) << 16 | column as u32
}

/// What a row, or the rest of it, begins with: taxels from a threshold on.
pub(super) struct Stretch {
    pub length: usize,
    /// sum f
    pub mass: u32,
    /// greatest f
    pub peak: u32,
}

impl Stretch {
    /// Measures it.
    #[inline(never)] // the few registers of an M0+ are for its loop
    pub fn of(values: &[u16], low: u32) -> Stretch {
        let (mut mass, mut peak, mut rest) = (0u32, 0u32, values);
        while let [value, after @ ..] = rest {
            let value = u32::from(*value);
            if value < low {
                break;
            }
            mass = mass.wrapping_add(value);
            if value > peak {
                peak = value;
            }
            rest = after;
        }
        Stretch { length: values.len() - rest.len(), mass, peak }
    }
}
