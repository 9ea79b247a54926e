# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""How returns are spread over the cells of a grid."""

import math


class Spread:
    """Of sums over cells, as `terracut eval --report` counts them for every distance; several are taken together."""

    def __init__(self, *parts):
        def total(key):
            return sum(part[key] for part in parts)

        self.cells = total("cells")
        self.empty_percent = 100 * ratio(total("empty"), self.cells)
        self.mean = ratio(total("returns"), self.cells)
        variance = ratio(total("returns_squared"), self.cells) - self.mean**2
        # Standard deviation over mean: 0 is an even distribution.
        self.variation = ratio(math.sqrt(max(variance, 0)), self.mean)
        self.no_ground_percent = 100 * ratio(total("obstacles_on_no_ground"), total("obstacles"))


def ratio(part, whole):
    return part / whole if whole else 0
