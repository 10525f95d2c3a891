"""Compares messages with the lines of JSON that say the same."""

import math

# Fields of Contact.msg that are a key of a contact's JSON, or follow from one in another unit.
PHASES = ["onset", "held", "released"]
SAME = """id panel panel_name region link total peak peak_row peak_column top bottom left right area perimeter edge column row anisotropy
breadth_mm nmi nmi_peak nmi_s2 shape confidence moved_columns moved_rows columns_per_s rows_per_s slip unsure duration_ms
peak_total peak_breadth_mm""".split()


def metres(value, mm):
    """The same length: two roundings apart."""
    return math.isclose(value, mm / 1000, rel_tol=1e-14, abs_tol=1e-18)


def contact(message, line, per_newton, frames):
    """All fields of a contact."""
    for field in SAME:
        assert getattr(message, field) == line[field], (field, message, line)
    assert message.contact == (line["phase"] != "released") and PHASES[message.phase] == line["phase"]
    assert message.header.frame_id == frames + line["panel_name"].replace(" ", "_")
    for axis in "xy":
        assert metres(getattr(message.position, axis), line[f"{axis}_mm"])
    assert message.position.z == 0
    azimuth = line["azimuth_rad"]
    assert math.isnan(message.azimuth_rad) if azimuth is None else message.azimuth_rad == azimuth
    assert message.force == line["force_n"] == message.total / per_newton
    # Without a body there is no place on a link.
    assert message.body_link or math.isnan(message.link_position.x)
    stated = set(line) - set(SAME) - {"phase", "x_mm", "y_mm", "azimuth_rad", "force_n"}
    assert not stated, f"without a field: {stated}"
    own = set(message.get_fields_and_field_types()) - set(SAME)
    on_link = {"body_link", "link_position", "link_normal", "link_force"}
    other = {"header", "contact", "phase", "position", "force", "azimuth_rad"}
    assert own == other | on_link


def contacts(message, line, per_newton=1000.0, frames="tactile/"):
    """All fields of a list; `frames` is what the names of the panels' frames begin with."""
    assert message.frame == line["frame"] and message.dropped == line["dropped"]
    assert message.force_basis == line["force_basis"]
    assert message.header.frame_id == ""
    for own, stated in [(message.contacts, line["contacts"]), (message.released, line["released"])]:
        assert len(own) == len(stated)
        for one, other in zip(own, stated):
            assert one.header.stamp == message.header.stamp
            contact(one, other, per_newton, frames)


def symbols(message, line):
    """All fields of Symbols.msg."""
    assert message.frame == line["frame"]
    assert len(message.events) == len(line["events"]) and len(message.regions) == len(line["regions"])
    for one, stated in zip(message.events, line["events"]):
        words = stated["words"]
        own = [one.strength, one.extent, one.span, one.moving, one.shape]
        assert own == [words[key] for key in ["strength", "extent", "span", "moving", "shape"]]
        assert [one.contact, PHASES[one.phase]] == [stated["contact"], stated["phase"]]
        assert one.region == stated["region"]
        assert [one.peak_total, one.duration_ms] == [stated["peak_total"], stated["duration_ms"]]
    for one, stated in zip(message.regions, line["regions"]):
        for key in ["region", "contacts", "total", "peak", "moving"]:
            assert getattr(one, key) == stated[key], key
        assert one.since_us == stated["since_us"]


def intent(message, line):
    """All fields of Intent.msg."""
    assert [message.frame, message.leading] == [line["frame"], line["leading"]]
    assert [message.outcome, message.steps] == [line["outcome"], line["steps"]]
    assert dict(zip(message.concepts, message.activations)) == line["concepts"]


def reaction(message, line):
    """All fields of Reaction.msg."""
    for key in ["frame", "index", "name", "active", "value"]:
        assert getattr(message, key) == line[key], key


def health(message, line):
    """All fields of Health.msg that the line has."""
    for key in ["scans", "failed", "overruns", "thinned_frames", "thinned_contacts", "lost", "refused"]:
        assert getattr(message, key) == line[key], key
    assert [message.scan_us, message.process_us] == [line["scan_us"], line["process_us"]]


def vector(point, stated, scale=1.0):
    """The same point or vector: two roundings apart."""
    for own, other in zip((point.x, point.y, point.z), stated):
        assert math.isclose(own, other / scale, rel_tol=1e-12, abs_tol=1e-12), (point, stated)


def uncertain(message, stated, per_newton):
    """What is unknown: nothing if the line has none."""
    stated = stated or dict.fromkeys(["saturated", "faulty", "less_counts", "more_counts", "off_m"], 0)
    assert [message.saturated, message.faulty] == [stated["saturated"], stated["faulty"]]
    assert [message.less_n, message.more_n] == [stated["less_counts"] / per_newton, stated["more_counts"] / per_newton]
    assert metres(message.off_m, stated["off_m"] * 1000)


BODY_PHASES = ["free", "onset", "held", "moving", "released"]
WAYS = ["none", "forward", "back", "left", "right", "up", "down"]


def body_regions(message, line):
    """All fields of BodyRegions.msg."""
    assert message.frame == line["frame"] and len(message.regions) == len(line["regions"])
    for one, stated in zip(message.regions, line["regions"]):
        own = [one.region, BODY_PHASES[one.phase], WAYS[one.way], one.contacts, one.strength, one.extent, one.shape]
        assert own == [stated[key] for key in ["region", "phase", "way", "contacts", "strength", "extent", "shape"]]
        assert one.since_us == stated["since_us"]


def pressing(message, line, per_newton=1000.0):
    """All fields of Pressing.msg."""
    assert message.frame == line["frame"] and message.force_basis == line["force_basis"]
    for key in ["pose_age_us", "pose_error_m"]:
        own, stated = getattr(message, key), line[key]
        assert math.isnan(own) if stated is None else math.isclose(own, stated, rel_tol=1e-12), key
    assert [len(message.contacts), len(message.links)] == [len(line["contacts"]), len(line["links"])]
    for one, stated in zip(message.contacts, line["contacts"]):
        assert [one.id, one.link] == [stated["id"], stated["link"]]
        vector(one.position, stated["at_m"])
        vector(one.normal, stated["normal"])
        vector(one.force, stated["force_n"])
        if stated["base"] is None:
            assert math.isnan(one.base_position.x)
        else:
            vector(one.base_position, stated["base"]["at_m"])
            vector(one.base_normal, stated["base"]["normal"])
            vector(one.base_force, stated["base"]["force_n"])
        uncertain(one.uncertain, stated["uncertain"], per_newton)
    for one, stated in zip(message.links, line["links"]):
        assert [one.link, one.pressed_counts] == [stated["link"], stated["pressed_counts"]]
        assert one.pressed_n == stated["pressed_n"]
        vector(one.force, stated["force_n"])
        vector(one.moment, stated["moment_nm"])
        vector(one.center, stated["center_m"])
        uncertain(one.uncertain, stated["uncertain"], per_newton)
