"""Contacts of a board's stream, all of them, and what they say."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import fields
from conftest import FIVE, LONG, NEWEST, PROGRAM, REAL_TIME, lines, taxel
from sensor_msgs.msg import Image
from std_msgs.msg import String
from taxel_msgs.msg import Contacts

# Messages of five contacts; at 195 per second.
MANY = 10_000 if LONG else 1_000
SOURCE = f"sim:{FIVE}"
PANELS = ["chest", "back", "left_arm", "right_arm"]
# Longest time from the publication to the callback of 99 % of the messages, ms.
P99_MS = 5.0


def of_five(got):
    """The messages from the first with five contacts on."""
    first = next((at for at, one in enumerate(got.messages) if len(one.contacts) == 5), None)
    return [] if first is None else got.messages[first : first + MANY]


def complete(got):
    """Fails unless no list is missing, and each has five contacts."""
    many = of_five(got)
    assert len(many) == MANY
    assert [one.frame for one in many] == list(range(many[0].frame, many[0].frame + MANY))
    assert all(len(one.contacts) == 5 for one in many)
    return many


def resident(process):
    """Resident memory of a process, MB."""
    status = Path(f"/proc/{process.pid}/status").read_text()
    return int(status.split("VmRSS:")[1].split()[0]) / 1000


def test_all_contacts_arrive_and_say_what_json_says(listener):
    got = listener.hear(Contacts, "/taxel/contacts")
    heard = listener.hear(String, "/taxel/json")
    with taxel("--source", SOURCE, "--image-hz", "0"):
        listener.spin(lambda: len(of_five(got)) == MANY, 20 + MANY / 150)
        listener.rest(0.5)
    many = complete(got)
    by_frame = {}
    for message in heard.messages:
        line = json.loads(message.data)
        if line["type"] == "contacts":
            by_frame[line["frame"]] = line
    for one in many:
        fields.contacts(one, by_frame[one.frame])
    # Another run of the same touches, by another way.
    again = {line["frame"]: line for line in lines(SOURCE, 8) if line["type"] == "contacts"}
    shared = [one for one in many if one.frame in again]
    assert len(shared) > 500
    for one in shared:
        fields.contacts(one, again[one.frame])
    p99 = got.table(f"{MANY} of {MANY} lists of five contacts, {len(shared)} of them also by taxel live")
    assert not REAL_TIME or p99 <= P99_MS


def test_nothing_is_lost_while_images_are_sent_and_another_is_slow(listener):
    got = listener.hear(Contacts, "/taxel/contacts")
    images = [listener.hear(Image, f"/tactile/{panel}/image", NEWEST) for panel in PANELS]
    words = [sys.executable, Path(__file__).parent / "slow.py"]
    slow = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    with taxel("--source", SOURCE, "--image-hz", "50") as node:
        listener.spin(lambda: len(of_five(got)) > 100, 30)
        before = resident(node)
        # It confirms nothing for as long.
        slow.send_signal(signal.SIGSTOP)
        listener.rest(5 if LONG else 2)
        slow.send_signal(signal.SIGCONT)
        if LONG:
            # It is killed: the node finds out by itself.
            listener.rest(5)
            slow.kill()
        listener.spin(lambda: len(of_five(got)) == MANY, 20 + MANY / 150)
        grown = resident(node) - before
    slow.kill()
    slowly = slow.stdout.read().split()
    assert slowly, "the slow one has heard nothing"
    complete(got)
    counts = [len(image.messages) for image in images]
    assert min(counts) > 0
    assert grown < 64, f"{grown:.0f} MB more"
    p99 = got.table(f"{MANY} of {MANY} with {sum(counts)} images, beside a slow one that took {len(slowly)}")
    assert not REAL_TIME or p99 <= P99_MS


def test_a_node_that_was_killed_is_found_again(listener):
    got = listener.hear(Contacts, "/taxel/contacts")
    waits = []
    for _ in range(3 if LONG else 2):
        before = len(got.messages)
        words = [PROGRAM, "ros2", "--source", "sim:five"]
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL)
        began = time.monotonic()
        listener.spin(lambda: len(got.messages) > before + 10, 20)
        waits.append(time.monotonic() - began)
        process.kill()
        process.wait()
    print("ros2: killed and started again: contacts after", ", ".join(f"{wait:.1f}" for wait in waits), "s")
