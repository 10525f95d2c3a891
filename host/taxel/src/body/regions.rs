//! Named parts of the surface, resolved to taxels.

use super::config::Body;
use super::solid::Held;
use super::taxel_place::TaxelPlace;
use crate::error::SettingError;
use crate::text::words;

/// Resolves the regions of a body: writes to each place the region that holds it, the first of several.
/// `is_checked` refuses regions without a taxel and taxels of two regions. Errors name the region by index
/// and key.
pub(super) fn resolve(
    body: &Body,
    links: &[String],
    places: &mut [Option<TaxelPlace>],
    is_checked: bool,
) -> Result<(), SettingError> {
    for (index, region) in body.regions.iter().enumerate() {
        let wrong = |key: &str, what: &str| {
            let key = format!("regions[{index}].{key}");
            SettingError::Key { text: format!("`{key}` {what}"), key }
        };
        let name = &region.name;
        if name.trim().is_empty() {
            return Err(wrong("name", "must not be empty"));
        }
        if body.regions[..index].iter().any(|earlier| earlier.name == *name) {
            return Err(wrong("name", &format!("is that of another region already: \"{name}\"")));
        }
        let Some(link) = links.iter().position(|link| *link == region.link) else {
            let known = words::unknown("link", &region.link, links.iter().map(String::as_str));
            return Err(wrong(
                "link",
                &format!("of region \"{name}\" must be one that panels lie on: {known}"),
            ));
        };
        let held = Held::new(&region.within).map_err(|(key, what)| {
            wrong(&format!("within.{key}"), &format!("of region \"{name}\" {what}"))
        })?;
        let mut count = 0;
        for (taxel, place) in places.iter_mut().enumerate() {
            let Some(place) = place.as_mut().filter(|place| place.link == link && held.holds(place.at))
            else {
                continue;
            };
            count += 1;
            match place.region {
                None => place.region = Some(index),
                Some(other) if is_checked => {
                    let other = &body.regions[other].name;
                    let what =
                        format!("of region \"{name}\" must not hold taxel {taxel}: region \"{other}\" does");
                    return Err(wrong("within", &what));
                }
                Some(_) => {}
            }
        }
        if is_checked && count == 0 {
            return Err(wrong(
                "within",
                &format!("of region \"{name}\" must hold a taxel of {}", region.link),
            ));
        }
    }
    Ok(())
}
