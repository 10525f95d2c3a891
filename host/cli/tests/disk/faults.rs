//! Faults of a disk.

use crate::cases::Case;

/// A fault, by its name in the library.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    None,
    Full,
    Short,
    Io,
    ReadOnly,
    Denied,
    Interrupted,
    KillBefore,
    KillHalf,
    KillAfter,
    Link,
    Grown,
}

impl Fault {
    pub const ALL: [Fault; 10] = [
        Fault::Full,
        Fault::Short,
        Fault::Io,
        Fault::ReadOnly,
        Fault::Denied,
        Fault::Interrupted,
        Fault::KillBefore,
        Fault::KillHalf,
        Fault::KillAfter,
        Fault::Link,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Fault::None => "none",
            Fault::Full => "full",
            Fault::Short => "short",
            Fault::Io => "io",
            Fault::ReadOnly => "read-only",
            Fault::Denied => "denied",
            Fault::Interrupted => "interrupted",
            Fault::KillBefore => "kill-before",
            Fault::KillHalf => "kill-half",
            Fault::KillAfter => "kill-after",
            Fault::Link => "link",
            Fault::Grown => "grown",
        }
    }

    pub fn kills(self) -> bool {
        matches!(self, Fault::KillBefore | Fault::KillHalf | Fault::KillAfter)
    }

    /// True if a logged call can have the fault.
    pub fn concerns(self, call: &str) -> bool {
        let writes = call.starts_with("write") || call.starts_with("copy_file_range");
        match self {
            Fault::Short | Fault::KillHalf => writes,
            Fault::Interrupted => writes || call.starts_with("open") || call.starts_with("f"),
            Fault::Denied => !writes && !call.starts_with("f"),
            _ => true,
        }
    }

    /// Outside of a campaign a call has some of the faults, which differ between commands.
    pub fn is_left_out(self, call: usize, case: &Case) -> bool {
        let one_of = if case.is_slow { 24 } else { 8 };
        !crate::is_campaign() && !(call + case.name.len() + self as usize).is_multiple_of(one_of)
    }
}
