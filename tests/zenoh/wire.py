"""Frames of the wire, as docs/reference/wire.md describes them."""

import zlib
from dataclasses import dataclass
from pathlib import Path

#: Numbers of the reports that hold an image or raw codes, of the first one, and of contacts.
IMAGES = (21, 22)
HELLO = 0
CONTACTS = 8


@dataclass(frozen=True)
class Frame:
    """A message of a board."""

    #: Its bytes on the wire, without the 0x00.
    raw: bytes
    #: The board's number of the message, and of the report.
    seq: int
    report: int
    #: Number of the scan, of reports that begin with it.
    scan: int


def read(raw: bytes) -> Frame | None:
    """Reads a frame; none if it is damaged."""
    message = unstuffed(raw)
    if message is None or len(message) < 6 or zlib.crc32(message[:-4]) != int.from_bytes(message[-4:], "little"):
        return None
    seq, rest = varint(message[:-4])
    report, rest = varint(rest)
    scan, _ = varint(rest)
    return Frame(raw, seq, report, scan)


def frames(path: Path) -> tuple[list[Frame], int]:
    """Frames of saved bytes, and the number of damaged ones. What follows the last 0x00 is not complete."""
    parts = [part for part in path.read_bytes().split(b"\0")[:-1] if part]
    found = [read(part) for part in parts]
    return [frame for frame in found if frame], found.count(None)


def unstuffed(raw: bytes) -> bytes | None:
    """Undoes COBS."""
    out = bytearray()
    at = 0
    while at < len(raw):
        code = raw[at]
        if code == 0 or at + code > len(raw):
            return None
        out += raw[at + 1 : at + code]
        at += code
        if code < 255 and at < len(raw):
            out.append(0)
    return bytes(out)


def varint(data: bytes) -> tuple[int, bytes]:
    """Reads a number; 0 if there is none."""
    value = 0
    for at, byte in enumerate(data[:10]):
        value |= (byte & 0x7F) << (7 * at)
        if byte < 0x80:
            return value, data[at + 1 :]
    return value, b""
