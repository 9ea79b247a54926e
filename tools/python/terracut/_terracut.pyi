# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
from collections.abc import Sequence
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

__version__: str

class Frame:
    """One labelled revolution of the sensor, one entry a return in order of arrival. Its arrays are views of one block
    of memory, which stays as long as the frame or one of them does."""

    @property
    def number(self) -> int: ...
    @property
    def first_packet_ns(self) -> int:
        """Nanoseconds since 1970 (UTC)."""
    @property
    def last_packet_ns(self) -> int: ...
    @property
    def first_return(self) -> int:
        """Of a sector: the place in its frame of its first return; else 0."""
    @property
    def complete(self) -> bool:
        """Every firing was seen; not known of a sector."""
    @property
    def deskewed(self) -> bool: ...
    @property
    def points(self) -> npt.NDArray[np.float32]:
        """(N, 3): x ahead, y left, z up, metres, from the ground below the sensor."""
    @property
    def intensity(self) -> npt.NDArray[np.uint8]: ...
    @property
    def labels(self) -> npt.NDArray[np.uint8]:
        """NONE, GROUND, OTHER_GROUND or OBSTACLE."""
    @property
    def ring(self) -> npt.NDArray[np.uint16]:
        """0 is the lowest laser."""
    @property
    def time(self) -> npt.NDArray[np.float32]:
        """Seconds after the frame's first packet, to half a column."""
    @property
    def height_above_ground_m(self) -> Optional[npt.NDArray[np.float32]]:
        """Metres above the ground found below each return; None without `heights`."""
    @property
    def objects(self) -> Optional[npt.NDArray[np.void]]:
        """Objects as records: returns first_return last_return bottom_m top_m ground_z_m; the box's x_m y_m along_x
        along_y length_m width_m; the footprint's corner_count and corners (16, 2). Of a sector those that are complete since it, with
        returns numbered as in their `frame`, and the last_packet_ns of their last return. None without `objects`."""
    @property
    def object_numbers(self) -> Optional[npt.NDArray[np.uint16]]:
        """The number of each return's object: i + 1 of objects[i], 0 is none. None of sectors and without `objects`."""
    @property
    def free_way(self) -> Optional[npt.NDArray[np.void]]:
        """The free way, a record a sector of about half a degree, clockwise from straight ahead: azimuth_rad of its
        middle (counterclockwise), obstacle_m, seen_m, seen_end (a place in SEEN_ENDS). None without `free_way`."""
    @property
    def data(self) -> npt.NDArray[np.void]:
        """All but heights as records: x y z intensity label ring time."""
    @property
    def report(self) -> Optional[dict[str, Any]]:
        """The frame's entry of `terracut replay --json`; None of a live frame."""
    def __len__(self) -> int: ...

class Replay:
    def __init__(self, words: Sequence[str]) -> None: ...
    def __iter__(self) -> Replay: ...
    def __next__(self) -> Frame: ...
    @property
    def sensor(self) -> str: ...
    @property
    def calibration(self) -> str: ...
    def report(self) -> dict[str, Any]:
        """What `terracut replay --json` writes, of the frames so far."""

class Live:
    def __init__(self, words: Sequence[str], sectors: bool) -> None: ...
    def __iter__(self) -> Live: ...
    def __next__(self) -> Frame: ...
    def __enter__(self) -> Live: ...
    def __exit__(self, *exception: object) -> None: ...
    def stop(self) -> None:
        """Ends the run; frames that wait can still be taken."""
    def figures(self) -> dict[str, int]:
        """datagrams, decoded, frames, frames_left_out, deadlines_missed; with sectors sectors, sectors_left_out."""
    @property
    def refusals(self) -> str:
        """What the system did not grant (priorities, locked memory), a line each."""

class Segmenter:
    def __init__(
        self,
        *,
        mount_height: Optional[float],
        mount_roll: float,
        mount_pitch: float,
        profile: str,
        parameters: list[str],
        find_mount: bool,
        heights: bool,
        objects: bool,
        free_way: bool,
    ) -> None: ...
    @property
    def objects(self) -> Optional[npt.NDArray[np.void]]: ...
    @property
    def object_numbers(self) -> Optional[npt.NDArray[np.uint16]]: ...
    @property
    def free_way(self) -> Optional[npt.NDArray[np.void]]: ...
    @property
    def found_mount(self) -> Optional[dict[str, Any]]: ...
    def label(
        self, points: object, laser: object
    ) -> tuple[npt.NDArray[np.uint8], Optional[npt.NDArray[np.float32]]]: ...

class GroundGrid:
    """The ground around the vehicle as square cells, from the labelled returns of one frame: those seen, and those
    interpolated below things and over gaps of at most `longest_gap_m`.

    Cell [row, column] begins at x = row * cell_m - reach_m (x ahead) and y = column * cell_m - reach_m (y left)."""

    UNKNOWN: int
    SEEN: int
    INTERPOLATED: int
    def __init__(self, *, cell_m: float = 0.5, reach_m: float = 40.0, longest_gap_m: float = 4.0) -> None: ...
    def update(self, points: npt.ArrayLike, labels: npt.ArrayLike, height_above_ground_m: npt.ArrayLike) -> None:
        """Replaces the cells by those of these returns, one entry each; those with a height of NaN are left out."""
    @property
    def height_m(self) -> npt.NDArray[np.float32]:
        """Of the ground, in the frame of the points; NaN where nothing near enough tells."""
    @property
    def slope_deg(self) -> npt.NDArray[np.float32]: ...
    @property
    def known(self) -> npt.NDArray[np.uint8]:
        """UNKNOWN, SEEN or INTERPOLATED."""

def parameters() -> list[dict[str, Any]]:
    """Every parameter of the method: key, unit, help, default, and its range or its choices."""
