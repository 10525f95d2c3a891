"""A cable with jitter: passes packets between TUN devices of two machines. Each waits for a random time of up to so many
milliseconds, and none overtakes another of its way, as in a queue."""

import ctypes
import fcntl
import heapq
import os
import random
import select
import struct
import sys
import time

TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000
CLONE_NEWNET = 0x40000000


def device(machine: str) -> int:
    """Makes the device `relay` on a machine."""
    libc = ctypes.CDLL(None, use_errno=True)
    with open(f"/var/run/netns/{machine}") as there:
        if libc.setns(there.fileno(), CLONE_NEWNET):
            raise OSError(ctypes.get_errno(), f"cannot enter {machine}")
    end = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(end, TUNSETIFF, struct.pack("16sH", b"relay", IFF_TUN | IFF_NO_PI))
    return end


def main() -> None:
    jitter_s = float(sys.argv[1]) / 1000
    draw = random.Random(1)
    ends = [device(machine) for machine in sys.argv[2:4]]
    print("ready", flush=True)
    waiting: list[tuple[float, int, int, bytes]] = []
    last, number = [0.0, 0.0], 0
    while True:
        wait = max(0.0, waiting[0][0] - time.monotonic()) if waiting else 1.0
        ready, _, _ = select.select(ends, [], [], wait)
        now = time.monotonic()
        for end in ready:
            way = ends.index(end)
            due = last[way] = max(last[way], now + draw.uniform(0, jitter_s))
            number += 1
            try:
                heapq.heappush(waiting, (due, number, ends[1 - way], os.read(end, 65536)))
            except OSError:
                continue  # the device is not up yet
        while waiting and waiting[0][0] <= time.monotonic():
            _, _, end, packet = heapq.heappop(waiting)
            try:
                os.write(end, packet)
            except OSError:
                continue  # likewise


main()
