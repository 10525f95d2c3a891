//! RAM of the states, as the docs of their modules state it: for the board that ships. Asserted wherever the
//! core is built for an RP2040, and on a 64-bit host, where the lengths of lists are longer.

use crate::acquire::Reflex;
use crate::body::Placed;
use crate::capacity::{PARTS, RUNS, TAXELS};
use crate::condition::ConditionState;
use crate::contact::{ContactState, HardnessCue};
use crate::fold::{FoldState, PostureState};
use crate::gesture::TouchState;
use crate::health::Monitor;
use crate::intent::{Evidence, Fed, IntentState};
use crate::pipeline::CONTACTS;
use crate::react::ReactState;
use crate::shape::Shapes;
use crate::symbol::SymbolState;
use crate::unsure::UnsureState;

/// Asserts the RAM of types; given for each: the file that states it, bytes on the board, bytes on a host.
macro_rules! states {
    ($($state:ty, $file:literal, $board:literal, $host:literal;)*) => {
                #[cfg(target_arch = "arm")]
        const _: () = { $(assert!(size_of::<$state>() == $board, "{}", stringify!($state));)* };

        #[cfg(all(test, target_pointer_width = "64"))]
        #[test]
        fn memory_is_as_documented() {
            $(
                assert_eq!(size_of::<$state>(), $host, "{}", stringify!($state));
                assert!(tests::states(include_str!($file), $board), "{}: {} bytes", $file, $board);
            )*
        }
    };
}

states! {
    ConditionState<TAXELS>, "condition/mod.rs", 34696, 34728;
    ContactState<CONTACTS, RUNS, PARTS, Placed>, "contact/mod.rs", 58040, 58096;
    HardnessCue, "measure/hardness.rs", 20, 20;
    PostureState, "fold/mod.rs", 96, 96;
    FoldState, "fold/mod.rs", 12896, 12928;
    TouchState, "gesture/mod.rs", 3712, 3720;
    Monitor, "health/mod.rs", 2812, 2816;
    Evidence, "intent/evidence.rs", 448, 448;
    Fed, "intent/fed.rs", 192, 192;
    IntentState, "intent/stage.rs", 1400, 1400;
    ReactState, "react/mod.rs", 624, 664;
    Reflex<TAXELS>, "reflex/mod.rs", 8968, 9000;
    Shapes, "shape/mod.rs", 20, 40;
    SymbolState<CONTACTS>, "symbol/mod.rs", 760, 768;
    UnsureState<CONTACTS>, "unsure.rs", 1032, 1040;
}

#[cfg(test)]
mod tests {
    extern crate std;
    use std::format;

    /// True if the row of a module's table that is about RAM states so many bytes.
    pub fn states(file: &str, bytes: usize) -> bool {
        let digits =
            if bytes < 1000 { format!("{bytes}") } else { format!("{},{:03}", bytes / 1000, bytes % 1000) };
        file.lines().any(|line| line.starts_with("//! | RAM |") && line.contains(&format!(" {digits} bytes")))
    }
}
