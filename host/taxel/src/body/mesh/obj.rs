//! Wavefront OBJ files.

use super::model::Mesh;
use crate::error::RobotError;
use glam::DVec3;

/// Reads an OBJ: points and faces. A face of more than three corners is a fan of triangles; textures, normals,
/// lines and groups are passed over.
pub(super) fn obj(file: &str, text: &str) -> Result<Mesh, RobotError> {
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for (index, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        let wrong = |what: String| RobotError::Mesh(format!("{file}, line {}: {what}", index + 1));
        match words.next() {
            Some("v") => {
                // A weight or a colour may follow.
                let numbers: Result<Vec<f64>, _> = words.take(3).map(str::parse).collect();
                match numbers.as_deref() {
                    Ok([x, y, z]) if [x, y, z].iter().all(|number| number.is_finite()) => {
                        points.push(DVec3::new(*x, *y, *z));
                    }
                    _ => return Err(wrong("a point must have three numbers".into())),
                }
            }
            Some("f") => {
                let corners: Vec<DVec3> = words
                    .map(|word| corner(word, &points).map_err(&wrong))
                    .collect::<Result<_, RobotError>>()?;
                let [first, rest @ ..] = &corners[..] else {
                    return Err(wrong("a face without corners".into()));
                };
                if rest.len() < 2 {
                    return Err(wrong("a face must have three corners or more".into()));
                }
                triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
            }
            _ => {}
        }
    }
    Ok(Mesh::of(triangles))
}

/// The point that a corner names: `7`, `7/1`, `7/1/3` or `7//3`, from 1; negative ones count from the last.
fn corner(word: &str, points: &[DVec3]) -> Result<DVec3, String> {
    let name = word.split('/').next().unwrap_or_default();
    let number: i64 =
        name.parse().map_err(|_| format!("a corner must be a number of a point, not \"{word}\""))?;
    let index = match number {
        1.. => usize::try_from(number - 1).ok(),
        _ => usize::try_from(number.unsigned_abs()).ok().and_then(|back| points.len().checked_sub(back)),
    };
    let point = index.and_then(|index| points.get(index));
    point.copied().ok_or_else(|| format!("there is no point {number} among the {} above", points.len()))
}
