# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""A run of the program that shows its page."""

import json
import re
import subprocess
import threading
import time
import urllib.request


class Served:
    """`program` with these words, which shows its page at `url`."""

    def __init__(self, program, *words):
        self.process = subprocess.Popen([program, *map(str, words)], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        for line in self.process.stderr:
            if found := re.search(r"browser: (http://\S+)", line):
                self.url = found[1]
                break
        else:
            raise RuntimeError("the program did not say where its page is")
        self.reading = threading.Thread(target=self.process.stderr.read, daemon=True)
        self.reading.start()

    def figures(self):
        with urllib.request.urlopen(self.url + "figures", timeout=20) as answer:
            return json.load(answer)

    def wait_until(self, holds):
        """The figures that hold; an error after two minutes."""
        given_up = time.monotonic() + 120
        while not holds(figures := self.figures()):
            if time.monotonic() > given_up:
                raise TimeoutError(f"waited in vain; at last: {figures['capture']}, {figures['browsers']}")
            time.sleep(0.1)
        return figures

    def tell(self, **command):
        request = urllib.request.Request(self.url + "control", json.dumps(command).encode(), {"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=20) as answer:
            return json.load(answer)["capture"]

    def stand_at(self, seconds):
        # By way of the beginning: a capture that plays comes to the place by itself, before it is sought.
        self.tell(playing=False, seek_s=0)
        self.wait_until(lambda figures: figures["capture"]["position_s"] < 0.06)
        self.tell(seek_s=seconds)
        self.wait_until(lambda figures: abs(figures["capture"]["position_s"] - seconds) < 0.06)

    def end(self):
        self.process.terminate()
        code = self.process.wait(60)
        self.reading.join()
        self.process.stderr.close()
        return code
