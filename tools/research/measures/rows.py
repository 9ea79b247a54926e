# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""What is measured: the method, its stages, the paper's, and the method with one thing taken back."""

import re
from dataclasses import dataclass

METHOD = "terracut"
STAGES = {"terracut_ring_map": "elevation map alone", "terracut_ring_map_adjacent": "... and adjacent points",
          "paper": "`--profile paper`"}  # fmt: skip
# Of other methods, off unless asked for, or bounds of time and memory.
NOT_MEASURED = ("road.", "pfaff.", "bogoslavskyi.", "zhang.", "min_cut.")
NO_LIMIT = "1e9"
COUNTED = ("columns", "rows", "sectors", "steps")  # whole numbers

# The value that switches a parameter's rule off, and what is left without it. Of others the paper's value is taken, or,
# where it has none or the same, the half and the double.
OFF = {
    "elevation_map.lone_depth_m": ("1000", "lone returns followed"),
    "elevation_map.window_m": ("0.1", "nothing stands out of a row"),
    "surface.step_up_m": ("0", "no rise at no distance"),
    "surface.step_up_limit_m": ("5", "steps of any height"),
    "surface.far_slope": ("0", "no more rise between distant rings"),
    "surface.extra_fall": ("0", "no further fall"),
    "surface.start_slope": ("2", "ground may begin anywhere"),
    "surface.tall_m": ("10", "steps up to the foot of something tall"),
    "surface.regain_length_m": ("1000", "no ground found again"),
    "surface.interpolate_sectors": ("0", "nothing interpolated"),
    "adjacent.min_rise_m": ("0", "any rise is a step"),
    "adjacent.min_upper_height_m": ("-1", "upper ends of any height marked"),
    "adjacent.min_lower_height_m": (NO_LIMIT, "lower ends not marked"),
    "boundary.scale_per_metre": ("0", "nearness alike at any range"),
    "returns.same_surface_range_m": ("0", "second returns by themselves"),
    "returns.same_surface_height_m": ("0", "second returns by themselves"),
}
TOGETHER = {"grid.min_band_m=0,grid.max_band_m=1e9": "bands as the rings lie"}


@dataclass(frozen=True)
class Parameter:
    """A row of `terracut parameters`; `paper` is empty where that profile does not read it."""

    key: str
    unit: str
    least: float | None
    most: float | None
    value: str
    paper: str


@dataclass(frozen=True)
class Row:
    """`name`: a method's, or settings like KEY=VALUE,KEY=VALUE of the method."""

    name: str
    what: str

    @property
    def keys(self):
        return re.findall(r"([\w.]+)=", self.name)


def bound(text):
    try:
        return float(text)
    except ValueError:
        return None


def parameters_of(printed):
    """The method's own parameters, of what `terracut parameters` prints."""
    parameters = []
    for line in printed.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) < 6 or not cells[0].startswith("`"):
            continue
        key, unit, values, value, paper = cells[0].strip("`"), *cells[1:5]
        if value and not key.startswith(NOT_MEASURED):
            least, _, most = values.partition(" .. ")
            parameters.append(Parameter(key, unit, bound(least), bound(most), value, paper))
    return parameters


def scaled(parameter, factor):
    value = float(parameter.value) * factor
    if parameter.unit in COUNTED:
        value = int(value)
    if parameter.least is not None:
        value = max(value, parameter.least)
    if parameter.most is not None:
        value = min(value, parameter.most)
    return f"{value:g}"


def taken_back(parameter):
    """The rows in which this parameter is not what it is."""
    if parameter.key in OFF:
        value, what = OFF[parameter.key]
        return [Row(f"{parameter.key}={value}", what)]
    if parameter.paper not in ("", parameter.value):
        value = NO_LIMIT if parameter.paper == "no limit" else parameter.paper
        return [Row(f"{parameter.key}={value}", "the paper's")]
    if bound(parameter.value) is None:
        return []  # the paper's word for it, which no value can take back
    rows = [Row(f"{parameter.key}={scaled(parameter, factor)}", what) for factor, what in ((0.5, "half"), (2, "double"))]
    return [row for row in rows if float(row.name.partition("=")[2]) != float(parameter.value)]


def rows_of(parameters):
    rows = [Row(METHOD, f"**`{METHOD}`**"), *(Row(name, what) for name, what in STAGES.items())]
    rows += [row for parameter in parameters for row in taken_back(parameter)]
    keys = {parameter.key for parameter in parameters}
    return rows + [row for row in (Row(*both) for both in TOGETHER.items()) if keys.issuperset(row.keys)]


def chosen(rows, names):
    """The method's row and those of the names: a row's, a parameter's, or settings that no row has."""
    kept = rows[:1]
    for name in names:
        found = [row for row in rows if name == row.name or name in row.keys]
        if not found and "=" not in name:
            raise ValueError(f"there is no row '{name}'")
        kept += found or [Row(name, "")]
    return kept
