"""`taxel.VirtualBoard`: the very board, stepped by hand."""

from __future__ import annotations

import numpy as np
import pytest
import taxel

PERCEIVED = ["frame", "contacts", "symbols", "intent", "reaction"]
SCENES = ["pat", "lash", "two-hands", "five"]


@pytest.mark.parametrize("scene", SCENES)
def test_it_perceives_what_the_simulation_perceives(scene: str) -> None:
    with taxel.open(f"sim:{scene}", raw=True, tare=0) as stream:
        events = list(stream)
    scans = [event for event in events if isinstance(event, taxel.Raw)]
    board = taxel.VirtualBoard()
    stepped: list[taxel.Event] = []
    for scan in scans:
        assert scan.codes is not None
        stepped += board.step(scan.codes, scan.time_us)
    for kind in PERCEIVED:
        want = [event.json() for event in events if event.type == kind]
        have = [event.json() for event in stepped if event.type == kind]
        count = min(len(want), len(have))
        assert have[:count] == want[:count] and abs(len(want) - len(have)) <= 1, kind
    images = {event.frame: event.image for event in events if isinstance(event, taxel.Frame)}
    for event in stepped:
        if isinstance(event, taxel.Frame) and event.frame in images:
            mine, theirs = event.image, images[event.frame]
            assert mine is not None and theirs is not None and np.array_equal(mine, theirs)
    assert len(images) > 100


def test_the_box_of_a_contact_holds_its_taxels() -> None:
    board = taxel.VirtualBoard("block-4x16")
    board.tare(frames=8)
    codes = np.full((4, 16), 100, np.uint16)
    images: list[taxel.Frame] = []
    for frame in range(30):
        if frame == 20:
            codes[1:3, 4:9] = 900
        events = board.step(codes.ravel(), frame * 5000)
        images += [event for event in events if isinstance(event, taxel.Frame)]
    (contact,) = images[-1].contacts
    assert [int(contact[side]) for side in ("top", "bottom", "left", "right")] == [1, 2, 4, 8]
    image = images[-1].panels[str(contact["panel_name"])]
    inside = image[contact["top"] : contact["bottom"] + 1, contact["left"] : contact["right"] + 1]
    assert inside.sum() == contact["total"] == image.sum()


def test_codes_are_checked() -> None:
    board = taxel.VirtualBoard("block-4x16")
    assert board.taxels == 64
    with pytest.raises(taxel.UsageError, match="63 codes for a garment of 64 taxels"):
        board.step(np.zeros(63, np.uint16), 0)
    with pytest.raises(TypeError, match="whole numbers"):
        board.step(np.zeros(64), 0)
    with pytest.raises(taxel.UsageError, match="0 to 65535"):
        board.step(np.full(64, -1), 0)
    with pytest.raises(TypeError):
        board.step(np.zeros((8, 8), np.uint16), 0)
    board.step([100] * 64, 5000)
    with pytest.raises(taxel.UsageError, match="before the last one"):
        board.step([100] * 64, 4999)
    with pytest.raises(taxel.UsageError, match='no garment "shirt"'):
        taxel.VirtualBoard("shirt")


def test_requests_reach_it_with_the_next_step() -> None:
    board = taxel.VirtualBoard("block-4x16", "rate_hz = 0\nname = \"mine\"")
    hello = [event for event in board.step([100] * 64, 0) if isinstance(event, taxel.Hello)]
    assert hello[0].scene == "mine" and hello[0].taxels == 64
    board.tare(4)
    events = [event for frame in range(1, 8) for event in board.step([100] * 64, frame * 5000)]
    answers = [event.request for event in events if isinstance(event, taxel.Answer)]
    assert answers == ["tare"]
    board.save()
    events = [event for frame in range(8, 40) for event in board.step([100] * 64, frame * 5000)]
    refusals = [event.refusal for event in events if isinstance(event, taxel.Answer)]
    assert len(refusals) == 1 and "no flash" in str(refusals[0])
