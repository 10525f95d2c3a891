//! What a taxel follows by itself, beyond the drift of its panel.

use super::rates::{BESIDE, OWN, PATCH, QUICK, in_time};

/// How far a taxel may move in one visit, and how far off its code may be for that, counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Own {
    /// Most steps towards pressure, and in a patch; away from it twice as many as in a patch.
    up: i16,
    patch: i16,
    /// Most steps towards pressure beside a contact.
    beside: i16,
    /// Drift leaves a code no further off.
    near: i16,
    /// A touch that leaves it further off is never followed.
    far: i16,
    /// What a touch left behind that is over, and is no further off than this, is followed, too.
    doubt: i16,
    /// Whether the panel drifts so fast that its taxels are off by that alone.
    quick: bool,
    /// Parts of a step that are left from the visits before, Q8.
    rest: [u8; 3],
}

impl Own {
    /// Nothing is followed.
    pub const NONE: Own =
        Own { up: 0, patch: 0, beside: 0, near: 0, far: 0, doubt: 0, quick: false, rest: [0; 3] };

    /// For the next visits, `ms` after the last ones, where the panel drifts at these rates (Q8 counts per second,
    /// either way) now and steadily, below `floor` counts is no pressure, and a touch that is over may have left `doubt`
    /// counts.
    pub fn renew(&mut self, ms: u32, [rate, steady]: [u32; 2], floor: u16, doubt: u32) {
        let quick = rate.saturating_sub(QUICK);
        let beside = BESIDE.max(rate / 16);
        let mut steps = [OWN, PATCH, beside].into_iter().zip(&mut self.rest).map(|(rate, rest)| {
            let whole = in_time(rate.saturating_add(quick), ms).saturating_add((*rest).into());
            *rest = whole as u8;
            short(whole >> 8)
        });
        let mut step = || steps.next().unwrap_or(0);
        (self.up, self.patch, self.beside) = (step(), step(), step());
        // In two seconds it may have got so far.
        let (floor, lag) = (u32::from(floor), quick >> 7);
        (self.near, self.far, self.doubt) =
            (short(floor * 3 / 4 + lag), short(floor * 5 / 2 + lag), short(doubt));
        self.quick = steady > QUICK;
    }

    /// A code that is further off is touched, contact or none, counts.
    pub const fn far(&self) -> i32 {
        self.far as i32
    }

    /// Whether a code is off by no more than drift leaves.
    pub const fn is_near(&self, off: i32) -> bool {
        off < self.near as i32
    }

    /// Whether a code is off as it is where something rises faster than is followed.
    pub const fn rises(&self, off: i32) -> bool {
        !self.quick && off * 2 > self.near as i32
    }

    /// The step of a taxel whose code is `off` by so many counts towards pressure, in a patch that drifts or not, and
    /// held by a contact or not.
    pub fn step(&self, off: i32, held: bool, patch: bool) -> i32 {
        // Half of the way: noise of 3 counts moves the baseline by 1 or 2.
        let way = (off.unsigned_abs() >> 1).min(1 << 16) as i32;
        let most = |most: i16| way.min(most.into());
        let near = i32::from(self.near);
        let reach = i32::from(if held { self.near } else { self.far }.max(self.doubt));
        match off {
            // As far as noise goes both ways are alike, or it would push.
            ..0 if -off < near => -most(if patch { self.patch } else { self.up }),
            // Nothing pulls at a garment: further below the baseline is drift, or what has been followed too far.
            ..0 => -most(self.patch.saturating_mul(2)),
            _ if off >= reach => 0,
            _ if held && off < near => most(self.beside),
            _ if patch => most(self.patch),
            _ => most(self.up),
        }
    }
}

/// Counts that fit.
fn short(counts: u32) -> i16 {
    counts.min(1 << 14) as i16
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts that a taxel follows in ten seconds of visits that are so far apart.
    fn followed(ms: u32, rate: u32, off: i32, held: bool, patch: bool) -> i32 {
        let mut own = Own::NONE;
        (0..10_000 / ms)
            .map(|_| {
                own.renew(ms, [rate; 2], 14, 0);
                own.step(off, held, patch)
            })
            .sum()
    }

    #[test]
    fn what_is_followed_depends_on_time_alone() {
        for ms in [20, 40, 333, 500] {
            for (off, held, patch, want) in [
                (9, false, false, 20),
                (34, false, false, 20),
                (9, true, false, 3),
                (20, false, true, 80),
                (-40, false, false, -160),
                (-40, true, false, -160),
            ] {
                let have = followed(ms, 0, off, held, patch);
                assert!((have - want).abs() <= 4, "{off} {held} {patch} each {ms} ms: {have}, not {want}");
            }
            for off in [11, 20, 500] {
                assert_eq!(followed(ms, 0, off, true, false), 0, "{off} under a contact, each {ms} ms");
            }
            assert_eq!(followed(ms, 0, 36, false, true), 0);
        }
        // 20 counts per second: 16 more, and 32 counts further off.
        assert!((followed(333, 20 << 8, 60, false, false) - 180).abs() <= 2);
    }
}
