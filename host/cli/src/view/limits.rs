//! Limits and filter of a scene, as a page sets them.

use serde::{Deserialize, Serialize};
use taxel_core::condition::Filter;
use taxel_core::scene::Scene;

/// Highest count of a converter.
const MOST_COUNTS: u16 = 4095;
/// Most taxels of a contact's smallest area.
const MOST_AREA: u16 = 256;

/// Limits and filter of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SceneLimits {
    /// Pressure below this many counts is 0: 1 to 4095.
    pub floor: u16,
    /// Pressure of a contact's taxels, counts: 1 to 4095.
    pub low: u16,
    /// Peak with which a contact begins, counts: `low` to 4095.
    pub high: u16,
    /// Smallest area of a contact, taxels: 1 to 256.
    pub min_area: u16,
    /// The filter: `off`, `conservative`, `median`, `square` or `persistent`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub filter: Filter,
}

impl SceneLimits {
    /// The limits of a scene.
    pub fn of(scene: &Scene) -> SceneLimits {
        let (condition, contact) = (&scene.condition, &scene.contact);
        SceneLimits {
            floor: condition.floor,
            low: contact.low,
            high: contact.high,
            min_area: contact.min_area,
            filter: condition.filter,
        }
    }

    /// A scene with these limits.
    pub fn applied(self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        (scene.condition.floor, scene.condition.filter) = (self.floor, self.filter);
        (scene.contact.low, scene.contact.high) = (self.low, self.high);
        scene.contact.min_area = self.min_area;
        scene
    }

    /// True if all are in their ranges.
    pub fn is_sound(&self) -> bool {
        let counts = |least: u16, value: u16| (least..=MOST_COUNTS).contains(&value);
        counts(1, self.floor)
            && counts(1, self.low)
            && counts(self.low, self.high)
            && (1..=MOST_AREA).contains(&self.min_area)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_outside_their_ranges_are_unsound() {
        let shipped = SceneLimits::of(&Scene::shipped());
        assert!(shipped.is_sound());
        let unsound = [
            SceneLimits { floor: 0, ..shipped },
            SceneLimits { low: 0, ..shipped },
            SceneLimits { high: shipped.low - 1, ..shipped },
            SceneLimits { high: 4096, ..shipped },
            SceneLimits { min_area: 0, ..shipped },
            SceneLimits { min_area: 257, ..shipped },
        ];
        assert!(unsound.iter().all(|limits| !limits.is_sound()), "{unsound:?}");
        let other = SceneLimits { low: 50, high: 200, filter: Filter::Median, ..shipped };
        let scene = other.applied(&Scene::shipped());
        assert_eq!(SceneLimits::of(&scene), other);
        assert_eq!(shipped.applied(&scene), Scene::shipped());
    }
}
