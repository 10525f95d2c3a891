"""A Zenoh router, by Zenoh's own Python package: runs until it is killed."""

import sys
import time

import zenoh

with zenoh.open(zenoh.Config.from_file(sys.argv[1])):
    print("ready", flush=True)
    while True:
        time.sleep(3600)
