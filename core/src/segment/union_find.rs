//! Provisional labels: connected taxels of one panel, joined by union-find.

/// Index that stands for no label, no component or no contact.
pub(crate) const NONE: u16 = u16::MAX;

/// A provisional label: union-find node of one panel, with the sums of its taxels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Label {
    /// sum f; fits in 32 bits, since taxels and values have 16 bits each
    pub mass: u32,
    /// Union-find parent: a label with a smaller index, or itself for a root. Once the frame is scanned, it
    /// is the root, which has the sums of all its labels.
    pub parent: u16,
    /// Only of a root: its parent among the roots that seams join.
    pub group: u16,
    /// Index of its contact, or [`NONE`].
    pub contact: u16,
    /// Number of taxels.
    pub area: u16,
    /// Greatest value, counts: 16 bits, held in a word because an M0+ loads that faster.
    pub peak: u32,
    pub panel: u8,
    /// True if it comes within one taxel of a contact of the previous frame; set in frames with a faint
    /// label.
    pub held: bool,
    /// True if a seam joins it to another label.
    pub joined: bool,
}

impl Label {
    /// Label number `index`, without taxels.
    pub const fn new(index: u16, panel: u8) -> Label {
        Label {
            mass: 0,
            parent: index,
            group: index,
            contact: NONE,
            area: 0,
            peak: 0,
            panel,
            held: false,
            joined: false,
        }
    }

    /// Adds the sums of other taxels.
    #[cfg_attr(target_pointer_width = "64", inline)]
    pub fn add(&mut self, mass: u32, area: u16, peak: u16) {
        self.mass = self.mass.wrapping_add(mass);
        self.area = self.area.saturating_add(area);
        self.peak = self.peak.max(peak.into());
    }
}

/// Returns the root of a label, and halves the path to it. Ends because each parent has a smaller index.
#[cfg_attr(target_pointer_width = "64", inline)]
pub(crate) fn first_of(labels: &mut [Label], mut label: u16) -> u16 {
    let parent =
        |labels: &[Label], label: u16| labels.get(usize::from(label)).map_or(label, |label| label.parent);
    loop {
        let above = parent(labels, label);
        if above >= label {
            return label;
        }
        let first = parent(labels, above);
        if first >= above {
            return above;
        }
        if let Some(held) = labels.get_mut(usize::from(label)) {
            held.parent = first;
        }
        label = first;
    }
}

/// Joins two labels; returns their root.
#[inline]
pub(crate) fn unite(labels: &mut [Label], a: u16, b: u16) -> u16 {
    let (a, b) = (first_of(labels, a), first_of(labels, b));
    if let Some(label) = labels.get_mut(usize::from(a.max(b))) {
        label.parent = a.min(b);
    }
    a.min(b)
}
