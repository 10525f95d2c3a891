//! Names of topics in the node's namespace.

use crate::fault::Fault;
use anyhow::{Result, bail};
use taxel::ros2::topic_part;

/// Place of a node, and how it is called.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RosPlace {
    /// Domain of DDS.
    pub domain: u16,
    /// Namespace, `/` or `/left`; of a robot, in which its boards have theirs.
    pub namespace: String,
    /// Name of the node.
    pub name: String,
    /// Name of its board among those of a robot; none for a board that is alone, and for the robot itself.
    pub board: Option<String>,
}

impl RosPlace {
    /// Checks the names.
    pub fn check(&self) -> Result<()> {
        let is_word = |word: &str| {
            word.starts_with(|letter: char| letter.is_ascii_alphabetic() || letter == '_')
                && word.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
                && !word.contains("__")
        };
        let parts = self.namespace.strip_prefix('/');
        if !parts.is_some_and(|parts| parts.is_empty() || parts.split('/').all(is_word)) {
            bail!(Fault::usage(format!("--namespace {}: must be / or like /left/arm", self.namespace)));
        }
        if !is_word(&self.name) {
            let must = "must be letters, digits and single underscores, not beginning with a digit";
            bail!(Fault::usage(format!("--name {}: {must}", self.name)));
        }
        Ok(())
    }

    /// The place of the node of a board of this robot: below the board's name.
    pub fn of_board(&self, board: &str) -> RosPlace {
        RosPlace { board: Some(board.into()), ..self.clone() }
    }

    /// Namespace of the node: that of a board of a robot lies in the robot's.
    pub fn namespace(&self) -> String {
        match &self.board {
            Some(board) => format!("{}/{}", self.namespace.trim_end_matches('/'), topic_part(board)),
            None => self.namespace.clone(),
        }
    }

    /// Whole name of what all boards of a robot share: `joint_states` is `/joint_states`.
    pub fn shared(&self, name: &str) -> String {
        RosPlace { board: None, ..self.clone() }.absolute(name)
    }

    /// Whole name of a topic or service: `~/contacts` is `/taxel/contacts` of the node `/taxel`.
    pub fn absolute(&self, name: &str) -> String {
        let namespace = self.namespace();
        let namespace = namespace.trim_end_matches('/');
        match (name.strip_prefix("~/"), name.strip_prefix('/')) {
            (Some(own), _) => format!("{namespace}/{}/{own}", self.name),
            (_, Some(_)) => name.into(),
            _ => format!("{namespace}/{name}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lie_in_the_namespace() {
        let place = |namespace: &str, name: &str| RosPlace {
            domain: 0,
            namespace: namespace.into(),
            name: name.into(),
            board: None,
        };
        let (root, arm) = (place("/", "taxel"), place("/left/arm", "skin"));
        assert_eq!(root.absolute("~/contacts"), "/taxel/contacts");
        assert_eq!(arm.absolute("~/contacts"), "/left/arm/skin/contacts");
        assert_eq!(
            (root.absolute("joint_states"), arm.absolute("/clock")),
            ("/joint_states".into(), "/clock".into())
        );
        assert_eq!(arm.absolute("joint_states"), "/left/arm/joint_states");
        let hand = arm.of_board("hand-2");
        assert_eq!(hand.namespace(), "/left/arm/hand_2");
        assert_eq!(hand.absolute("~/contacts"), "/left/arm/hand_2/skin/contacts");
        assert_eq!(root.of_board("hand").absolute("tactile/mat/image"), "/hand/tactile/mat/image");
        assert_eq!(hand.shared("joint_states"), "/left/arm/joint_states");
        assert!(root.check().is_ok() && arm.check().is_ok());
        for (namespace, name) in
            [("left", "x"), ("/left/", "x"), ("/", ""), ("/", "a b"), ("/a__b", "x"), ("/", "3")]
        {
            assert!(place(namespace, name).check().is_err(), "{namespace} {name}");
        }
    }
}
