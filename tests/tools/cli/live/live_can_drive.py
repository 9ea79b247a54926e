#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Makes what live_can_in_vm.sh needs: a drive of a unit that looks ahead only, and the vehicle's bus.

usage: live_can_drive.py TERRACUT FOLDER

A whole frame is several times too much for an emulated machine. A tenth of each, at the sensor's own
pace, is not: the device's clock and the host's stay together, without which no motion is removed.
"""
import os
import struct
import subprocess
import sys

FILE_HEADER, RECORD_HEADER, ETHERNET_IP_UDP = 24, 16, 42
AZIMUTH = RECORD_HEADER + ETHERNET_IP_UDP + 2  # of a packet's first firing, 0.01 degrees
VIEW_CDEG = 3600


def ahead(capture):
    """The packets of a pcap file that begin in the view."""
    kept, at = [capture[:FILE_HEADER]], FILE_HEADER
    while at < len(capture):
        end = at + RECORD_HEADER + struct.unpack_from("<I", capture, at + 8)[0]
        if struct.unpack_from("<H", capture, at + AZIMUTH)[0] < VIEW_CDEG:
            kept.append(capture[at:end])
        at = end
    return b"".join(kept)


def main():
    terracut, folder = sys.argv[1:]
    drive = os.path.join(folder, "drive.pcap")
    subprocess.run([terracut, "simulate", "--scene", "flat", "--duration", "6", "--speed", "20", "--yaw-rate", "28",
                    "--can-log", "-o", drive], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(drive, "rb") as whole:
        capture = whole.read()
    with open(drive, "wb") as narrow:
        narrow.write(ahead(capture))


main()
