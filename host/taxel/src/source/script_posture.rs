//! The joints of a script, sent to the simulated board as a robot's program sends them to a real one.

use super::pipe::BoardEnd;
use super::touching::Touching;
use crate::sim::{Joint, SimClock, posture};
use taxel_core::fold::{JointAngle, Posture};
use taxel_core::format::Name;
use taxel_core::run::Link;
use taxel_core::scene::Scene;
use taxel_core::wire::{self, Request, encode, frame_bound};

/// Time of the board from one posture to the next, us.
const PERIOD_US: u64 = 20_000;
/// Room for a posture.
const LONGEST: usize = frame_bound(128);

/// The postures of a script, and the scene that says how its joints are numbered.
pub(super) struct ScriptPosture {
    movements: Vec<Joint>,
    /// The joints of the board's scene.
    joints: Vec<Name>,
    /// Bytes that the host has sent of a request that is not complete.
    request: Vec<u8>,
    /// Bytes that are left of a posture that is being read.
    posture: Vec<u8>,
    /// Time of the script at which the next posture is due, us.
    due_us: u64,
    /// The host sends postures of its own.
    is_overruled: bool,
}

impl ScriptPosture {
    /// No postures yet, for a board with this scene.
    pub fn new(scene: &Scene) -> ScriptPosture {
        let joints = scene.joints.to_vec();
        let (movements, request, posture) = (Vec::new(), Vec::new(), Vec::new());
        ScriptPosture { movements, joints, request, posture, due_us: 0, is_overruled: false }
    }

    /// A script with these movements begins.
    pub fn begin(&mut self, movements: &[Joint]) {
        self.movements = movements.to_vec();
        self.due_us = 0;
    }

    /// Further movements: of each joint the newest is kept, until the next has begun.
    fn extend(&mut self, movements: Vec<Joint>) {
        let newer: Vec<_> = self.movements.iter().map(|joint| joint.name.clone()).collect();
        let mut at = 0..;
        self.movements.retain(|_| {
            let at = at.next().unwrap_or(0);
            newer.get(at).is_some_and(|name| !newer[at + 1..].contains(name))
        });
        self.movements.extend(movements);
    }

    /// The board has another scene.
    pub fn follow(&mut self, scene: &Scene) {
        self.joints = scene.joints.to_vec();
    }

    /// The posture that is due at a time of the script, as a request on the wire.
    fn due(&mut self, now_us: u64) -> Option<Vec<u8>> {
        if now_us < self.due_us || self.is_overruled {
            return None;
        }
        self.due_us = now_us - now_us % PERIOD_US + PERIOD_US;
        let joint = |(name, degrees): (&str, f64)| {
            let joint = self.joints.iter().position(|joint| joint == name)? as u8;
            Some(JointAngle { joint, centidegrees: (100.0 * degrees.clamp(-180.0, 180.0)).round() as i16 })
        };
        let joints: Vec<JointAngle> =
            posture(&self.movements, now_us as f64 / 1e6).filter_map(joint).collect();
        let joints = heapless::Vec::from_slice(&joints).ok().filter(|joints| !joints.is_empty())?;
        let mut frame = [0; LONGEST];
        Some(encode(&Request::Posture(Posture { joints }), &mut frame).ok()?.to_vec())
    }

    /// Takes bytes of the host, at most up to the end of a request. A scene that the board is sent numbers the
    /// joints from then on; if the board refuses it, the host's command ends. A posture of the host's own ends
    /// the script's.
    fn pass(&mut self, bytes: &[u8]) {
        self.request.extend_from_slice(bytes);
        if bytes.last() != Some(&0) {
            return;
        }
        let mut request = std::mem::take(&mut self.request);
        request.pop();
        match wire::open(&mut request).and_then(wire::decode) {
            Ok(Request::SetScene(scene)) => {
                postcard::from_bytes::<Scene>(scene).iter().for_each(|scene| self.follow(scene));
            }
            Ok(Request::Posture(_)) => self.is_overruled = true,
            _ => {}
        }
    }
}

/// The board's end of the link, on which postures come between the host's requests, and what touches the garment
/// is looked after.
pub(super) struct PosturesEnd<'a> {
    link: &'a BoardEnd,
    postures: &'a mut ScriptPosture,
    touching: Touching<'a>,
    clock: SimClock,
}

impl<'a> PosturesEnd<'a> {
    pub fn new(
        link: &'a BoardEnd,
        postures: &'a mut ScriptPosture,
        touching: Touching<'a>,
        clock: SimClock,
    ) -> Self {
        PosturesEnd { link, postures, touching, clock }
    }
}

impl Link for PosturesEnd<'_> {
    fn try_read(&mut self, buffer: &mut [u8]) -> usize {
        let now_ns = self.clock.now_ns();
        let begin = self.touching.act(now_ns);
        if !begin.is_empty() {
            self.postures.extend(begin);
        }
        if self.postures.movements.is_empty() {
            return self.link.try_read(buffer);
        }
        if self.postures.posture.is_empty()
            && self.postures.request.is_empty()
            && let Some(posture) = self.postures.due(now_ns / 1000)
        {
            self.link.note_request(&posture);
            self.postures.posture = posture;
        }
        let count = self.postures.posture.len().min(buffer.len());
        if count > 0 {
            buffer[..count].copy_from_slice(&self.postures.posture[..count]);
            self.postures.posture.drain(..count);
            return count;
        }
        let count = self.link.read_request(buffer);
        self.postures.pass(&buffer[..count]);
        count
    }

    fn try_write(&mut self, bytes: &[u8]) -> usize {
        self.link.try_write(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Port;
    use super::super::hand::Hand;
    use super::super::pipe::pipe;
    use super::super::touching::Rounds;
    use super::*;
    use crate::files::scripts;
    use crate::sim::SimBoard;
    use taxel_core::format::name;
    use taxel_core::garment::{Garment, Layout};
    use taxel_core::scene::Scene;

    /// The requests on a wire, without their ends.
    fn requests(bytes: &[u8]) -> Vec<Vec<u8>> {
        bytes.split(|byte| *byte == 0).filter(|it| !it.is_empty()).map(<[u8]>::to_vec).collect()
    }

    fn read(end: &mut PosturesEnd<'_>) -> Vec<u8> {
        let (mut all, mut buffer) = (Vec::new(), [0; 7]);
        loop {
            let count = end.try_read(&mut buffer);
            if count == 0 {
                return all;
            }
            all.extend_from_slice(&buffer[..count]);
        }
    }

    #[test]
    fn postures_come_between_requests_and_are_numbered_as_the_scene_says() {
        let script = scripts::load("elbow").unwrap();
        let mut scene = Scene::shipped();
        scene.joints = [name("waist"), name("left_elbow")].into_iter().collect();
        let (mut host, board) = pipe();
        let garment = Garment::reference();
        let SimBoard { clock, hand: sim_hand, .. } = SimBoard::new(&garment, &script, 1).unwrap();
        let hand = Hand::new(script.untouched(), Layout::build(&garment, 2048, 4095).unwrap());
        let mut postures = ScriptPosture::new(&Scene::shipped());
        postures.begin(&script.joints);
        let touching = Touching::new(&hand, sim_hand, &script, Rounds::One);
        let mut end = PosturesEnd::new(&board, &mut postures, touching, clock.clone());
        clock.advance_to(750_000);
        let mut wire = [0; 4096];
        let bytes = postcard::to_allocvec(&scene).unwrap();
        let frame = encode(&Request::SetScene(&bytes), &mut wire).unwrap().to_vec();
        let (start, rest) = frame.split_at(frame.len() / 2);
        host.write(start).unwrap();
        let first = read(&mut end);
        clock.advance_to(770_000);
        // A request is not interrupted.
        host.write(rest).unwrap();
        let second = read(&mut end);
        let all = requests(&[first, second].concat());
        let [before, set, after] = &all[..] else { panic!("{} requests", all.len()) };
        assert_eq!(set[..], frame[..frame.len() - 1]);
        let angle = |frame: &[u8]| {
            let mut frame = frame.to_vec();
            match wire::open(&mut frame).and_then(wire::decode::<Request<'_>>) {
                Ok(Request::Posture(posture)) => posture.joints[0],
                other => panic!("{other:?}"),
            }
        };
        // Half of the way to 110 degrees.
        assert_eq!(angle(before), JointAngle { joint: 0, centidegrees: 5500 });
        assert_eq!(angle(after).joint, 1);
        assert!(angle(after).centidegrees > 5500);
        assert!(read(&mut end).is_empty(), "the next one is not due");
        // The host learns of them with what the board says afterwards.
        assert!(host.own_requests().is_empty());
        (&board).try_write(&[1, 2, 3]);
        assert_eq!(host.read(&mut wire).unwrap(), Some(3));
        assert_eq!(requests(&host.own_requests()), [before.clone(), after.clone()]);
        assert!(host.own_requests().is_empty());
        // Once the host sends a posture, the script's are none.
        let own = encode(&Request::Posture(Posture::default()), &mut wire).unwrap().to_vec();
        host.write(&own).unwrap();
        clock.advance_to(790_000);
        assert_eq!(requests(&read(&mut end)).len(), 2);
        clock.advance_to(990_000);
        assert!(read(&mut end).is_empty());
    }
}
