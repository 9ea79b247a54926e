# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Readers of a live run's outputs, one for each output; each can be stalled."""

from __future__ import annotations

import base64
import contextlib
import json
import os
import signal
import socket
import struct
import subprocess
import threading

from .live import Live

DDS_DOMAIN = 77  # unused by others
SUBPROTOCOL = "foxglove.websocket.v1"


class SocketReader:
    """Reads and counts all bytes of a socket."""

    def __init__(self, connection: socket.socket):
        self.bytes = 0
        self.connection = connection
        self.goes_on = threading.Event()
        self.goes_on.set()
        self.thread = threading.Thread(target=self._read, daemon=True)
        self.thread.start()

    def _read(self) -> None:
        with contextlib.suppress(OSError):
            while self.goes_on.wait() and (taken := len(self.connection.recv(1 << 20))):
                self.bytes += taken

    def stall(self) -> None:
        self.goes_on.clear()

    def go_on(self) -> None:
        self.goes_on.set()

    def leave(self) -> None:
        self.go_on()
        with contextlib.suppress(OSError):
            self.connection.shutdown(socket.SHUT_RDWR)
        self.thread.join()
        self.connection.close()


class NodeReader:
    """Runs a `terracut node` that receives the published clouds, as another process that knows only
    DDS."""

    bytes = 0  # the bytes that a process reads from DDS are not visible from outside
    clouds = 0  # labelled ones; known once it has ended

    def __init__(self, live: Live):
        self.program, self.name = live.program, live.name + "-reader"
        self.process = subprocess.Popen(
            [str(live.program.path), "node", "--in", "/terracut/points", "--dds-node", "reader", "--dds-domain", str(DDS_DOMAIN),
             "--dds-interface", "lo", "--mount-height", "1.73", "--name", self.name, "--metrics", "off"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip

    def stall(self) -> None:
        self.process.send_signal(signal.SIGSTOP)

    def go_on(self) -> None:
        self.process.send_signal(signal.SIGCONT)

    def leave(self) -> None:
        self.go_on()
        seen = self.program.run("top", self.name, "--once", "--print-json")
        self.clouds = json.loads(seen.stdout)["frames"]["count"] if seen.returncode == 0 else 0
        self.process.terminate()
        self.process.wait()


def connected(port: int) -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), timeout=10)


def read_stream(live: Live) -> SocketReader:
    connection = connected(live.port_after("labelled points at "))
    connection.settimeout(None)
    return SocketReader(connection)


def read_page(live: Live) -> SocketReader:
    port = live.port_after("in a browser: http://")
    connection = connected(port)
    connection.sendall(f"GET /frames HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
    connection.settimeout(None)
    return SocketReader(connection)


def read_foxglove(live: Live) -> SocketReader:
    """Subscribes to every topic."""
    port = live.port_after("connect to ws://")
    connection = connected(port)
    key = base64.b64encode(os.urandom(16)).decode()
    connection.sendall(f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n"
                       f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: {SUBPROTOCOL}\r\n\r\n".encode())  # fmt: skip
    file = connection.makefile("rb")
    while file.readline() not in (b"\r\n", b""):
        pass
    while (message := json.loads(text_message(file)))["op"] != "advertise":
        pass
    wanted = [{"id": number, "channelId": channel["id"]} for number, channel in enumerate(message["channels"])]
    connection.sendall(masked(json.dumps({"op": "subscribe", "subscriptions": wanted}).encode()))
    connection.settimeout(None)
    return SocketReader(connection)


def text_message(file) -> bytes:
    """Returns the next message of a WebSocket server, assembled from its frames (RFC 6455, 5.2)."""
    text, is_last = b"", 0
    while not is_last:
        first, length = file.read(2)
        is_last = first & 0x80
        if length == 126:
            (length,) = struct.unpack(">H", file.read(2))
        elif length == 127:
            (length,) = struct.unpack(">Q", file.read(8))
        text += file.read(length)
    return text


def masked(text: bytes) -> bytes:
    """Returns a text as a WebSocket's client sends it; the mask of zeros leaves it unchanged."""
    return b"\x81" + struct.pack(">BH", 0x80 | 126, len(text)) + bytes(4) + text
