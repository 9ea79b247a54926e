#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Reads labelled frames from a running `terracut live --stream ADDRESS` (docs/reference/labelled_stream.md).

Prints a line a frame; with --pcd also writes each as a binary PCD file. With --sectors, of a run with --stream-sectors, frames come in
parts of some four degrees, each as soon as it is labelled. Needs nothing but Python 3.8: copy decode_header() and receive_frames() into a program of your own. With numpy, the points are
numpy.frombuffer(points, POINT_DTYPE); of a run with --heights, POINT_DTYPE + HEIGHT_DTYPE; with --objects that + OBJECT_DTYPE.
"""
import argparse
import os
import socket
import struct
import sys

HEADER = struct.Struct("<4sHHIIqqqHBBIII")
POINT = struct.Struct("<fffBBHf")
POINT_DTYPE = [("x", "<f4"), ("y", "<f4"), ("z", "<f4"),
               ("intensity", "u1"), ("label", "u1"), ("row", "<u2"), ("time", "<f4")]
HEIGHT = struct.Struct("<f")
HEIGHT_DTYPE = [("height_above_ground", "<f4")]
OBJECT = struct.Struct("<I")
OBJECT_DTYPE = [("object", "<u4")]
HEADER_FIELDS = ("magic", "version", "header_bytes", "number", "points", "first_packet_ns",
                 "last_packet_ns", "labels_ns", "point_bytes", "sensor", "level", "flags",
                 "missed", "first_return")
MOST_POINTS = 4194304
SENSORS = {1: "hdl64e", 2: "ruby128", 3: "vlp16", 4: "hdl32e", 5: "vlp32c", 6: "vls128",
           7: "pandar40p", 8: "pandar64", 9: "pandarqt64", 10: "pandarqt128", 11: "pandarxt16",
           12: "pandarxt32", 13: "pandarxt32m",
           14: "ouster32", 15: "ouster64", 16: "ouster128", 17: "ot128", 18: "pandar128",
           19: "rs32", 20: "helios"}
RUNGS = {0: "full", 1: "cut_stopped", 2: "coarse", 3: "skipped"}
COMPLETE, LATE, NO_EGO_MOTION, SECTOR = 1, 2, 8, 16
GROUND, OTHER_GROUND, OBSTACLE = 40, 49, 99


class StreamError(Exception):
    """Raised if the data are not a stream of labelled frames, or end in the middle of one."""


def connect(address, sectors=False):
    """Returns a connected socket. `address` is ADDRESS:PORT, a port on this machine, or the path of
    a Unix socket."""
    if "/" in address:
        connection = socket.socket(socket.AF_UNIX)
        connection.connect(address)
    else:
        host, _, port = address.rpartition(":")
        connection = socket.create_connection((host or "127.0.0.1", int(port)))
    if sectors:
        connection.sendall(b"TCLS")
    return connection


def receive(connection, count):
    """Returns `count` bytes, or fewer if the stream ends."""
    buffer = bytearray(count)
    view, got = memoryview(buffer), 0
    while got < count:
        step = connection.recv_into(view[got:])
        if step == 0:
            break
        got += step
    return bytes(view[:got])


def receive_all(connection, count):
    data = receive(connection, count)
    if len(data) < count:
        raise StreamError("the stream ended within a frame")
    return data


def decode_header(data):
    """Returns the header as a dictionary; `data` is at least as long as the header says."""
    header = dict(zip(HEADER_FIELDS, HEADER.unpack_from(data)))
    if header["point_bytes"] < POINT.size or header["points"] > MOST_POINTS:
        raise StreamError("a header that cannot be: %s" % header)
    return header


def point_size(header):
    """Returns how many bytes a point of receive_frames() has: a height, and then the number of its object, follow it
    where the sender has them."""
    with_height = POINT.size + HEIGHT.size
    for size in (with_height + OBJECT.size, with_height):
        if header["point_bytes"] >= size:
            return size
    return POINT.size


def receive_frames(connection):
    """Yields (header, points): points as bytes, point_size(header) a point, until the sender ends."""
    while True:
        preamble = receive(connection, 8)
        if not preamble:
            return
        if len(preamble) < 8 or preamble[:4] != b"TCLT":
            raise StreamError("no stream of labelled frames")
        version, header_bytes = struct.unpack_from("<HH", preamble, 4)
        if version != 1:
            raise StreamError("labelled frames of version %d; this reader knows version 1" % version)
        if header_bytes < HEADER.size:
            raise StreamError("a header of %d bytes; expected at least %d"
                              % (header_bytes, HEADER.size))
        header = decode_header(preamble + receive_all(connection, header_bytes - 8))
        stride = header["point_bytes"]
        points = receive_all(connection, header["points"] * stride)
        size = point_size(header)
        if stride > size:  # fields that a newer sender has added are skipped
            points = b"".join(points[n:n + size] for n in range(0, len(points), stride))
        yield header, points


def describe(header, points):
    """Returns a frame, or a sector, as one line for people."""
    is_sector = header["flags"] & SECTOR
    labels = points[13::point_size(header)]
    obstacles = labels.count(OBSTACLE)
    ground = labels.count(GROUND) + labels.count(OTHER_GROUND)
    which = "frame %d" % header["number"]
    if is_sector:
        which += " from return %d" % header["first_return"]
    which += "  " + SENSORS.get(header["sensor"], "unknown")
    if not is_sector:  # a level is of a whole frame
        which += "  " + RUNGS.get(header["level"], "unknown")
    line = "%s  %d points  %d ground  %d obstacle" % (which, header["points"], ground, obstacles)
    if header["labels_ns"]:
        line += "  labelled after %.1f ms" % (
            (header["labels_ns"] - header["last_packet_ns"]) / 1e6)
    if not is_sector and not header["flags"] & COMPLETE:
        line += "  incomplete"
    if header["flags"] & LATE:
        line += "  late"
    if header["flags"] & NO_EGO_MOTION:
        line += "  no ego motion"
    if header["missed"]:
        line += "  %d missed" % header["missed"]
    return line


def write_pcd(path, points, size=POINT.size):
    """Writes binary PCD v0.7 with the fields x y z intensity label ring time, height_above_ground and object where
    points of `size` bytes have them; whole or not at all."""
    count = len(points) // size
    more = ("",) * 4
    if size > POINT.size:
        more = (" height_above_ground", " 4", " F", " 1")
    if size > POINT.size + HEIGHT.size:
        more = tuple(map("".join, zip(more, (" object", " 4", " U", " 1"))))
    header = ("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
              "FIELDS x y z intensity label ring time%s\nSIZE 4 4 4 1 1 2 4%s\nTYPE F F F U U U F%s\n"
              "COUNT 1 1 1 1 1 1 1%s\nWIDTH %d\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
              "POINTS %d\nDATA binary\n" % (*more, count, count))
    with open(path + ".part", "wb") as file:
        file.write(header.encode("ascii"))
        file.write(points)
    os.replace(path + ".part", path)


def main():
    parser = argparse.ArgumentParser(description="Labelled frames of a running terracut live.")
    parser.add_argument("address", help="as given to `terracut live --stream`: ADDRESS:PORT, a "
                        "port of this machine, or the path of a Unix socket")
    parser.add_argument("--count", type=int, default=0, help="stop after so many frames, or sectors")
    parser.add_argument("--sectors", action="store_true", help="ask for sectors as they come")
    parser.add_argument("--pcd", metavar="FOLDER", help="write each frame there as NUMBER.pcd")
    arguments = parser.parse_args()
    try:
        if arguments.pcd:
            os.makedirs(arguments.pcd, exist_ok=True)
        with connect(arguments.address, arguments.sectors) as connection:
            for frames, (header, points) in enumerate(receive_frames(connection), 1):
                print(describe(header, points), flush=True)
                if arguments.pcd:
                    name = "%06d" % header["number"]
                    if header["flags"] & SECTOR:
                        name += "-%06d" % header["first_return"]
                    write_pcd(os.path.join(arguments.pcd, name + ".pcd"), points, point_size(header))
                if frames == arguments.count:
                    break
    except (OSError, ValueError, StreamError) as error:
        print("read_frames: %s: %s" % (arguments.address, error), file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        pass
    return 0


if __name__ == "__main__":
    sys.exit(main())
