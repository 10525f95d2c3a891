#!/usr/bin/env python3
"""Draws a garment in the terminal: taxel live --json --pixels | python3 draw.py; over TCP: draw.py HOST PORT"""
import json
import socket
import sys

SHADES = " .:-=+*#%@"


def lines():
    if len(sys.argv) == 3:
        return socket.create_connection((sys.argv[1], int(sys.argv[2]))).makefile()
    return sys.stdin


def draw(frame):
    for panel in frame.get("panels", []):
        print(f'{panel["name"]}, {frame["time_us"] / 1e6:.3f} s')
        for row in panel["rows"]:
            print("".join(SHADES[min(value // 100, 9)] for value in row))
    for contact in frame["contacts"]:
        print(f'contact {contact["id"]} at {contact["column"]:.1f}, {contact["row"]:.1f}')


for line in lines():
    message = json.loads(line)
    if message["type"] == "frame":
        print("\x1b[H\x1b[2J" if sys.stdout.isatty() else "", end="")
        draw(message)
