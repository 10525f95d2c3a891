//! Names of what a recording holds of one board of a robot: topics such as `/taxel/BOARD/wire`, attachments
//! and metadata such as `BOARD/garment.toml`.

/// Topic of the frames of the wire from the board.
pub const WIRE: &str = "/taxel/wire";
/// End of that topic of a board of a robot.
const END: &str = "/wire";

/// The topic of the only board of a recording (`/taxel/wire`), or that of this board of a robot
/// (`/taxel/BOARD/wire`).
pub fn of_board(board: Option<&str>, topic: &str) -> String {
    match (board, topic.strip_prefix("/taxel/")) {
        (Some(board), Some(rest)) => format!("/taxel/{board}/{rest}"),
        _ => topic.to_string(),
    }
}

/// The name of an attachment, or of metadata, of the only board of a recording or of this board of a robot.
pub(crate) fn attachment_of(board: Option<&str>, name: &str) -> String {
    board.map_or_else(|| name.to_string(), |board| format!("{board}/{name}"))
}

/// Names of the boards of a robot's recording, by its topics; none of a recording of one board.
pub fn boards<'a>(topics: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let board = |topic: &'a str| topic.strip_prefix("/taxel/")?.strip_suffix(END);
    topics.into_iter().filter_map(board).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_to_a_board_and_back() {
        assert_eq!(of_board(None, "/taxel/wire"), "/taxel/wire");
        assert_eq!(of_board(Some("arm"), "/taxel/wire"), "/taxel/arm/wire");
        assert_eq!(attachment_of(Some("arm"), "garment.toml"), "arm/garment.toml");
        let topics = ["/taxel/arm/wire", "/taxel/arm/frames", "/taxel/leg/wire", "/taxel/wire"];
        assert_eq!(boards(topics), ["arm", "leg"]);
    }
}
