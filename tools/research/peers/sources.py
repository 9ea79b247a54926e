# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The sources of the peers and how they are built: outside this repository, each at one commit."""

import os
import shlex
import subprocess
from dataclasses import dataclass
from pathlib import Path

ADAPTERS = Path(__file__).resolve().parent
# -march=native -O3 gave the best times of the flags tried for peers; terracut is built as users
# build it.
FLAGS = "-std=c++17 -O3 -march=native -DNDEBUG -w -isystem /usr/include/eigen3 -isystem /usr/include/opencv4"
# Headers of PCL, ROS and all of OpenCV that peers include, by the file that replaces them.
STAND_INS = {
    "pcl_stub.hpp": [
        "pcl/point_cloud.h", "pcl/point_types.h", "pcl/common/centroid.h", "pcl/filters/filter.h",
        "pcl/filters/voxel_grid.h", "pcl/visualization/pcl_visualizer.h",
    ],
    "ros_stub.hpp": [
        "ros/ros.h", "tf/tf.h", "tf/transform_broadcaster.h", "tf/transform_listener.h", "nav_msgs/Odometry.h",
        "nav_msgs/Path.h", "sensor_msgs/PointCloud2.h", "geometry_msgs/TransformStamped.h", "grid_map_msgs/GridMap.h",
        "grid_map_cv/GridMapCvConverter.hpp", "jsk_recognition_msgs/PolygonArray.h", "pcl_ros/point_cloud.h",
        "pcl_conversions/pcl_conversions.h", "tf2_geometry_msgs/tf2_geometry_msgs.h", "visualization_msgs/Marker.h",
        "visualization_msgs/MarkerArray.h",
    ],
    "opencv_stub.hpp": [
        "opencv/cv.h", "opencv/highgui.h", "opencv2/opencv.hpp", "opencv2/highgui.hpp", "opencv2/highgui/highgui.hpp",
    ],
    "groundgrid_config.hpp": ["groundgrid/GroundGridConfig.h"],
    "grid_map_core/grid_map_core.hpp": ["grid_map_ros/grid_map_ros.hpp"],
}  # fmt: skip


class Unavailable(Exception):
    """Raised if a peer cannot be measured here."""


@dataclass(frozen=True)
class Source:
    repository: str  # on GitHub
    commit: str
    folder: str  # the only folder used

    @property
    def place(self):
        return self.repository.split("/")[1]


@dataclass(frozen=True)
class PeerSource:
    name: str
    licence: str
    sources: tuple
    adapter: str
    code: str = ""  # patterns of source files; paths are relative to the folder of all sources, also below
    include: str = ""
    flags: str = ""
    needs: str = ""  # a header, and the packages that provide it
    note: str = ""


FUGSEG = Source("Leo-YuLi/FugSeg", "623f860cce70ffe0e3f673cd246254938ce8babe", "src/fugseg")
PATCHWORKPP = Source("url-kaist/patchwork-plusplus", "b608129a4549523067eae461da656195026cd7ca", "cpp/patchworkpp")
DIPG_SEG = Source("EEPT-LAB/DipG-Seg", "182e34843082295c79b59d7643a1f13c0f910919", "src")
GROUNDGRID = Source("dcmlr/groundgrid", "7d6a5d7dff12b048424014a2377aa1b6ed203b52", ".")
GRID_MAP = Source("ANYbotics/grid_map", "73a5b61fc80c09be8a5744997b3ee3e6902a98fb", "grid_map_core")
LINEFIT = Source("lorenwel/linefit_ground_segmentation", "e6b9418cc5756e30e4ea87b11d8792f936a2002a",
                 "linefit_ground_segmentation")  # fmt: skip
DEPTH_CLUSTERING = Source("PRBonn/depth_clustering", "2a824e728725be635eec4cc5214350faea364712", "src")
LIDAR_PROCESSING = Source("YevgeniyEngineer/LiDAR-Processing-V2", "506aefb70150771b37331d940d97cc1c5bbd363d",
                          "lidar_processing_lib")  # fmt: skip
TRAVEL = Source("url-kaist/TRAVEL", "17a0bddd5a9f0d2fd7fe5f17c53a0a105835cf21", "include")

SUFFIXES = {".h", ".hpp", ".c", ".cc", ".cpp"}
OPENCV = "/usr/include/opencv4/opencv2/imgproc.hpp"
PEERS = (
    PeerSource("FugSeg", "MIT", (FUGSEG,), "fugseg_adapter.cpp",
               code="FugSeg/src/fugseg/src/fugseg.cpp FugSeg/src/fugseg/src/cloud.cpp",
               include="FugSeg/src/fugseg/include", flags="-ffast-math"),
    PeerSource("Patchwork++", "BSD-2", (PATCHWORKPP,), "patchworkpp_adapter.cpp",
               code="patchwork-plusplus/cpp/patchworkpp/src/patchworkpp.cpp",
               include="patchwork-plusplus/cpp/patchworkpp/include"),
    PeerSource("GroundGrid", "BSD-3", (GROUNDGRID, GRID_MAP), "groundgrid_adapter.cpp",
               code="groundgrid/src/GroundSegmentation.cpp grid_map/grid_map_core/src/*.cpp "
                    "grid_map/grid_map_core/src/iterators/*.cpp",
               include="groundgrid/include grid_map/grid_map_core/include",
               flags="-DEIGEN_FUNCTORS_PLUGIN='\"grid_map_core/eigen_plugins/FunctorsPlugin.hpp\"' "
                     "-DEIGEN_DENSEBASE_PLUGIN='\"grid_map_core/eigen_plugins/DenseBasePlugin.hpp\"' -pthread",
               note="its core, each scan alone: no odometry"),
    PeerSource("DipG-Seg", "GPL-3", (DIPG_SEG,), "dipgseg_adapter.cpp",
               include="DipG-Seg/src/include DipG-Seg/src/utils", flags="-lopencv_imgproc -lopencv_core", needs=OPENCV),
    PeerSource("linefit", "BSD-3", (LINEFIT,), "linefit_adapter.cpp",
               code="linefit_ground_segmentation/linefit_ground_segmentation/src/ground_segmentation.cc "
                    "linefit_ground_segmentation/linefit_ground_segmentation/src/segment.cc "
                    "linefit_ground_segmentation/linefit_ground_segmentation/src/bin.cc",
               include="linefit_ground_segmentation/linefit_ground_segmentation/include", flags="-pthread -include iostream"),
    PeerSource("depth_clustering", "MIT-like", (DEPTH_CLUSTERING,), "depth_clustering_adapter.cpp",
               code="depth_clustering/src/projections/*.cpp depth_clustering/src/ground_removal/*.cpp "
                    "depth_clustering/src/communication/*.cpp depth_clustering/src/utils/cloud.cpp "
                    "depth_clustering/src/utils/rich_point.cpp depth_clustering/src/image_labelers/abstract*.cpp "
                    "depth_clustering/src/image_labelers/diff_helpers/*.cpp",
               include="depth_clustering/src", flags="-lopencv_imgproc -lopencv_core", needs=OPENCV,
               note="ground removal at 7 degrees, projection included"),
    PeerSource("JCP", "GPL-3", (LIDAR_PROCESSING,), "jcp_adapter.cpp",
               code="LiDAR-Processing-V2/lidar_processing_lib/src/segmenter.cpp",
               include="LiDAR-Processing-V2/lidar_processing_lib/include "
                       "LiDAR-Processing-V2/lidar_processing_lib/include/lidar_processing_lib",
               flags="-lopencv_imgproc -lopencv_core", needs=OPENCV),
    PeerSource("TRAVEL", "GPL-3", (TRAVEL,), "travel_adapter.cpp", include="TRAVEL/include", flags="-include queue",
               note="its ground segmentation"),
)  # fmt: skip
# Programs of ours for --objects.
OBJECT_PEERS = (
    PeerSource("Euclidean (squares)", "ours", (), "object_peers/euclidean_adapter.cpp", flags="-DSQUARES"),
    PeerSource("Euclidean (unlimited)", "ours", (), "object_peers/euclidean_adapter.cpp", flags="-DSQUARES -DALL"),
    PeerSource("Euclidean (points)", "ours", (), "object_peers/euclidean_adapter.cpp"),
)
JUDGE = PeerSource("object_entropies", "ours", (), "object_peers/object_entropies.cpp")


def run(command, folder, what):
    try:
        ran = subprocess.run([str(part) for part in command], cwd=folder, capture_output=True, text=True,
                             env=os.environ | {"GIT_TERMINAL_PROMPT": "0"})  # fmt: skip
    except OSError as error:
        raise Unavailable(f"{what}: {command[0]}: {error.strerror}") from error
    if ran.returncode != 0:
        lines = ran.stderr.strip().splitlines()
        told = next((line for line in lines if "error" in line or "fatal" in line), lines[-1] if lines else "no reason")
        raise Unavailable(f"{what}: {told}")
    return ran.stdout


def fetch(source, folder):
    """Returns the folder of a source at its commit, below `folder`; kept for the next time."""
    place = folder / source.place
    fetched = place / ".fetched"
    if fetched.is_file() and fetched.read_text() == source.commit:
        return
    what = f"{source.repository}@{source.commit[:7]} cannot be fetched"
    place.mkdir(parents=True, exist_ok=True)
    run(["git", "init", "-q"], place, what)
    # Fetches no files at first (most are pictures); git fetches them when needed.
    run(["git", "config", "remote.origin.url", f"https://github.com/{source.repository}"], place, what)
    run(["git", "config", "remote.origin.promisor", "true"], place, what)
    run(["git", "config", "remote.origin.partialclonefilter", "blob:none"], place, what)
    run(["git", "fetch", "-q", "--depth", "1", "--filter=blob:none", "origin", source.commit], place, what)
    run(["git", "reset", "-q", "FETCH_HEAD"], place, what)
    listed = run(["git", "ls-files"], place, what).split("\n")
    code = [name for name in listed if Path(name).is_relative_to(source.folder) and Path(name).suffix in SUFFIXES]
    run(["git", "checkout", "-q", "FETCH_HEAD", "--", *code], place, what)
    fetched.write_text(source.commit)


def write_stand_ins(folder):
    for stub, headers in STAND_INS.items():
        for header in headers:
            path = folder / header
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f'#include "{stub}"\n')


def build(peer, folder):
    """Returns the program of a peer, built below `folder` if it is missing or older than its
    adapter's files. Raises Unavailable."""
    if peer.needs and not Path(peer.needs).is_file():
        raise Unavailable(f"{peer.needs} is missing; ./tools/setup --peers installs it")
    for source in peer.sources:
        fetch(source, folder)
    program = folder / "bin" / peer.name
    ours = [path for path in ADAPTERS.rglob("*") if path.suffix in (".cpp", ".hpp", ".py")]
    if program.is_file() and program.stat().st_mtime > max(path.stat().st_mtime for path in ours):
        return program
    program.parent.mkdir(parents=True, exist_ok=True)
    stand_ins = folder / "stand_ins"
    write_stand_ins(stand_ins)
    code = [path for pattern in peer.code.split() for path in sorted(folder.glob(pattern))]
    include = [f"-I{path}" for path in (stand_ins, ADAPTERS, *(folder / name for name in peer.include.split()))]
    unfinished = program.with_suffix(".part")
    run([os.environ.get("CXX", "g++"), *FLAGS.split(), *include, ADAPTERS / peer.adapter, *code, "-o", unfinished,
         *shlex.split(peer.flags)], folder, f"{peer.name} cannot be built")  # fmt: skip
    unfinished.replace(program)
    return program
