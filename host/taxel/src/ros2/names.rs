//! Names as parts of ROS topics and frames.

use taxel_core::garment::Area;

/// A name as part of a topic: letters, digits and single underscores, not beginning with a digit.
pub fn topic_part(name: &str) -> String {
    let mut word = String::new();
    for letter in name.chars() {
        match letter {
            letter if letter.is_ascii_alphanumeric() => word.push(letter),
            _ if word.ends_with('_') => {}
            _ => word.push('_'),
        }
    }
    if word.starts_with(|c: char| c.is_ascii_digit()) || word.is_empty() { format!("_{word}") } else { word }
}

/// Frame of a panel of a board of a robot, or, with an empty name, of a board that is alone; it is the panel's
/// own, so that panels of one link do not overlap.
pub fn frame(board: &str, area: &Area) -> String {
    let panel = topic_part(&area.name);
    if board.is_empty() {
        format!("tactile/{panel}")
    } else {
        format!("tactile/{}/{panel}", topic_part(board))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_made_parts_of_topics() {
        for (name, part) in
            [("left arm", "left_arm"), ("3", "_3"), ("a - b", "a_b"), ("__x", "_x"), ("", "_")]
        {
            assert_eq!(topic_part(name), part);
        }
    }
}
