"""`taxel.VirtualBoard`: the very board, stepped by hand."""

from __future__ import annotations

import urllib.request
from pathlib import Path

import numpy as np
import pytest
import taxel
from conftest import program

PERCEIVED = ["frame", "contacts", "symbols", "intent", "reaction"]
SCENES = ["pat", "lash", "two-hands", "five"]


@pytest.mark.parametrize("scene", SCENES)
def test_it_perceives_what_the_simulation_perceives(scene: str) -> None:
    with taxel.open(f"sim:{scene}", raw=True, tare=0) as stream:
        events = list(stream)
    scans = [event for event in events if isinstance(event, taxel.Raw)]
    board = taxel.VirtualBoard(counts_per_newton=1000)
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


def test_any_array_is_seen_and_recorded(tmp_path: Path) -> None:
    mat = taxel.Garment.grid(12, 21, pitch_mm=(10, 12.5), name="mat")
    assert (mat.taxels, mat.panels, repr(mat)) == (252, {"mat": (12, 21)}, "Garment('mat': mat 12x21)")
    file = tmp_path / "mat.mcap"
    rest, codes = np.full((12, 21), 8, np.uint8), np.full((12, 21), 8, np.uint8)
    codes[4:6, 9:12] = 120
    with taxel.VirtualBoard(mat, full_scale=255, record=file, view=True) as board:
        assert board.shape == (12, 21) and board.page is not None
        with urllib.request.urlopen(board.page) as page:
            assert b"taxel" in page.read()
        board.tare(frames=8)
        events = [event for at in range(90) for event in board.step(rest if at < 20 else codes, at * 16_667)]
    frames = [event for event in events if isinstance(event, taxel.Frame)]
    (contact,) = frames[-1].contacts
    # 112 of 255 are 1799 of 4095.
    assert (contact["area"], contact["total"]) == (6, 6 * 1799)
    assert (contact["x_mm"], contact["y_mm"]) == (100.0, 4.5 * 12.5)
    recorded = taxel.read(file)
    assert recorded.is_whole and recorded.metadata["taxel"]["garment"] == "mat"
    assert [frame.image.tobytes() for frame in recorded.frames() if frame.image is not None] == [
        frame.image.tobytes() for frame in frames if frame.image is not None
    ]
    with pytest.raises(taxel.Error, match="mat.mcap"):
        taxel.VirtualBoard(mat, record=file)
    own = tmp_path / "own.toml"
    program("config", "new", str(own))
    text = own.read_text(encoding="utf-8")
    with pytest.raises(taxel.Error, match="own.toml"):
        taxel.VirtualBoard(own, record=own, overwrite=True)
    assert own.read_text(encoding="utf-8") == text


def test_grids_and_scans_that_cannot_be_are_refused() -> None:
    for options, why in [
        ({"rows": 0, "columns": 4}, "rows"),
        ({"rows": 64, "columns": 64}, "4096 taxels"),
        ({"rows": 4, "columns": 4, "pitch_mm": 0.1}, "0.5 to 200"),
        ({"rows": 4, "columns": 4, "name": ""}, "no name"),
    ]:
        with pytest.raises(taxel.UsageError, match=why):
            taxel.Garment.grid(**options)  # type: ignore[arg-type]
    board = taxel.VirtualBoard(taxel.Garment.grid(12, 21), full_scale=255)
    with pytest.raises(taxel.UsageError, match=r"\(21, 12\) for a garment that takes \(12, 21\) or \(252,\)"):
        board.step(np.zeros((21, 12), np.uint8), 0)
    with pytest.raises(taxel.UsageError, match="code 256 of taxel 3 is beyond full_scale=255"):
        board.step([0, 0, 0, 256] + [0] * 248, 0)
    with pytest.raises(taxel.UsageError, match="full_scale"):
        taxel.VirtualBoard(full_scale=0)


def test_codes_are_checked() -> None:
    board = taxel.VirtualBoard("block-4x16")
    assert board.taxels == 64
    with pytest.raises(taxel.UsageError, match="63 codes for a garment of 64 taxels"):
        board.step(np.zeros(63, np.uint16), 0)
    with pytest.raises(TypeError, match="whole numbers"):
        board.step(np.zeros(64), 0)
    with pytest.raises(taxel.UsageError, match="0 to 65535"):
        board.step(np.full(64, -1), 0)
    with pytest.raises(taxel.UsageError, match=r"\(8, 8\) for a garment that takes \(4, 16\) or \(64,\)"):
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


def test_a_program_pushes_frames_of_any_numbers(tmp_path: Path) -> None:
    file = tmp_path / "mat.mcap"
    with taxel.Source(4, 6, range=(-1, 1), falling=True, name="sole", record=file) as source:
        known = taxel.VirtualBoard(taxel.Garment.grid(4, 6, name="sole"))
        known.tare(frames=32)
        frame, codes = np.full((4, 6), 0.9, np.float32), np.full((4, 6), 205, np.uint16)
        for number in range(50):
            if number == 40:
                frame[1:3, 2:4], codes[1:3, 2:4] = -0.25, 2559
            events = source.push(frame, number * 10_000)
            again = known.step(codes, number * 10_000)
        [contact] = next(event for event in events if isinstance(event, taxel.Frame)).contacts
        [same] = next(event for event in again if isinstance(event, taxel.Frame)).contacts
        assert contact.tobytes() == same.tobytes() and contact["area"] == 4
        with pytest.raises(taxel.UsageError, match=r"the value at \[0, 5\] is no number"):
            frame[0, 5] = np.nan
            source.push(frame, 500_000)
        with pytest.raises(taxel.UsageError, match="codes of shape"):
            source.push(np.zeros((4, 5)), 500_000)
    assert taxel.read(file).metadata["taxel"]["garment"] == "sole"
    with pytest.raises(taxel.UsageError, match="low < high"):
        taxel.Source(4, 6, range=(1, 1))


def test_frames_without_a_time_have_that_of_the_host() -> None:
    source = taxel.Source(2, 2, range=(0, 1))
    first = [event for _ in range(3) for event in source.push(np.zeros((2, 2))) if isinstance(event, taxel.Frame)]
    assert 0 == first[0].time_us <= first[-1].time_us < 10_000_000
