# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Starts `terracut node`, or `terracut live`, with a file of parameters, and RViz beside it if wanted."""

import shlex
from pathlib import Path

from ament_index_python.packages import get_package_prefix, get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def start_terracut(context):
    """Words of `options` become words of the command."""
    def value(name):
        return LaunchConfiguration(name).perform(context)

    command = value("command")
    found = Path(get_package_prefix("terracut_ros"), "lib/terracut_ros/terracut")  # when the package was built
    program = value("program") or (str(found) if found.exists() else "terracut")
    config = value("config") or str(Path(get_package_share_directory("terracut_ros"), "config", f"{command}.yaml"))
    words = [program, "--config", config, command, *shlex.split(value("options"))]
    return [ExecuteProcess(cmd=words, name="terracut", output="screen")]


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("command", default_value="node", choices=["node", "live"],
                              description="node: label the clouds of a topic; live: the packets of a sensor"),
        DeclareLaunchArgument("config", default_value="",
                              description="file of parameters, as `terracut config` checks it (default: the command's)"),
        DeclareLaunchArgument("options", default_value="",
                              description="further options of the command, like '--in /velodyne_points'"),
        DeclareLaunchArgument("program", default_value="",
                              description="path of terracut (default: as found when this package was built)"),
        DeclareLaunchArgument("rviz", default_value="false", description="true: open RViz, too"),
        DeclareLaunchArgument("fixed_frame", default_value="terracut_ground",
                              description="frame that RViz shows; of node the frame of the answers"),
        OpaqueFunction(function=start_terracut),
        Node(package="rviz2", executable="rviz2", condition=IfCondition(LaunchConfiguration("rviz")),
             arguments=["-d", PathJoinSubstitution([FindPackageShare("terracut_ros"), "layouts", "terracut.rviz"]),
                        "-f", LaunchConfiguration("fixed_frame")]),
    ])
