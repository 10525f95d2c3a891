//! Names of arrays in an archive: a panel may have any name, and an archive is unpacked to files.

use std::collections::BTreeSet;

/// Names in use.
#[derive(Debug, Default)]
pub struct Entries(BTreeSet<String>);

impl Entries {
    /// Begins with these names in use.
    pub fn of<'a>(names: impl Iterator<Item = &'a str>) -> Entries {
        Entries(names.map(String::from).collect())
    }

    /// Name of a panel's array: letters, digits, spaces, `-`, `_` and `.` are kept, anything else becomes
    /// `_`; it does not begin with a dot, and is unique.
    pub fn add(&mut self, panel: &str) -> String {
        let plain = |sign: char| if sign.is_alphanumeric() || " -_.".contains(sign) { sign } else { '_' };
        let mut name: String = panel.chars().map(plain).collect();
        if name.starts_with('.') || name.trim().is_empty() {
            name.insert(0, '_');
        }
        while !self.0.insert(name.clone()) {
            name.push('_');
        }
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_leads_elsewhere_or_to_another_array() {
        let mut entries = Entries::of(["frame"].into_iter());
        let names = ["left arm", "../../up", "frame", "c:\\x", "..", " ", "__.._.._up", "Füße"];
        let made = names.map(|name| entries.add(name));
        assert_eq!(made, ["left arm", "_.._.._up", "frame_", "c__x", "_..", "_ ", "__.._.._up", "Füße"],);
        assert_eq!(entries.add("left arm"), "left arm_");
    }
}
