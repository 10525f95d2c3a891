//! Which hub a page belongs to.

use super::hub::PageHub;
use std::sync::Arc;

/// Folder of the pages of a robot's boards: `/boards/NAME/`.
const BOARDS: &str = "/boards/";

/// The hub of a board, or one for each board of a robot.
#[derive(Clone)]
pub enum PageHubs {
    /// A board that is watched alone, or a recording.
    One(Arc<PageHub>),
    /// The boards of a robot by their names; at least one.
    Boards(Vec<(String, Arc<PageHub>)>),
}

impl From<Arc<PageHub>> for PageHubs {
    fn from(hub: Arc<PageHub>) -> PageHubs {
        PageHubs::One(hub)
    }
}

impl PageHubs {
    /// Hub and file of a path: `/boards/NAME/FILE` is of this board of a robot, `/FILE` of its first one. None
    /// if there is no such board.
    pub fn at<'a>(&self, path: &'a str) -> Option<(&PageHub, &'a str)> {
        match self {
            PageHubs::One(hub) => Some((hub, path)),
            PageHubs::Boards(boards) => match path.strip_prefix(BOARDS) {
                None => boards.first().map(|(_, hub)| (&**hub, path)),
                Some(inside) => {
                    let (name, file) = inside.split_at(inside.find('/')?);
                    boards.iter().find(|(board, _)| board == name).map(|(_, hub)| (&**hub, file))
                }
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_leads_to_the_hub_of_its_board() {
        let [torso, hand] = [(); 2].map(|()| Arc::new(PageHub::default()));
        let boards = PageHubs::Boards(vec![("torso".into(), torso.clone()), ("hand".into(), hand.clone())]);
        let found = |path| boards.at(path).map(|(hub, file)| (std::ptr::eq(hub, &*hand), file));
        assert_eq!(found("/"), Some((false, "/")));
        assert_eq!(found("/boards/torso/main.js"), Some((false, "/main.js")));
        assert_eq!(found("/boards/hand/"), Some((true, "/")));
        for nowhere in ["/boards/", "/boards/hand", "/boards/foot/", "/boards//"] {
            assert_eq!(found(nowhere), None, "{nowhere}");
        }
        let one = PageHubs::from(hand);
        assert_eq!(one.at("/boards/hand/").map(|(_, file)| file), Some("/boards/hand/"));
    }
}
