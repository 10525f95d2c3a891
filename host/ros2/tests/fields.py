"""Compares messages with the lines of JSON that say the same."""

import math

# Fields of Contact.msg that are a key of a contact's JSON, or follow from one in another unit.
PHASES = ["onset", "held", "released"]
SAME = """id panel panel_name region link total peak peak_row peak_column area perimeter edge x y anisotropy
nmi nmi_peak nmi_s2 shape confidence dx dy vx vy slip unsure duration peak_total""".split()


def metres(value, mm):
    """The same length: two roundings apart."""
    return math.isclose(value, mm / 1000, rel_tol=1e-14, abs_tol=1e-18)


def contact(message, line, per_newton):
    """All fields of a contact."""
    for field in SAME:
        assert getattr(message, field) == line[field], (field, message, line)
    assert message.contact == (line["phase"] != "released") and PHASES[message.phase] == line["phase"]
    assert message.header.frame_id == "tactile/" + line["panel_name"].replace(" ", "_")
    for axis in "xy":
        assert metres(getattr(message.position, axis), line[f"{axis}_mm"])
    assert message.position.z == 0
    assert metres(message.breadth, line["breadth_mm"])
    assert metres(message.peak_breadth, line["peak_breadth_mm"])
    azimuth = line["azimuth"]
    assert math.isnan(message.azimuth) if azimuth is None else message.azimuth == azimuth
    assert message.force == message.total / per_newton
    told = set(line) - set(SAME) - {"phase", "x_mm", "y_mm", "breadth_mm", "peak_breadth_mm", "azimuth"}
    assert not told, f"without a field: {told}"
    own = set(message.get_fields_and_field_types()) - set(SAME)
    assert own == {"header", "contact", "phase", "position", "force", "azimuth", "breadth", "peak_breadth"}


def contacts(message, line, per_newton=1000.0):
    """All fields of a list."""
    assert message.frame == line["frame"] and message.dropped == line["dropped"]
    assert message.header.frame_id == ""
    for own, told in [(message.contacts, line["contacts"]), (message.released, line["released"])]:
        assert len(own) == len(told)
        for one, other in zip(own, told):
            assert one.header.stamp == message.header.stamp
            contact(one, other, per_newton)


def symbols(message, line):
    """All fields of Symbols.msg."""
    assert message.frame == line["frame"]
    assert len(message.events) == len(line["events"]) and len(message.regions) == len(line["regions"])
    for one, told in zip(message.events, line["events"]):
        words = told["words"]
        own = [one.strength, one.extent, one.span, one.moving, one.shape]
        assert own == [words[key] for key in ["strength", "extent", "span", "moving", "class"]]
        assert [one.contact, PHASES[one.phase]] == [told["contact"], told["phase"]]
        assert one.region == told["region"]
        assert [one.peak_total, one.duration] == [told["peak_total"], told["duration_ms"] / 1000]
    for one, told in zip(message.regions, line["regions"]):
        for key in ["region", "contacts", "total", "peak", "moving"]:
            assert getattr(one, key) == told[key], key
        assert one.since == told["since"] / 1e6


def intent(message, line):
    """All fields of Intent.msg."""
    told = line["intent"]
    assert [message.frame, message.leading] == [line["frame"], told["leading"]]
    assert [message.outcome, message.steps] == [line["outcome"], line["steps"]]
    assert dict(zip(message.concepts, message.activations)) == told["concepts"]


def reaction(message, line):
    """All fields of Reaction.msg."""
    for key in ["frame", "index", "name", "active", "value"]:
        assert getattr(message, key) == line[key], key


def health(message, line):
    """All fields of Health.msg that the line has."""
    for key in ["scans", "failed", "overruns", "thinned_frames", "thinned_contacts", "lost", "refused"]:
        assert getattr(message, key) == line[key], key
    assert [message.scan, message.process] == [line["scan_us"] / 1e6, line["process_us"] / 1e6]
