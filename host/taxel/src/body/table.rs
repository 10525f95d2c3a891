//! The surface as a board reads it: the table of `taxel_core::surface`.

use super::surface::Surface;
use super::taxel_place::TaxelPlace;
use crate::error::SettingError;
use taxel_core::garment::Layout;
use taxel_core::surface::{NO_REGION, ONE, TaxelRecord, table_bytes, write_table};

/// The table of a surface. Error if it has no taxel, more links or regions than a board's table, or a name of
/// one of more than 40 bytes; or if a taxel lies 2 m or more from its link's origin, along an axis.
pub fn table(surface: &Surface, layout: &Layout) -> Result<Vec<u8>, SettingError> {
    let mut records = Vec::with_capacity(layout.taxels());
    for (taxel, place) in surface.places().iter().enumerate() {
        let record = place.map_or(Some(TaxelRecord::NOWHERE), |place| record(&place));
        records.push(record.ok_or_else(|| {
            SettingError::Surface(format!("taxel {taxel} lies 2 m or more from its link's origin"))
        })?);
    }
    let links: Vec<&str> = surface.links().iter().map(String::as_str).collect();
    let regions: Vec<&str> = surface.regions().iter().map(String::as_str).collect();
    let mut bytes = vec![0; table_bytes(records.len())];
    write_table(&links, &regions, &records, layout, &mut bytes)
        .map_err(|error| SettingError::Surface(error.to_string()))?;
    Ok(bytes)
}

/// The entry of a taxel, each number rounded; none if one does not fit.
fn record(place: &TaxelPlace) -> Option<TaxelRecord> {
    let rounded = |x: f64| {
        let x = (x * f64::from(ONE)).round();
        (x.abs() <= f64::from(i16::MAX)).then_some(x as i16)
    };
    let vector = |v: glam::DVec3| Some([rounded(v.x)?, rounded(v.y)?, rounded(v.z)?]);
    let (at, normal) = (vector(place.at)?, vector(place.normal)?);
    // From the rounded vectors, as the board checks them.
    let exact = |v: [i16; 3]| glam::DVec3::from(v.map(|x| f64::from(x) / f64::from(ONE)));
    let arm = vector(exact(at).cross(exact(normal)))?;
    let region = place.region.map_or(NO_REGION, |region| region as u8);
    Some(TaxelRecord { link: place.link as u8, region, at, normal, arm })
}
