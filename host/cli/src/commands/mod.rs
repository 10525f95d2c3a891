//! The commands: each is a module with its arguments and a function `run`.

pub mod board;
pub mod body;
pub mod garment;
pub mod maps;
pub mod motion;
pub mod process;
pub mod recordings;
pub mod shapes;
pub mod views;

/// Prints a command's messages besides its output: on standard error if the output is the standard output.
pub fn print_beside(is_standard: bool, text: &str) {
    if is_standard {
        eprint!("{text}");
    } else {
        print!("{text}");
    }
}
