"""Machines as network namespaces: `board` - `ra` - `rb` - `viewer`, and `other` at `rb`. Zenoh routers run in `ra` and
`rb`; the cable between them can be cut, lose packets, or be a relay that delays them."""

import subprocess
import sys
from pathlib import Path

MACHINES = ("board", "ra", "rb", "viewer", "other")
#: Cables: two machines, and their addresses.
CABLES = (
    ("board", "10.77.1.1", "ra", "10.77.1.2"),
    ("ra", "10.77.2.1", "rb", "10.77.2.2"),
    ("rb", "10.77.4.1", "viewer", "10.77.4.2"),
    ("rb", "10.77.5.1", "other", "10.77.5.2"),
)
#: Ends of the relay, which is a second way between the routers.
RELAY = (("ra", "10.77.3.1"), ("rb", "10.77.3.2"))
ROUTES = (
    ("board", "default", "10.77.1.2"),
    ("ra", "10.77.4.0/24", "10.77.2.2"),
    ("ra", "10.77.5.0/24", "10.77.2.2"),
    ("rb", "10.77.1.0/24", "10.77.2.1"),
    ("viewer", "default", "10.77.4.1"),
    ("other", "default", "10.77.5.1"),
)
PREFIX = "taxel-"


def run(*words: str, check: bool = True) -> None:
    """Runs a command."""
    subprocess.run(words, check=check, capture_output=True)


def on(machine: str, *words: str) -> list[str]:
    """The command that runs on a machine."""
    return ["ip", "netns", "exec", PREFIX + machine, *words]


def make() -> None:
    """Makes the machines, after what an earlier run has left."""
    remove()
    for machine in MACHINES:
        run("ip", "netns", "add", PREFIX + machine)
        run(*on(machine, "ip", "link", "set", "lo", "up"))
        run(*on(machine, "sysctl", "-qw", "net.ipv4.ip_forward=1"))
    for number, (one, one_address, two, two_address) in enumerate(CABLES):
        ends = ((one, f"tx{number}a", one_address), (two, f"tx{number}b", two_address))
        run("ip", "link", "add", ends[0][1], "type", "veth", "peer", "name", ends[1][1])
        for machine, name, address in ends:
            run("ip", "link", "set", name, "netns", PREFIX + machine)
            run(*on(machine, "ip", "address", "add", f"{address}/24", "dev", name))
            run(*on(machine, "ip", "link", "set", name, "up"))
    for machine, where, by in ROUTES:
        run(*on(machine, "ip", "route", "add", where, "via", by))


def remove() -> None:
    """Removes the machines."""
    for machine in MACHINES:
        run("ip", "netns", "del", PREFIX + machine, check=False)


def cut() -> None:
    """Cuts the cable between the routers."""
    run(*on("ra", "ip", "link", "set", "tx1a", "down"))


def mend() -> None:
    """Mends it; the routes that went with it come back."""
    run(*on("ra", "ip", "link", "set", "tx1a", "up"))
    for machine, where, by in ROUTES:
        if machine == "ra":
            run(*on(machine, "ip", "route", "replace", where, "via", by))


def lose(percent: int) -> None:
    """Drops this share of the packets that arrive at either end of the cable between the routers; 0 ends it."""
    for machine, name in (("ra", "tx1a"), ("rb", "tx1b")):
        run(*on(machine, "nft", "flush", "ruleset"))
        if percent:
            run(*on(machine, "nft", "add", "table", "inet", "loss"))
            run(*on(machine, "nft", "add", "chain", "inet", "loss", "in", "{ type filter hook input priority 0; }"))
            rule = ["iifname", name, "numgen", "random", "mod", "100", "<", str(percent), "drop"]
            run(*on(machine, "nft", "add", "rule", "inet", "loss", "in", *rule))


def relay(jitter_ms: float) -> "subprocess.Popen[bytes]":
    """Starts the relay between the routers."""
    here = Path(__file__).parent / "relay.py"
    process = subprocess.Popen(
        [sys.executable, str(here), str(jitter_ms), *(PREFIX + machine for machine, _ in RELAY)],
        stdout=subprocess.PIPE,
    )
    assert process.stdout and process.stdout.readline().strip() == b"ready"
    for machine, address in RELAY:
        run(*on(machine, "ip", "address", "add", f"{address}/24", "dev", "relay"))
        run(*on(machine, "ip", "link", "set", "relay", "up"))
    return process
