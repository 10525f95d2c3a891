//! STL files, binary and text.

use super::model::Mesh;
use crate::error::RobotError;
use glam::DVec3;

/// Bytes before the triangles of a binary file: a comment, and their number.
const HEAD: usize = 84;
/// Bytes of a triangle: normal, corners, and a word that nobody uses.
const TRIANGLE: usize = 50;

/// Reads an STL. A binary one is recognised by its length: some begin with `solid`, as texts do.
pub(super) fn stl(file: &str, bytes: &[u8]) -> Result<Mesh, RobotError> {
    let head = bytes.get(..HEAD).and_then(|head| head.last_chunk::<4>());
    let count = head.map_or(0, |count| u32::from_le_bytes(*count) as usize);
    let body = bytes.get(HEAD..).unwrap_or_default();
    if head.is_some() && count.checked_mul(TRIANGLE) == Some(body.len()) {
        return binary(file, body);
    }
    match std::str::from_utf8(bytes) {
        Ok(text) if text.trim_start().starts_with("solid") => ascii(file, text),
        _ if head.is_some() => {
            let held = body.len() / TRIANGLE;
            Err(wrong(format!("{file}: it says {count} triangles, and holds {held}")))
        }
        _ => Err(wrong(format!("{file}: not an STL"))),
    }
}

fn binary(file: &str, body: &[u8]) -> Result<Mesh, RobotError> {
    let triangle = |(number, bytes): (usize, &[u8])| {
        let numbers: Vec<f64> =
            bytes.as_chunks::<4>().0.iter().map(|four| f64::from(f32::from_le_bytes(*four))).collect();
        let corner = |first: usize| match numbers.get(first..first + 3) {
            Some([x, y, z]) if x.is_finite() && y.is_finite() && z.is_finite() => Ok(DVec3::new(*x, *y, *z)),
            _ => Err(wrong(format!("{file}, triangle {number}: not finite"))),
        };
        // The normal comes first, and follows from the corners.
        Ok([corner(3)?, corner(6)?, corner(9)?])
    };
    let triangles = body.chunks_exact(TRIANGLE).enumerate().map(triangle);
    Ok(Mesh::of(triangles.collect::<Result<Vec<_>, RobotError>>()?))
}

fn ascii(file: &str, text: &str) -> Result<Mesh, RobotError> {
    let (mut triangles, mut open, mut last) = (Vec::new(), Vec::new(), 0);
    let mut is_ended = false;
    for (index, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        let wrong = |what: &str| wrong(format!("{file}, line {}: {what}", index + 1));
        match words.next() {
            Some("vertex") => {
                let numbers: Result<Vec<f64>, _> = words.map(str::parse).collect();
                match numbers.as_deref() {
                    Ok([x, y, z]) if [x, y, z].iter().all(|number| number.is_finite()) => {
                        open.push(DVec3::new(*x, *y, *z));
                    }
                    _ => return Err(wrong("a vertex must have three numbers")),
                }
            }
            Some("endfacet") => match std::mem::take(&mut open)[..] {
                [a, b, c] => triangles.push([a, b, c]),
                _ => return Err(wrong("a facet must have three vertices")),
            },
            Some("endsolid") => is_ended = true,
            _ => {}
        }
        last = index + 1;
    }
    match is_ended {
        true => Ok(Mesh::of(triangles)),
        false => Err(wrong(format!("{file}, line {last}: it ends without `endsolid`"))),
    }
}

fn wrong(text: String) -> RobotError {
    RobotError::Mesh(text)
}
