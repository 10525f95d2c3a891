"""Zenoh's Python client: prints what it gets below taxel/, one JSON object a line, until it is killed.

With `contacts` it prints the times of frames with contacts; with `all` it tries everything that a stranger could."""

import json
import sys
import time

import wire
import zenoh


def contacts(session: zenoh.Session) -> None:
    def put(sample: zenoh.Sample) -> None:
        came = time.time()
        frame = wire.read(sample.payload.to_bytes().strip(b"\0"))
        if frame and frame.report == wire.CONTACTS and sample.timestamp:
            put = sample.timestamp.get_time().timestamp()
            print(json.dumps({"scan": frame.scan, "put": put, "came": came}), flush=True)

    session.declare_subscriber("taxel/*/*/wire/main", put)
    time.sleep(3600)


def everything(session: zenoh.Session) -> None:
    count = {"samples": 0, "signs of life": 0}

    def note(what: str) -> None:
        count[what] += 1

    session.declare_subscriber("taxel/**", lambda _: note("samples"))
    session.liveliness().declare_subscriber("taxel/**", lambda _: note("signs of life"), history=True)
    replies = 0
    for key in ("taxel/**", "taxel/*/*/state"):
        replies += sum(1 for reply in session.get(key, timeout=2.0) if reply.ok)
    tokens = sum(1 for reply in session.liveliness().get("taxel/**", timeout=2.0) if reply.ok)
    time.sleep(2.0)
    print(json.dumps({**count, "replies": replies, "tokens": tokens}), flush=True)
    # Frames of its own are not to reach anybody.
    for _ in range(100):
        session.put("taxel/arm/left/wire/main", b"\x01\x02\x00")
    time.sleep(1.0)


try:
    with zenoh.open(zenoh.Config.from_file(sys.argv[1])) as opened:
        print(json.dumps({"ready": True}), flush=True)
        (contacts if sys.argv[2] == "contacts" else everything)(opened)
except zenoh.ZError as why:
    print(json.dumps({"refused": str(why)}), flush=True)
