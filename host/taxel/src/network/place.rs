//! The name of a board between machines, and its keys.

use std::fmt;
use std::str::FromStr;

/// Prefix of all keys.
const ROOT: &str = "taxel";
/// Longest name of a robot or a board, bytes.
const LONGEST: usize = 32;

/// A board by the name of its robot and its own: `arm/left`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BoardPlace {
    robot: String,
    board: String,
}

impl BoardPlace {
    /// A board of a robot. Error if a name cannot be part of a key.
    pub fn new(robot: &str, board: &str) -> Result<BoardPlace, String> {
        for (what, name) in [("robot", robot), ("board", board)] {
            let is_plain = |sign: char| sign.is_ascii_alphanumeric() || matches!(sign, '_' | '-');
            if name.is_empty() || name.len() > LONGEST || !name.chars().all(is_plain) {
                return Err(format!(
                    "the name of a {what} is 1 to {LONGEST} letters, digits, _ and -, not \"{name}\""
                ));
            }
        }
        Ok(BoardPlace { robot: robot.into(), board: board.into() })
    }

    /// Name of the robot.
    pub fn robot(&self) -> &str {
        &self.robot
    }

    /// Name of the board.
    pub fn board(&self) -> &str {
        &self.board
    }

    /// Frames of the wire except images, in the board's order.
    pub fn main(&self) -> String {
        self.key("wire/main")
    }

    /// Frames of the wire that hold an image or raw codes.
    pub fn images(&self) -> String {
        self.key("wire/images")
    }

    /// All frames of the wire.
    pub fn wire(&self) -> String {
        self.key("wire/*")
    }

    /// Returns the key of what the board is, and whether it is there: JSON.
    pub fn state(&self) -> String {
        self.key("state")
    }

    /// Counters of the board: JSON.
    pub fn health(&self) -> String {
        self.key("health")
    }

    /// Requests to the board through this publisher.
    pub fn ask(&self, publisher: u64) -> String {
        self.key(&format!("ask/{}", hex(publisher)))
    }

    /// Sign of life of this publisher.
    pub fn alive(&self, publisher: u64) -> String {
        self.key(&format!("alive/{}", hex(publisher)))
    }

    /// Signs of life of all publishers of the board.
    pub fn all_alive(&self) -> String {
        self.key("alive/*")
    }

    /// The publisher that a key of [`BoardPlace::alive`] is of.
    pub fn publisher(key: &str) -> Option<u64> {
        let (_, digits) = key.rsplit_once('/')?;
        u64::from_str_radix(digits, 16).ok().filter(|id| digits == hex(*id))
    }

    fn key(&self, rest: &str) -> String {
        format!("{ROOT}/{}/{}/{rest}", self.robot, self.board)
    }
}

/// A publisher as 16 digits.
fn hex(publisher: u64) -> String {
    format!("{publisher:016x}")
}

impl FromStr for BoardPlace {
    type Err = String;

    fn from_str(text: &str) -> Result<BoardPlace, String> {
        let (robot, board) =
            text.split_once('/').ok_or("a board is named ROBOT/BOARD, as in arm/left".to_string())?;
        BoardPlace::new(robot, board)
    }
}

impl fmt::Display for BoardPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.robot, self.board)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_has_keys_and_a_bad_one_is_refused() {
        let place: BoardPlace = "arm/left-2".parse().unwrap();
        assert_eq!((place.robot(), place.board(), place.to_string()), ("arm", "left-2", "arm/left-2".into()));
        assert_eq!(place.main(), "taxel/arm/left-2/wire/main");
        assert_eq!(place.ask(0xab), "taxel/arm/left-2/ask/00000000000000ab");
        assert_eq!(BoardPlace::publisher(&place.alive(0xab)), Some(0xab));
        for key in [
            "",
            "alive/ab",
            "alive/00000000000000ag",
            "alive/0000000000000000ab",
            "alive/+0000000000000ab",
            "alive/00000000000000AB",
        ] {
            assert_eq!(BoardPlace::publisher(key), None, "{key}");
        }
        for (text, why) in [
            ("arm", "a board is named ROBOT/BOARD, as in arm/left"),
            ("/left", "the name of a robot is 1 to 32 letters, digits, _ and -, not \"\""),
            ("arm/*", "the name of a board is 1 to 32 letters, digits, _ and -, not \"*\""),
            ("arm/left/2", "the name of a board is 1 to 32 letters, digits, _ and -, not \"left/2\""),
        ] {
            assert_eq!(text.parse::<BoardPlace>().unwrap_err(), why);
        }
        assert!(BoardPlace::new(&"a".repeat(33), "b").is_err());
    }
}
