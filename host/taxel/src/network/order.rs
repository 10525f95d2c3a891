//! Puts the two ways of a board's frames back into the board's order.
//!
//! Contacts overtake images on their way, because they go before them. To the client a number that steps back is
//! a restart of the board, so what is overtaken must not come after what has overtaken it. Each way keeps its own
//! order. So a frame without an image that has overtaken images waits for them, a while: whatever comes later is
//! dropped, and missing from the board's numbers like what the network has dropped itself. An image never passes a
//! frame that was published before it.
//!
//! The while is long enough for a hiccup of either machine as long as all images come, and short from the first one
//! that does not: then the network drops them, and contacts are not to wait for what will not come.

use super::piece::WirePiece;
use super::stamp::{PieceKind, PieceStamp};
use crate::time::Instant;
use std::collections::VecDeque;
use std::time::Duration;

/// Longest wait of contacts for images that they have overtaken, while all images come.
pub const PATIENCE: Duration = Duration::from_millis(50);
/// Their longest wait while images are lost.
pub(crate) const HASTE: Duration = Duration::from_millis(2);
/// Images in a row after which they all come again.
const IN_A_ROW: u32 = 200;
/// Most bytes that wait on each way: what the fastest board says in a second, of the largest frames.
const ROOM: usize = 1 << 20;
/// Most that a number may differ from those before it: more frames than a board sends until it counts as gone.
const STEP: u64 = 1 << 16;

/// The frames of one publisher.
#[derive(Debug)]
pub struct PieceOrder {
    publisher: u64,
    /// Frames that have come by each way, and when.
    main: Queue<(Instant, WirePiece)>,
    images: Queue<WirePiece>,
    /// The highest numbers that have come.
    near: Option<PieceStamp>,
    /// Numbers of what was handed on last.
    passed: Option<PieceStamp>,
    /// Images that were handed on since the last one that was missing.
    in_a_row: u32,
    dropped: u64,
}

/// Frames that have come by a way.
#[derive(Debug)]
struct Queue<T> {
    waiting: VecDeque<T>,
    /// Bytes of what waits, with what it takes beside its frame.
    bytes: usize,
    /// Number of the newest.
    last: Option<u64>,
}

impl<T> Default for Queue<T> {
    fn default() -> Queue<T> {
        Queue { waiting: VecDeque::new(), bytes: 0, last: None }
    }
}

impl<T> Queue<T> {
    fn push(&mut self, item: T, number: u64, bytes: usize) {
        self.waiting.push_back(item);
        self.bytes += bytes;
        self.last = Some(number);
    }

    fn pop(&mut self, piece: impl Fn(&T) -> &WirePiece) -> Option<T> {
        let item = self.waiting.pop_front()?;
        self.bytes -= taken(piece(&item));
        Some(item)
    }
}

/// Memory that a piece takes.
fn taken(piece: &WirePiece) -> usize {
    size_of::<(Instant, WirePiece)>() + piece.bytes.len()
}

impl PieceOrder {
    /// Makes the order of this publisher's frames; what others publish is ignored.
    pub fn new(publisher: u64) -> PieceOrder {
        let (main, images) = Default::default();
        PieceOrder { publisher, main, images, near: None, passed: None, in_a_row: IN_A_ROW, dropped: 0 }
    }

    /// The publisher.
    pub fn publisher(&self) -> u64 {
        self.publisher
    }

    /// Takes a piece that came at `now`. Error if it is not what the publisher sends next: nothing is taken then.
    pub fn push(&mut self, now: Instant, piece: WirePiece) -> Result<(), &'static str> {
        if piece.stamp.publisher != self.publisher {
            return Ok(());
        }
        let near = self.followed(&piece)?;
        self.near = Some(near);
        let (stamp, bytes) = (piece.stamp, taken(&piece));
        match piece.kind {
            PieceKind::Main => self.main.push((now, piece), stamp.main, bytes),
            PieceKind::Image => {
                self.images.push(piece, stamp.images, bytes);
                while self.images.bytes > ROOM {
                    self.drop_image();
                }
            }
        }
        Ok(())
    }

    /// The highest numbers, with those of this piece. Error if they do not follow.
    fn followed(&self, piece: &WirePiece) -> Result<PieceStamp, &'static str> {
        let stamp = piece.stamp;
        let (number, last) = match piece.kind {
            PieceKind::Main => (stamp.main, self.main.last),
            PieceKind::Image => (stamp.images, self.images.last),
        };
        if last.is_some_and(|last| number <= last) {
            return Err("its number has come before");
        }
        let near = self.near.unwrap_or(stamp);
        if stamp.main.abs_diff(near.main) > STEP || stamp.images.abs_diff(near.images) > STEP {
            return Err("its number is far from those before it");
        }
        Ok(near.max(stamp))
    }

    /// Returns the next piece, if it is known at `now` which one that is.
    pub fn next(&mut self, now: Instant) -> Option<WirePiece> {
        while self.images.waiting.front().is_some_and(|image| self.is_late(image)) {
            self.drop_image();
        }
        let is_image = self.images.waiting.front().is_some_and(|image| self.is_next(image));
        let piece = match is_image {
            true => self.images.pop(|image| image),
            false if self.wait(now)?.is_zero() => self.main.pop(|(_, piece)| piece).map(|(_, piece)| piece),
            false => None,
        }?;
        let before = self.passed.unwrap_or(PieceStamp { main: 0, images: 0, ..piece.stamp });
        let passed = before.max(piece.stamp);
        // The first frame says where the images begin.
        let images = self.passed.map_or(0, |_| passed.images - before.images);
        self.in_a_row = match images.cmp(&u64::from(is_image)) {
            std::cmp::Ordering::Greater => 0,
            _ => self.in_a_row.saturating_add(is_image.into()),
        };
        self.passed = Some(passed);
        Some(piece)
    }

    /// Returns how long the next frame without an image still waits for images before it; none if there is none.
    pub fn wait(&self, now: Instant) -> Option<Duration> {
        let (came, main) = self.main.waiting.front()?;
        // An image that comes after it shows that those before it were dropped.
        let is_complete = self.passed.is_none_or(|passed| main.stamp.images <= passed.images);
        if is_complete || !self.images.waiting.is_empty() {
            return Some(Duration::ZERO);
        }
        let patience = if self.in_a_row < IN_A_ROW { HASTE } else { PATIENCE };
        Some((*came + patience).saturating_duration_since(now))
    }

    /// True if there is no room for another frame without an image.
    pub fn is_full(&self) -> bool {
        self.main.bytes >= ROOM
    }

    /// Bytes of memory that wait.
    pub fn bytes(&self) -> usize {
        self.main.bytes + self.images.bytes
    }

    /// Number of images that came too late, or for which there was no room.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    fn drop_image(&mut self) {
        self.images.pop(|image| image);
        self.dropped += 1;
    }

    /// True if a frame that was published after this image has been handed on.
    fn is_late(&self, image: &WirePiece) -> bool {
        self.passed.is_some_and(|passed| image.stamp.images <= passed.images)
    }

    /// True if all frames without an image before this image have been handed on, or are lost. Before the first one
    /// nothing is known.
    fn is_next(&self, image: &WirePiece) -> bool {
        self.passed.is_some_and(|passed| image.stamp.main <= passed.main)
            || self.main.waiting.front().is_some_and(|(_, main)| image.stamp.main < main.stamp.main)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use PieceKind::{Image, Main};

    /// Pieces that a board has sent: kinds in its order, each with its number.
    fn published(kinds: &[PieceKind]) -> Vec<WirePiece> {
        let mut stamp = PieceStamp { publisher: 5, main: 0, images: 0 };
        let next = |(number, kind): (usize, &PieceKind)| {
            stamp = stamp.next(*kind);
            WirePiece { kind: *kind, stamp, bytes: vec![number as u8] }
        };
        kinds.iter().enumerate().map(next).collect()
    }

    /// Numbers of all that is handed on at a time.
    fn all(order: &mut PieceOrder, now: Instant) -> Vec<u8> {
        std::iter::from_fn(|| order.next(now)).map(|piece| piece.bytes[0]).collect()
    }

    #[test]
    fn contacts_wait_a_short_while_for_images_that_they_have_overtaken() {
        let sent = published(&[Main, Image, Main, Image, Main]);
        let now = Instant::now();
        let mut order = PieceOrder::new(5);
        for at in [0, 2, 1] {
            order.push(now, sent[at].clone()).unwrap();
        }
        assert_eq!(all(&mut order, now), [0, 1, 2]);
        order.push(now, sent[4].clone()).unwrap();
        assert_eq!((all(&mut order, now), order.wait(now)), (vec![], Some(PATIENCE)));
        assert_eq!(all(&mut order, now + PATIENCE), [4], "it is no longer waited for");
        order.push(now + PATIENCE, sent[3].clone()).unwrap();
        assert_eq!((all(&mut order, now + PATIENCE), order.dropped()), (vec![], 1));
    }

    #[test]
    fn what_was_dropped_on_the_way_holds_nothing_up() {
        let sent = published(&[Main, Image, Image, Main, Image, Main, Main, Image]);
        let now = Instant::now();
        let mut order = PieceOrder::new(5);
        // The first two images are lost: the third one shows that.
        for at in [0, 3, 4] {
            order.push(now, sent[at].clone()).unwrap();
        }
        assert_eq!(all(&mut order, now), [0, 3, 4]);
        // Two mains are lost: an image waits until it is clear that they do not come.
        order.push(now, sent[7].clone()).unwrap();
        assert_eq!((all(&mut order, now), order.wait(now)), (vec![], None));
        let later = WirePiece { stamp: PieceStamp { main: 9, ..sent[7].stamp }, ..sent[6].clone() };
        order.push(now, later).unwrap();
        assert_eq!((all(&mut order, now), order.dropped()), (vec![7, 6], 0));
    }

    #[test]
    fn any_way_through_the_network_leaves_the_order_of_the_board() {
        let mut random = fastrand::Rng::with_seed(1);
        for _ in 0..2000 {
            let kinds: Vec<_> = (0..40).map(|_| if random.bool() { Main } else { Image }).collect();
            let sent = published(&kinds);
            let kept = |piece: &&WirePiece| piece.kind == Main || random.f32() > 0.2;
            let arrived: Vec<_> = sent.iter().filter(kept).cloned().collect();
            let (mut ways, mut order) = ([VecDeque::new(), VecDeque::new()], PieceOrder::new(5));
            arrived.into_iter().for_each(|piece| ways[usize::from(piece.kind == Image)].push_back(piece));
            let (mut now, mut got) = (Instant::now(), Vec::new());
            while ways.iter().any(|way| !way.is_empty()) {
                ways[usize::from(random.f32() > 0.6)]
                    .pop_front()
                    .into_iter()
                    .for_each(|piece| order.push(now, piece).unwrap());
                got.extend(all(&mut order, now));
                now += PATIENCE / 3;
            }
            got.extend(all(&mut order, now + PATIENCE));
            assert!(got.is_sorted(), "{got:?}");
            let mains = |numbers: &[u8]| numbers.iter().filter(|at| kinds[usize::from(**at)] == Main).count();
            assert_eq!(mains(&got), kinds.iter().filter(|kind| **kind == Main).count(), "{got:?}");
        }
    }

    #[test]
    fn another_publisher_is_ignored_and_the_newest_images_are_kept() {
        let sent = published(&[Main]);
        let (now, mut order) = (Instant::now(), PieceOrder::new(6));
        order.push(now, sent[0].clone()).unwrap();
        assert_eq!((all(&mut order, now), order.publisher()), (vec![], 6));
        let mut sent = published(&[[Main].as_slice(), &[Image; 70]].concat());
        sent.iter_mut().for_each(|piece| piece.bytes.resize(ROOM / 65, piece.bytes[0]));
        let mut order = PieceOrder::new(5);
        sent.iter().for_each(|piece| order.push(now, piece.clone()).unwrap());
        let newest: Vec<u8> = [0].into_iter().chain(7..71).collect();
        assert_eq!(all(&mut order, now), newest);
        assert_eq!((order.dropped(), order.bytes(), order.is_full()), (6, 0, false));
    }

    #[test]
    fn images_of_a_hiccup_are_all_kept_at_the_fastest_rate() {
        // 40 ms at 1,562 frames/s, each with contacts: contacts first, then all images, 6 ms later.
        let kinds: Vec<_> = [Main, Image].into_iter().cycle().take(125).collect();
        let sent = published(&kinds);
        let (now, mut order, mut got) = (Instant::now(), PieceOrder::new(5), Vec::new());
        let of = |kind: PieceKind| sent.iter().filter(move |piece| piece.kind == kind).cloned();
        of(Main).for_each(|piece| order.push(now, piece).unwrap());
        for late in 0..6 {
            got.extend(all(&mut order, now + Duration::from_millis(late)));
        }
        assert_eq!(got, [0], "the others wait for images");
        of(Image).for_each(|piece| order.push(now, piece).unwrap());
        got.extend(all(&mut order, now + Duration::from_millis(6)));
        assert_eq!((got, order.dropped()), ((0..125).collect(), 0));
        // A reader that stands still for a tenth of a second.
        let sent = published(&[Image; 156]);
        sent.iter().for_each(|piece| {
            let stamp = PieceStamp { main: 63, images: piece.stamp.images + 62, ..piece.stamp };
            order.push(now, WirePiece { stamp, ..piece.clone() }).unwrap();
        });
        assert_eq!((all(&mut order, now).len(), order.dropped()), (156, 0));
    }

    #[test]
    fn contacts_wait_shortly_once_images_are_lost_and_again_when_they_come() {
        let (now, mut order) = (Instant::now(), PieceOrder::new(5));
        let mut stamp = PieceStamp { publisher: 5, main: 0, images: 0 };
        let mut next = |kind: PieceKind| {
            stamp = stamp.next(kind);
            WirePiece { kind, stamp, bytes: vec![7] }
        };
        let mut waits = |order: &mut PieceOrder, is_lost: bool| {
            let (image, main) = (next(Image), next(Main));
            order.push(now, main).unwrap();
            let wait = order.wait(now);
            if !is_lost {
                order.push(now, image).unwrap();
            }
            all(order, now + PATIENCE);
            wait.unwrap()
        };
        assert_eq!(waits(&mut order, false), Duration::ZERO, "nothing is known before the first one");
        assert_eq!(waits(&mut order, true), PATIENCE);
        (0..IN_A_ROW).for_each(|_| assert_eq!(waits(&mut order, false), HASTE));
        assert_eq!([waits(&mut order, false), waits(&mut order, true)], [PATIENCE; 2]);
        assert_eq!(waits(&mut order, true), HASTE);
    }

    #[test]
    fn numbers_that_do_not_follow_are_refused() {
        let now = Instant::now();
        let mut order = PieceOrder::new(5);
        let piece = |kind, main, images| WirePiece {
            kind,
            stamp: PieceStamp { publisher: 5, main, images },
            bytes: vec![1],
        };
        order.push(now, piece(Main, 1 << 40, 7)).unwrap();
        for (kind, main, images, why) in [
            (Main, 1 << 40, 7, "its number has come before"),
            (Main, 1, 7, "its number has come before"),
            (Main, u64::MAX, 7, "its number is far from those before it"),
            (Image, 1 << 40, u64::MAX, "its number is far from those before it"),
        ] {
            assert_eq!(order.push(now, piece(kind, main, images)), Err(why), "{main} {images}");
        }
        order.push(now, piece(Main, (1 << 40) + STEP, 7)).unwrap();
        assert_eq!((all(&mut order, now).len(), order.bytes()), (2, 0));
    }

    #[test]
    fn an_image_that_comes_first_does_not_pass_what_was_published_before_it() {
        let sent = published(&[Main, Image, Main]);
        let now = Instant::now();
        let mut order = PieceOrder::new(5);
        order.push(now, sent[1].clone()).unwrap();
        assert_eq!((all(&mut order, now), order.wait(now)), (vec![], None));
        order.push(now, sent[0].clone()).unwrap();
        order.push(now, sent[2].clone()).unwrap();
        assert_eq!((all(&mut order, now), order.dropped()), (vec![0, 1, 2], 0));
    }
}
