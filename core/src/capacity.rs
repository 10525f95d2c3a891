//! Capacities of the board that ships. What of it grows with a garment follows from these numbers; other
//! boards have capacities of their own, as parameters of [`Board`](crate::board::Board).

/// Most taxels of a garment.
pub const TAXELS: usize = 2048;

/// Most runs of touched taxels in a row. No row of an even number of columns has more.
pub const RUNS: usize = TAXELS / 2;

/// Most parts (connected taxels of one panel). No panel has more than it has squares of two by two taxels.
pub const PARTS: usize = TAXELS / 4;
