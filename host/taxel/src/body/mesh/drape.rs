//! A panel laid over a mesh as cloth: its threads keep their length, and the angle between them gives way.

use super::model::Mesh;
use crate::error::RobotError;
use glam::DVec3;

/// Rounds of a search for a point; each is nearer by about the sine of the angle between the threads.
const ROUNDS: usize = 60;
/// Share of the pitch within which a distance is met.
const EXACT: f64 = 1e-5;
/// Share of the pitch by which a distance may be missed: an edge of the mesh, a hole, a fold.
const MISSED: f64 = 0.01;
/// Least sine of the angle between `down` and the surface's normal.
const ACROSS: f64 = 0.5;
/// Least cosine of the angle by which a thread bends from one taxel to the next.
const BEND: f64 = 0.5;
/// Least length of a cell's diagonals as a share of those of a rectangle: cloth that shears by more than 49
/// degrees wrinkles.
const DIAGONAL: f64 = 0.5;

/// A panel and where it lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drape {
    /// Rows and columns of its taxels.
    pub rows: usize,
    /// See `rows`.
    pub columns: usize,
    /// Distance of taxels along x (columns) and y (rows), m.
    pub pitch: [f64; 2],
    /// Point near the surface, below the middle of the panel, m.
    pub at: DVec3,
    /// Direction in which the rows are counted.
    pub down: DVec3,
}

/// A taxel: place and normal.
type Placed = (DVec3, DVec3);

/// A point of the surface, and the direction in which a thread goes on.
#[derive(Debug, Clone, Copy)]
struct Thread {
    at: DVec3,
    ahead: DVec3,
}

impl Drape {
    /// Places and normals of the taxels, row by row.
    ///
    /// The middle row and the middle column go straight over the surface. Each other taxel lies a pitch from
    /// its two neighbours towards the middle, as the crossings of woven threads do. Errors name the row and
    /// the column of a taxel that finds no place.
    pub fn over(&self, mesh: &Mesh) -> Result<Vec<Placed>, RobotError> {
        let Drape { rows, columns, pitch: [x, y], at, down } = *self;
        if rows < 2 || columns < 2 || !(x > 0.0 && y > 0.0 && x.is_finite() && y.is_finite()) {
            return Err(wrong("a panel must have two rows and columns, and a pitch"));
        }
        let size = DVec3::new(columns as f64 * x, rows as f64 * y, 0.0).length();
        let near = mesh.nearest(at).ok_or_else(|| wrong("the mesh has no triangles"))?;
        let mesh = &mesh.around(near.at, size);
        let along = down.normalize_or_zero();
        let across = along - near.normal * along.dot(near.normal);
        let is_across = across.length() >= ACROSS;
        let across = is_across.then(|| across.try_normalize()).flatten();
        let down = across.ok_or_else(|| wrong("`down` must be a direction across the surface"))?;
        // From the middle to the taxel beside it.
        let (row, column) = (rows / 2, columns / 2);
        let [first_x, first_y] =
            [(column as f64 - (columns - 1) as f64 / 2.0) * x, (row as f64 - (rows - 1) as f64 / 2.0) * y];
        let middle = Thread { at: near.at, ahead: near.normal.cross(down) };
        let lost = || wrong("the surface ends beside the middle of the panel");
        let beside = middle.walked(mesh, first_x).ok_or_else(lost)?;
        let below = beside.turned(mesh, down).walked(mesh, first_y).ok_or_else(lost)?;
        let mut net = Net { mesh, columns, pitch: self.pitch, places: vec![None; rows * columns] };
        net.thread(row, column, below.turned(mesh, down), [1, 0], rows - 1 - row, y);
        net.thread(row, column, below.turned(mesh, -down), [-1, 0], row, y);
        net.thread(row, column, below.turned(mesh, beside.ahead), [0, 1], columns - 1 - column, x);
        net.thread(row, column, below.turned(mesh, -beside.ahead), [0, -1], column, x);
        let rows_out = (row + 1..rows).map(|to| (to, to - 1)).chain((0..row).rev().map(|to| (to, to + 1)));
        for (to, from) in rows_out {
            let columns_out =
                (column + 1..columns).map(|to| (to, to - 1)).chain((0..column).rev().map(|to| (to, to + 1)));
            for (column, next) in columns_out {
                net.cross([to, column], [from, next])?;
            }
        }
        net.placed(rows)
    }
}

impl Thread {
    /// Goes on straight for a length; backwards if it is negative. None where the surface ends: the nearest
    /// points lie behind.
    fn walked(self, mesh: &Mesh, length: f64) -> Option<Thread> {
        let (ahead, far) = (self.ahead * length.signum(), length.abs());
        let mut at = self.at + ahead * far;
        for _ in 0..ROUNDS {
            at = mesh.nearest(at)?.at;
            if (far - at.distance(self.at)).abs() <= EXACT * far {
                break;
            }
            at = self.at + (at - self.at).normalize_or(ahead) * far;
        }
        let way = at - self.at;
        let is_met = (way.length() - far).abs() <= MISSED * far && way.dot(ahead) > far * BEND;
        let there = Thread { at, ahead: way.normalize_or(ahead) * length.signum() };
        is_met.then(|| there.turned(mesh, there.ahead))
    }

    /// From the same point in another direction, along the surface.
    fn turned(self, mesh: &Mesh, ahead: DVec3) -> Thread {
        let normal = mesh.nearest(self.at).map_or(DVec3::ZERO, |near| near.normal);
        Thread { at: self.at, ahead: (ahead - normal * ahead.dot(normal)).normalize_or(self.ahead) }
    }
}

/// Taxels that have a place.
struct Net<'a> {
    mesh: &'a Mesh,
    columns: usize,
    pitch: [f64; 2],
    places: Vec<Option<DVec3>>,
}

impl Net<'_> {
    fn at(&self, row: usize, column: usize) -> Option<DVec3> {
        self.places.get(row * self.columns + column).copied().flatten()
    }

    /// Places a taxel and `count` ones beyond it, straight on, as far as the surface goes.
    fn thread(
        &mut self,
        row: usize,
        column: usize,
        from: Thread,
        [down, right]: [isize; 2],
        count: usize,
        pitch: f64,
    ) {
        let threads = std::iter::successors(Some(from), |thread| thread.walked(self.mesh, pitch));
        for (step, thread) in (0..=count as isize).zip(threads) {
            let (row, column) = (row as isize + down * step, column as isize + right * step);
            self.places[row as usize * self.columns + column as usize] = Some(thread.at);
        }
    }

    /// Places a taxel at the crossing of two threads: below or above its neighbour in `from`'s row, beside
    /// the one in `from`'s column.
    fn cross(
        &mut self,
        [row, column]: [usize; 2],
        [from_row, from_column]: [usize; 2],
    ) -> Result<(), RobotError> {
        let [x, y] = self.pitch;
        let off = || {
            wrong(&format!(
                "row {row}, column {column} has no place on the mesh: an edge, a hole or a fold is there"
            ))
        };
        let (Some(above), Some(beside), Some(between)) =
            (self.at(from_row, column), self.at(row, from_column), self.at(from_row, from_column))
        else {
            return Err(off());
        };
        let mut at = above + beside - between;
        let missed =
            |at: DVec3| ((at.distance(above) - y).abs() / y).max((at.distance(beside) - x).abs() / x);
        for _ in 0..ROUNDS {
            at = self.mesh.nearest(at).ok_or_else(off)?.at;
            if missed(at) <= EXACT {
                break;
            }
            at = above + (at - above).normalize_or_zero() * y;
            at = beside + (at - beside).normalize_or_zero() * x;
        }
        at = self.mesh.nearest(at).ok_or_else(off)?.at;
        let diagonal = at.distance(between).min(above.distance(beside));
        if missed(at) > MISSED || diagonal < DIAGONAL * x.hypot(y) {
            return Err(off());
        }
        self.places[row * self.columns + column] = Some(at);
        Ok(())
    }

    /// All taxels with the normals of the cloth.
    fn placed(&self, rows: usize) -> Result<Vec<Placed>, RobotError> {
        let place = |(row, column): (usize, usize)| {
            let down = slope(row, rows, &|row| self.at(row, column))?;
            let right = slope(column, self.columns, &|column| self.at(row, column))?;
            Some((self.at(row, column)?, down.cross(right).try_normalize()?))
        };
        let all = (0..rows).flat_map(|row| (0..self.columns).map(move |column| (row, column)));
        let off = |(row, column)| {
            wrong(&format!(
                "row {row}, column {column} has no place on the mesh: an edge, a hole or a fold is there"
            ))
        };
        all.map(|taxel| place(taxel).ok_or_else(|| off(taxel))).collect()
    }
}

/// Direction of a thread at one of its taxels, exact for a parabola, at its ends, too.
fn slope(at: usize, count: usize, place: &dyn Fn(usize) -> Option<DVec3>) -> Option<DVec3> {
    let ends = |first: usize, second: usize, third: usize| {
        Some(place(second)? * 4.0 - place(first)? * 3.0 - place(third)?)
    };
    match at {
        _ if count < 3 => Some(place(1)? - place(0)?),
        0 => ends(0, 1, 2),
        _ if at + 1 == count => Some(-ends(at, at - 1, at - 2)?),
        _ => Some(place(at + 1)? - place(at - 1)?),
    }
}

fn wrong(what: &str) -> RobotError {
    RobotError::Mesh(what.into())
}
