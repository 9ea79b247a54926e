# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Ground or obstacle for every LiDAR return, in numpy arrays (docs/guide/python.md).

    import terracut
    for frame in terracut.replay("drive.pcap"):
        obstacles = frame.points[frame.labels == terracut.OBSTACLE]
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Optional, Union

from ._terracut import Frame, GroundGrid, Live, Replay, __version__, parameters
from ._terracut import Segmenter as _Segmenter
from .errors import Error, InvalidArgument, NotFound, TerracutWarning

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Path = Union[str, os.PathLike[str]]

__all__ = [
    "GROUND", "NONE", "OBSTACLE", "OTHER_GROUND", "SEEN_ENDS", "Error", "Frame", "GroundGrid", "InvalidArgument", "Live",
    "NotFound", "Replay", "Segmenter", "TerracutWarning", "__version__", "live", "parameters", "replay",
]  # fmt: skip

# Labels: classes of SemanticKITTI, as in .label files.
NONE, GROUND, OTHER_GROUND, OBSTACLE = 0, 40, 49, 99
# Why ground is seen no farther in a sector of the free way, by its `seen_end` (docs/guide/free_way.md).
SEEN_ENDS = ("rows", "lost", "obstacle", "drop")


def _settings(of_method: Optional[Mapping[str, Any]]) -> list[str]:
    return [f"{key}={value}" for key, value in (of_method or {}).items()]


def _words(command: str, arguments: list[Path], options: dict[str, Any]) -> list[str]:
    """Returns the words of a command line; options that are None or False are left out."""
    words = [command]
    for argument in arguments:
        path = os.fspath(argument)
        words.append(os.path.join(os.curdir, path) if path.startswith("-") else path)
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
        elif isinstance(value, list):
            words += [word for entry in value for word in (option, entry)]
        else:
            words += [option, os.fspath(value) if isinstance(value, os.PathLike) else str(value)]
    return words


def replay(
    capture: Path,
    calibration: Optional[Path] = None,
    *,
    sensor: Optional[str] = None,
    nominal_calibration: bool = False,
    columns: Optional[int] = None,
    cell_owner: Optional[str] = None,
    timestamp: Optional[str] = None,
    geometry: Optional[str] = None,
    topic: Optional[str] = None,
    port: Optional[int] = None,
    sender: Optional[str] = None,
    start: Optional[float] = None,
    duration: Optional[float] = None,
    reorder_packets: Optional[int] = None,
    setup: Optional[Path] = None,
    mount_height: Optional[float] = None,
    mount_roll: Optional[float] = None,
    mount_pitch: Optional[float] = None,
    profile: Optional[str] = None,
    stages: Optional[str] = None,
    method: Optional[str] = None,
    parameters: Optional[Mapping[str, Any]] = None,
    can: Optional[Path] = None,
    dbc: Optional[Path] = None,
    deskew_to: Optional[str] = None,
    heights: bool = False,
    objects: bool = False,
    free_way: bool = False,
    config: Optional[Path] = None,
) -> Replay:
    """Returns the labelled frames of a capture or of a bag's packets, as `terracut replay` labels them.

    Every setting is the program's option of that name (`terracut replay --help`): angles are degrees, a mount that is
    not stated is estimated from the first frames. `sender` is --from, `parameters` are those of --set. With `heights`
    frames have `height_above_ground_m`, with `objects` that, `objects` and `object_numbers`, with `free_way` that and
    `free_way`.
    """
    return Replay(_words("replay", [capture], {
        "calibration": calibration, "sensor": sensor, "nominal_calibration": nominal_calibration, "columns": columns,
        "cell_owner": cell_owner, "timestamp": timestamp, "geometry": geometry, "topic": topic, "port": port, "from": sender,
        "start": start, "duration": duration, "reorder_packets": reorder_packets, "setup": setup,
        "mount_height": mount_height, "mount_roll": mount_roll, "mount_pitch": mount_pitch, "profile": profile,
        "stages": stages, "method": method, "set": _settings(parameters), "can": can, "dbc": dbc,
        "deskew_to": deskew_to, "heights": heights, "objects": objects, "free_way": free_way, "config": config,
    }))  # fmt: skip


def live(
    listen: str = "2368",
    calibration: Optional[Path] = None,
    *,
    deadline: Optional[float] = None,
    duration: Optional[float] = None,
    patience: Optional[float] = None,
    gather: Optional[float] = None,
    mount_height: Optional[float] = None,
    mount_roll: Optional[float] = None,
    mount_pitch: Optional[float] = None,
    priority: Optional[int] = None,
    lock_memory: bool = True,
    sectors: bool = False,
    heights: bool = False,
    objects: bool = False,
    free_way: bool = False,
) -> Live:
    """Returns the labelled frames of a sensor that sends to `listen` (ADDRESS:PORT, or a port of any address).

    Returns when the sensor is heard. Labels are made before the deadline (milliseconds) by threads that Python does not
    delay; if the loop is too slow, the oldest of four waiting frames is dropped and counted in `figures()`.
    `with terracut.live() as frames:` ends the run with the block.

    With `sectors`, they come in pieces of some four degrees, each as soon as its labels are known, some milliseconds
    after it was measured; `first_return` is a piece's place in its frame. 256 of them wait for the loop.
    With `heights`, they have `height_above_ground_m`; with `objects`, whole frames have `objects` and `object_numbers`,
    sectors the `objects` that are complete since the one before; with `free_way` whole frames have that.
    """
    return Live(_words("live", [], {
        "listen": listen, "calibration": calibration, "deadline": deadline, "duration": duration, "patience": patience,
        "gather": gather, "mount_height": mount_height, "mount_roll": mount_roll, "mount_pitch": mount_pitch,
        "priority": priority,
        "heights": heights, "objects": objects, "free_way": free_way, "no_lock_memory": not lock_memory,
    }), sectors)  # fmt: skip


class Segmenter:
    """Labels clouds of one sensor, any LiDAR, with 8 to 256 lasers or without rows.

    The first cloud decides how points are assigned to lasers: by `laser`, a field `ring` of records, the rows of an
    organised cloud, the order of KITTI's files, or elevations (docs/guide/clouds.md). `parameters` are those of --set.
    `find_mount` estimates the mount from the near ground of the first ten clouds; until then the stated one is used.
    With `heights`, `height_above_ground_m` has the heights of the points labelled last; with `objects` there are
    `objects` and `object_numbers`, too, with `free_way` the `free_way` of clouds as measured.
    """

    def __init__(
        self,
        *,
        mount_height: Optional[float] = None,
        mount_roll: float = 0.0,
        mount_pitch: float = 0.0,
        profile: str = "terracut",
        parameters: Optional[Mapping[str, Any]] = None,
        find_mount: bool = False,
        heights: bool = False,
        objects: bool = False,
        free_way: bool = False,
    ) -> None:
        self._segmenter = _Segmenter(
            mount_height=mount_height,
            mount_roll=mount_roll,
            mount_pitch=mount_pitch,
            profile=profile,
            parameters=_settings(parameters),
            find_mount=find_mount,
            heights=heights,
            objects=objects,
            free_way=free_way,
        )
        self._height_above_ground_m: Optional[npt.NDArray[np.float32]] = None

    def __call__(self, points: npt.ArrayLike, laser: Optional[npt.ArrayLike] = None) -> npt.NDArray[np.uint8]:
        """Returns a label for each of the (N, 3 or more) or (rows, columns, 3 or more) points, float32 or float64, in
        the sensor's frame: x ahead, y left, z up, metres. Points without a return (NaN, infinite, 0 0 0) get NONE."""
        labels, self._height_above_ground_m = self._segmenter.label(points, laser)
        return labels

    @property
    def height_above_ground_m(self) -> Optional[npt.NDArray[np.float32]]:
        """Returns the height of each point labelled last above the ground found below it, metres, NaN of points
        without a return. None without `heights`, or before the first labels."""
        return self._height_above_ground_m

    @property
    def objects(self) -> Optional[npt.NDArray[np.void]]:
        """Returns the objects of the points labelled last, records as of `Frame.objects`, in the vehicle's frame. None
        without `objects`."""
        return self._segmenter.objects

    @property
    def object_numbers(self) -> Optional[npt.NDArray[np.uint16]]:
        """Returns the number of the object of each point labelled last, in the points' order; object i has the number
        i + 1, 0 is none. None without `objects`."""
        return self._segmenter.object_numbers

    @property
    def free_way(self) -> Optional[npt.NDArray[np.void]]:
        """Returns the free way of the points labelled last, records as of `Frame.free_way`. None without `free_way`."""
        return self._segmenter.free_way

    @property
    def found_mount(self) -> Optional[dict[str, Any]]:
        """Returns the mount found for the last labels: height_m, roll_deg, pitch_deg, the same below `uncertainty`
        (half of the 95 % interval), found_in_frames. None if not looked for, or not found."""
        return self._segmenter.found_mount


def __dir__() -> list[str]:
    return __all__
