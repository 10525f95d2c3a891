//! Memory of a running program.

use std::fmt;

/// Memory of a program over time.
pub struct Watched {
    name: &'static str,
    id: u32,
    bytes: Vec<u64>,
}

impl Watched {
    pub fn of(name: &'static str, id: u32) -> Watched {
        Watched { name, id, bytes: Vec::new() }
    }

    /// Takes a sample. A program that has just ended has no memory.
    pub fn look(&mut self) {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.id)).unwrap();
        let Some(line) = status.lines().find_map(|line| line.strip_prefix("VmRSS:")) else { return };
        self.bytes.push(line.trim().trim_end_matches(" kB").parse::<u64>().unwrap() << 10);
    }

    /// Maximum in a share of the time.
    fn most(&self, from: f64, until: f64) -> u64 {
        let at = |part: f64| (part * self.bytes.len() as f64) as usize;
        self.bytes[at(from)..at(until)].iter().copied().max().unwrap()
    }

    /// Growth of the maximum from the first to the second half, without the first fifth.
    pub fn grown(&self) -> u64 {
        self.most(0.6, 1.0).saturating_sub(self.most(0.2, 0.6))
    }
}

impl fmt::Display for Watched {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [early, late] = [self.most(0.2, 0.6), self.most(0.6, 1.0)].map(|bytes| bytes as f64 / 1e6);
        write!(f, "memory of {}: {early:.2} MB at first, {late:.2} MB later", self.name)
    }
}
