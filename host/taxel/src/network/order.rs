//! Puts the two ways of a board's frames back into the board's order.
//!
//! Contacts overtake images on their way, because they go before them. To the client a number that steps back is
//! a restart of the board, so what is overtaken must not come after what has overtaken it. Each way keeps its own
//! order. So a frame without an image that has overtaken images waits for them, a short while: whatever comes
//! later is dropped, and missing from the board's numbers like what the network has dropped itself. An image never
//! passes a frame that was published before it.

use super::piece::{PieceKind, PieceStamp, WirePiece};
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Longest wait of contacts for images that they have overtaken.
pub const PATIENCE: Duration = Duration::from_millis(2);
/// Most images that wait; the oldest is dropped for the newest.
const IMAGES: usize = 64;

/// The frames of one publisher.
#[derive(Debug)]
pub struct PieceOrder {
    publisher: u64,
    /// What has come by each way, and when.
    main: VecDeque<(Instant, WirePiece)>,
    images: VecDeque<WirePiece>,
    /// Numbers of what was handed on last.
    passed: Option<PieceStamp>,
    dropped: u64,
}

impl PieceOrder {
    /// Of this publisher; what others publish is ignored.
    pub fn new(publisher: u64) -> PieceOrder {
        let (main, images) = Default::default();
        PieceOrder { publisher, main, images, passed: None, dropped: 0 }
    }

    /// The publisher.
    pub fn publisher(&self) -> u64 {
        self.publisher
    }

    /// Takes a piece that came at `now`.
    pub fn push(&mut self, now: Instant, piece: WirePiece) {
        if piece.stamp.publisher != self.publisher {
            return;
        }
        match piece.kind {
            PieceKind::Main => self.main.push_back((now, piece)),
            PieceKind::Image => {
                self.images.push_back(piece);
                if self.images.len() > IMAGES {
                    self.images.pop_front();
                    self.dropped += 1;
                }
            }
        }
    }

    /// Returns the next piece, if it is known at `now` which one that is.
    pub fn next(&mut self, now: Instant) -> Option<WirePiece> {
        while self.images.front().is_some_and(|image| self.is_late(image)) {
            self.images.pop_front();
            self.dropped += 1;
        }
        let is_image = self.images.front().is_some_and(|image| self.is_next(image));
        let piece = match is_image {
            true => self.images.pop_front(),
            false if self.wait(now)?.is_zero() => self.main.pop_front().map(|(_, piece)| piece),
            false => None,
        }?;
        let images = self.passed.map_or(0, |passed| passed.images);
        let main = self.passed.map_or(0, |passed| passed.main);
        self.passed = Some(PieceStamp {
            publisher: self.publisher,
            main: piece.stamp.main.max(main),
            images: piece.stamp.images.max(images),
        });
        Some(piece)
    }

    /// How long the next frame without an image still waits for images before it; none if there is none.
    pub fn wait(&self, now: Instant) -> Option<Duration> {
        let (came, main) = self.main.front()?;
        // An image that comes after it shows that those before it were dropped.
        let is_complete = self.passed.is_none_or(|passed| main.stamp.images <= passed.images);
        if is_complete || !self.images.is_empty() {
            return Some(Duration::ZERO);
        }
        Some((*came + PATIENCE).saturating_duration_since(now))
    }

    /// Number of frames without an image that wait.
    pub fn waiting(&self) -> usize {
        self.main.len()
    }

    /// Number of images that came too late, or for which there was no room.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// True if a frame that was published after this image has been handed on.
    fn is_late(&self, image: &WirePiece) -> bool {
        self.passed.is_some_and(|passed| image.stamp.images <= passed.images)
    }

    /// True if all frames without an image before this image have been handed on, or are lost. Before the first one
    /// nothing is known.
    fn is_next(&self, image: &WirePiece) -> bool {
        self.passed.is_some_and(|passed| image.stamp.main <= passed.main)
            || self.main.front().is_some_and(|(_, main)| image.stamp.main < main.stamp.main)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use PieceKind::{Image, Main};

    /// What a board has sent: kinds in its order, each with its number.
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
            order.push(now, sent[at].clone());
        }
        assert_eq!(all(&mut order, now), [0, 1, 2]);
        order.push(now, sent[4].clone());
        assert_eq!((all(&mut order, now), order.wait(now)), (vec![], Some(PATIENCE)));
        assert_eq!(all(&mut order, now + PATIENCE), [4], "it is no longer waited for");
        order.push(now + PATIENCE, sent[3].clone());
        assert_eq!((all(&mut order, now + PATIENCE), order.dropped()), (vec![], 1));
    }

    #[test]
    fn what_was_dropped_on_the_way_holds_nothing_up() {
        let sent = published(&[Main, Image, Image, Main, Image, Main, Main, Image]);
        let now = Instant::now();
        let mut order = PieceOrder::new(5);
        // The first two images are lost: the third one shows that.
        for at in [0, 3, 4] {
            order.push(now, sent[at].clone());
        }
        assert_eq!(all(&mut order, now), [0, 3, 4]);
        // Two mains are lost: an image waits until it is clear that they do not come.
        order.push(now, sent[7].clone());
        assert_eq!((all(&mut order, now), order.wait(now)), (vec![], None));
        let later = WirePiece { stamp: PieceStamp { main: 9, ..sent[7].stamp }, ..sent[6].clone() };
        order.push(now, later);
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
                    .for_each(|piece| order.push(now, piece));
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
        let sent = published(&[[Main].as_slice(), &[Image; 70]].concat());
        let (now, mut order) = (Instant::now(), PieceOrder::new(6));
        order.push(now, sent[0].clone());
        assert_eq!((all(&mut order, now), order.publisher()), (vec![], 6));
        let mut order = PieceOrder::new(5);
        sent.iter().for_each(|piece| order.push(now, piece.clone()));
        let newest: Vec<u8> = [0].into_iter().chain(7..71).collect();
        assert_eq!(all(&mut order, now), newest);
        assert_eq!((order.dropped(), order.waiting()), (6, 0));
    }

    #[test]
    fn an_image_that_comes_first_does_not_pass_what_was_published_before_it() {
        let sent = published(&[Main, Image, Main]);
        let now = Instant::now();
        let mut order = PieceOrder::new(5);
        order.push(now, sent[1].clone());
        assert_eq!((all(&mut order, now), order.wait(now)), (vec![], None));
        order.push(now, sent[0].clone());
        order.push(now, sent[2].clone());
        assert_eq!((all(&mut order, now), order.dropped()), (vec![0, 1, 2], 0));
    }
}
