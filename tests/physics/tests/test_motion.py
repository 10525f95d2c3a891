"""From touch to motion, judged by MuJoCo: hands on springs press an arm and a humanoid that `taxel.Motion` moves.

`TAXEL_TOUCHES=N` sets the touches of each robot (500).
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
import taxel

from taxel_physics.touchers import HAND_KG, HAND_M, STEP_S, Felt, Hand, Joint, TouchedRobot, arm, humanoid, urdf

Array = npt.NDArray[np.float64]
Drive = Callable[[float, TouchedRobot], None]

TOUCHES = int(os.environ.get("TAXEL_TOUCHES", "500"))
CYCLE_S = 1 / 195
LATE_S = 0.008
"""What a board takes from the scan to the message, and this machine to the command."""
JUDGED_S = 0.1
"""Time from the first touch within which directions are judged."""
LIMIT_N = 25.0
PALM = 5000.0
"""Stiffness of a palm on cloth, N/m."""
TANK_J = 1.0
LIFTED = np.array([0.3, 0.9, 0.2, 1.1, 0.1, 0.6, 0.0])
RETREATS = f"""name = "judged"
tank_j = {TANK_J}
[retreat]
speed = 0.25
[[when]]
newtons = 1.5
do = "retreat"
[[limits]]
newtons = {LIMIT_N}
source = "the test"
"""
LEADS = 'name = "led"\n[[when]]\nnewtons = 0.3\ndo = "yield"\n'


@dataclass
class Played:
    """What has happened."""

    force: list[tuple[float, float]] = field(default_factory=list)
    """Time since the first touch, greatest force, N."""
    angles: list[tuple[float, float, float]] = field(default_factory=list)
    """Least singular value, m/rad; angle of the commanded velocity from the inward normal, degrees; its share, m/s."""
    links: set[str] = field(default_factory=set)
    """Links that were told while directions were judged."""
    given: float = 0.0
    absorbed: float = 0.0
    deeds: list[str] = field(default_factory=list)
    speeds: list[tuple[float, float]] = field(default_factory=list)
    """Time, and speed of the touched point of the first hand, m/s."""
    gone: float = 0.0


class Judged:
    """A robot that is moved by touch, with a board that is as late as boards are."""

    def __init__(self, joints: list[Joint], behaviour: str, folder: Path, hands: int, skin: float = 40_000.0) -> None:
        (folder / "robot.urdf").write_text(urdf(joints))
        (folder / "b.toml").write_text(behaviour)
        self.paths = (folder / "robot.urdf", folder / "b.toml")
        self.robot = TouchedRobot(joints, [Hand(np.zeros(3), 5000.0, 100.0) for _ in range(hands)], skin)
        names = taxel.Motion(*self.paths).joints
        assert names == [joint.name for joint in joints]
        self.limits = np.array([joint.limits for joint in joints])

    def play(
        self, seconds: float, drive: Drive, plan: Array, *, leading: Callable[[float], str] = lambda now: "none"
    ) -> Played:
        """Plays a scene from the present posture; `drive(time, robot)` drives the hands."""
        robot, played = self.robot, Played()
        motion = taxel.Motion(*self.paths)
        sent: deque[tuple[float, list[taxel.MotionTouch], list[Felt]]] = deque()
        touches: list[taxel.MotionTouch] = []
        told: list[Felt] = []
        velocities, speed = np.zeros(robot.count), 1.0
        motion.arm(robot.posture, 1_000_000, frame_us=990_000)
        next_cycle, began, last = 0.0, None, None
        for step in range(int(seconds / STEP_S)):
            now = step * STEP_S
            drive(now, robot)
            if now >= next_cycle:
                next_cycle += CYCLE_S
                felt = robot.felt()
                sent.append((now, [self._touch(each) for each in felt], felt))
                while sent and now - sent[0][0] >= LATE_S:
                    _, touches, told = sent.popleft()
                us = 1_000_001 + int(now * 1e6)
                command = motion(
                    robot.posture, us, touches, leading=leading(now), frame_us=us - int(LATE_S * 1e6)
                )
                assert command.phase == "armed", command.fault
                velocities, speed = command.velocities, command.speed or 0.0
                played.deeds.append(command.deed)
                if began is not None and now - began < JUDGED_S and command.deed == "retreat" and velocities.any():
                    self._judge(played, told, velocities)
            felt = robot.felt()
            if felt and began is None:
                began = now
            if began is not None:
                played.force.append((now - began, max((each.newtons for each in felt), default=0.0)))
            for each in felt:
                power = float(each.force @ (robot.jacobian(each.link, each.at) @ velocities)) * STEP_S
                played.given += max(power, 0.0)
                played.absorbed += max(-power, 0.0)
                if each.hand == 0:
                    last = (each.link, robot.local(each.link, each.at, is_place=True))
            if last is not None:
                body = robot.data.body(last[0])
                at = body.xpos + np.array(body.xmat).reshape(3, 3) @ last[1]
                moved = float(np.linalg.norm(robot.jacobian(last[0], at) @ velocities))
                played.speeds.append((now, moved))
                played.gone += moved * STEP_S
            robot.step(velocities + speed * plan)
        return played

    def _touch(self, felt: Felt) -> taxel.MotionTouch:
        at = self.robot.local(felt.link, felt.at, is_place=True)
        normal = self.robot.local(felt.link, felt.normal, is_place=False)
        return taxel.MotionTouch(felt.link, at, normal, felt.newtons, touch=felt.hand)

    def _judge(self, played: Played, felt: list[Felt], velocities: Array) -> None:
        # A hand that meets a second link is two touches: velocities then turn as fast as accelerations allow.
        played.links |= {each.link for each in felt}
        if len(felt) != 1 or len(played.links) > 1:
            return
        jacobian = self.robot.jacobian(felt[0].link, felt[0].at)
        velocity = jacobian @ velocities
        size = float(np.linalg.norm(velocity))
        share = float(-felt[0].normal @ velocity)
        if size > 1e-4:
            angle = float(np.degrees(np.arccos(np.clip(share / size, -1, 1))))
            played.angles.append((float(np.linalg.svd(jacobian, compute_uv=False)[-1]), angle, share))

    def surface(self, link: str, along: float, about: float) -> tuple[Array, Array]:
        """A place of a link's side, and the outward normal there, in the base."""
        joint = next(joint for joint in self.robot.joints if joint.link == link)
        body = self.robot.data.body(link)
        rotation = np.array(body.xmat).reshape(3, 3)
        normal = rotation @ np.array([np.cos(about), np.sin(about), 0.0])
        return body.xpos + rotation @ np.array([0, 0, along * joint.length]) + joint.radius * normal, normal


def presses(
    judged: Judged, hand: int, at: Array, course: Array, newtons: float, stiffness: float, speed: float
) -> Drive:
    """Drives a hand against a place until it would press with a force, if nothing gave way."""
    start = at - course * (HAND_M + 0.003)
    robot = judged.robot
    robot.put(hand, start)
    robot.hands[hand].stiffness = stiffness
    robot.hands[hand].damping = 2.0 * 0.7 * (stiffness * HAND_KG) ** 0.5

    def drive(now: float, robot: TouchedRobot) -> None:
        robot.hands[hand].driven = start + course * min(speed * now, 0.003 + newtons / stiffness)

    return drive


def sustained(played: Played, after: float) -> float:
    """Greatest mean force over 50 ms that begin so long after the first touch: what is held, and no blow, N."""
    forces = np.array([force for since, force in played.force if since > after])
    width = int(0.05 / STEP_S)
    return float(np.convolve(forces, np.full(width, 1 / width), "valid").max()) if forces.size >= width else 0.0


@pytest.mark.parametrize("kind", ["arm", "humanoid"])
def test_random_touches_are_left_along_their_normals(kind: str, tmp_path: Path) -> None:
    joints = arm() if kind == "arm" else humanoid()
    judged = Judged(joints, RETREATS, tmp_path, 1)
    random = np.random.default_rng(65)
    links = [joint.link for joint in joints if joint.length > 0.1][2:]
    regular, singular, late, work, count = [], [], [], [], 0
    low, high = judged.limits.T
    for _ in range(4 * TOUCHES):
        if count == TOUCHES:
            break
        posture = random.uniform(low + 0.25, high - 0.25)
        judged.robot.put(0, np.full(3, 9.0))
        judged.robot.pose(posture)
        at, normal = judged.surface(str(random.choice(links)), random.uniform(0.2, 0.8), random.uniform(0, 2 * np.pi))
        aside = np.cross(normal, random.normal(size=3))
        course = -normal + np.tan(np.radians(random.uniform(0, 25))) * aside / np.linalg.norm(aside)
        newtons, stiffness, speed = random.uniform((2, 5e3, 0.05), (60, 5e4, 0.25))
        drive = presses(judged, 0, at, course / np.linalg.norm(course), newtons, stiffness, speed)
        plan = random.uniform(-0.3, 0.3, len(joints)) if random.random() < 0.5 else np.zeros(len(joints))
        if judged.robot.felt():
            continue  # Another link is in the way.
        played = judged.play(0.45, drive, plan)
        if max((force for _, force in played.force), default=0.0) < 2.0:
            continue  # It has slipped past.
        count += 1
        after = judged.robot.posture
        assert (after >= low - 1e-6).all() and (after <= high + 1e-6).all(), "a joint is beyond its limits"
        regular += [angle for least, angle, _ in played.angles if least > 0.05]
        singular += [share for least, _, share in played.angles if least <= 0.05]
        late.append(sustained(played, 0.15))
        work.append(played.given - played.absorbed)
        assert played.given <= TANK_J + played.absorbed
    assert count == TOUCHES
    below = float(np.mean(np.array(late) < LIMIT_N))
    print(
        f"\n{kind}: {count} touches; {len(regular)} cycles, worst {max(regular):.1f} degrees off the normal, "
        f"99 % {np.percentile(regular, 99):.1f}; {len(singular)} near singular, least share "
        f"{min(singular, default=0):.4f} m/s; "
        f"after 150 ms below {LIMIT_N:.0f} N in {100 * below:.1f} %, 99 % {np.percentile(late, 99):.1f} N; "
        f"most work on a hand {max(work):.3f} J"
    )
    assert max(regular) < 15.0
    assert min(singular, default=1.0) > 0.0
    assert below >= 0.99


@pytest.mark.parametrize("kind", ["arm", "humanoid"])
def test_clamped_between_two_hands_it_gives_no_work(kind: str, tmp_path: Path) -> None:
    joints = arm() if kind == "arm" else humanoid()
    judged = Judged(joints, RETREATS, tmp_path, 2)
    random = np.random.default_rng(66)
    links = [joint.link for joint in joints if joint.length > 0.15][2:]
    most, clamped = 0.0, 0
    low, high = judged.limits.T
    for _ in range(40):
        posture = random.uniform(low + 0.3, high - 0.3)
        judged.robot.pose(posture)
        link, along, about = str(random.choice(links)), random.uniform(0.3, 0.7), random.uniform(0, 2 * np.pi)
        drives = []
        for hand, side in ((0, 0.0), (1, np.pi)):
            at, normal = judged.surface(link, along, about + side)
            drives.append(presses(judged, hand, at, -normal, random.uniform(8, 40), 2e4, 0.2))

        def drive(now: float, robot: TouchedRobot, drives: list[Drive] = drives) -> None:
            for each in drives:
                each(now, robot)

        if judged.robot.felt():
            continue
        begun = judged.play(0.35, drive, np.zeros(len(joints)))
        if begun.deeds[-1] != "clamped":
            continue
        clamped += 1
        # Both were told long ago: go on from here.
        held = judged.play(0.2, lambda now, robot: None, np.zeros(len(joints)))
        later = held.deeds[4:]
        assert set(later) == {"clamped"}, later
        speeds = [speed for now, speed in held.speeds if now > 0.1]
        most = max(most, max(speeds, default=0.0))
    print(f"\n{kind}: {clamped} of 40 clamped; fastest point 100 ms after both are told {most:.6f} m/s")
    assert clamped >= 30 and most == 0.0


def test_it_is_led_by_hand_and_rests_when_let_go(tmp_path: Path) -> None:
    judged = Judged(arm(), LEADS, tmp_path, 1, PALM)
    forces, rests, ways = [], [], []
    for about in (0.0, 0.8, 1.6, 4.7, 5.5):
        robot = judged.robot
        robot.put(0, np.full(3, 9.0))
        robot.pose(LIFTED)
        at, normal = judged.surface("a4_link", 0.7, about)
        start = at + normal * (HAND_M + 0.001)
        robot.put(0, start)
        # A person's hand: 1 N/mm.
        robot.hands[0].stiffness, robot.hands[0].damping = 1000.0, 60.0
        way, gone = 0.003, start

        def drive(now: float, robot: TouchedRobot, normal: Array = normal) -> None:
            nonlocal way, gone
            # The hand follows the surface that it leads: its course is the normal there.
            felt = robot.felt()
            course = -felt[0].normal if felt else -normal
            if now < 0.35:
                gone = start - normal * 0.003
            elif way < 0.5:
                way += 0.2 * STEP_S
                gone = gone + course * 0.2 * STEP_S
            else:
                gone = gone - course * 1.0 * STEP_S
            robot.hands[0].driven = gone

        played = judged.play(3.6, drive, np.zeros(7))
        leading = [force for since, force in played.force if 1.0 < since < 2.7]
        forces.append(float(np.mean(leading)))
        let_go = next(since for since, force in played.force if since > 2.75 and force == 0.0)
        begun = played.speeds[0][0]
        rests.append(max(speed for now, speed in played.speeds if now - begun > let_go + LATE_S + 0.2))
        ways.append(played.gone)
    print(
        f"\nled: ways {min(ways):.3f} to {max(ways):.3f} m at 0.2 m/s, "
        f"mean force {np.mean(forces):.2f} N, most {max(forces):.2f}; "
        f"speed 0.2 s after the hand has gone at most {1e3 * max(rests):.1f} mm/s"
    )
    assert min(ways) > 0.45 and max(forces) < 5.0 and max(rests) < 0.01


def test_a_pat_does_not_move_it_and_a_blow_does(tmp_path: Path) -> None:
    rows = '[[when]]\nmeaning = "attack"\ndo = "retreat"\n[[when]]\nnewtons = 1\ndo = "yield"\n'
    judged = Judged(arm(), 'name = "people"\n' + rows, tmp_path, 1)
    robot = judged.robot
    robot.pose(LIFTED)
    at, normal = judged.surface("a4_link", 0.5, 0.4)
    start = at + normal * (HAND_M + 0.004)
    robot.put(0, start)
    robot.hands[0].stiffness, robot.hands[0].damping = 5000.0, 100.0

    def pats(now: float, robot: TouchedRobot) -> None:
        robot.hands[0].driven = start - normal * (0.006 if now % 0.4 < 0.15 else 0.0)

    played = judged.play(2.0, pats, np.zeros(7))
    assert max(force for _, force in played.force) > 2.0 and played.gone == 0.0
    # A blow of 50 ms, understood 0.2 s after it: too late to press, and yet left.
    robot.put(0, start)
    blown = judged.play(
        0.8,
        lambda now, robot: pats(0.0 if now < 0.05 else 0.3, robot),
        np.zeros(7),
        leading=lambda now: "attack" if now > 0.25 else "none",
    )
    first = next(number for number, deed in enumerate(blown.deeds) if deed == "retreat")
    assert 0.25 <= first * CYCLE_S < 0.26 + CYCLE_S and blown.gone > 0.03
