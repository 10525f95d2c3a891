//! Parts: touched taxels of one panel that are connected.

/// No contact.
pub(super) const NONE: u16 = u16::MAX;

/// Touched taxels of one panel that are connected, or as many of them as were found so before they met others.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    /// sum f; fits, since taxels and values have 16 bits
    pub mass: u32,
    /// A part with a smaller index that it belongs to, or itself. In a whole frame: the first, which carries
    /// the sums of all.
    pub parent: u16,
    /// Of the first: the same, between parts that a seam joins.
    pub group: u16,
    /// The index of its contact, or [`NONE`].
    pub contact: u16,
    /// taxels
    pub area: u16,
    /// greatest value; 16 bits, which are sooner read back as a word
    pub peak: u32,
    pub panel: u8,
    /// It comes within one taxel of a contact of the previous frame; asked of faint parts only.
    pub held: bool,
    /// A seam joins it to another.
    pub joined: bool,
}

impl Part {
    /// Number `index`, without a taxel.
    pub const fn new(index: u16, panel: u8) -> Part {
        Part {
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

    /// Adds the sums of others.
    #[cfg_attr(target_pointer_width = "64", inline)]
    pub fn add(&mut self, mass: u32, area: u16, peak: u16) {
        self.mass = self.mass.wrapping_add(mass);
        self.area = self.area.saturating_add(area);
        self.peak = self.peak.max(peak.into());
    }
}

/// The first of the parts that belong together with `part`. Parents have smaller indices, so this ends; it
/// halves the path.
#[cfg_attr(target_pointer_width = "64", inline)]
pub(super) fn first_of(parts: &mut [Part], mut part: u16) -> u16 {
    let parent = |parts: &[Part], part: u16| parts.get(usize::from(part)).map_or(part, |part| part.parent);
    loop {
        let above = parent(parts, part);
        if above >= part {
            return part;
        }
        let first = parent(parts, above);
        if first >= above {
            return above;
        }
        if let Some(held) = parts.get_mut(usize::from(part)) {
            held.parent = first;
        }
        part = first;
    }
}

/// Lets two parts belong together; the first of them.
pub(super) fn unite(parts: &mut [Part], a: u16, b: u16) -> u16 {
    let (a, b) = (first_of(parts, a), first_of(parts, b));
    if let Some(part) = parts.get_mut(usize::from(a.max(b))) {
        part.parent = a.min(b);
    }
    a.min(b)
}
