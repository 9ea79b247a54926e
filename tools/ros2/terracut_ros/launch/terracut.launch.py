# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Starts `terracut node`, or `terracut live`, with a file of parameters, and RViz beside it if wanted."""

import shlex

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

    command = [value("program"), "--config", value("config"), value("command"), *shlex.split(value("options"))]
    return [ExecuteProcess(cmd=command, name="terracut", output="screen")]


def in_package(*parts):
    return PathJoinSubstitution([FindPackageShare("terracut_ros"), *parts])


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("command", default_value="node", choices=["node", "live"],
                              description="node: label the clouds of a topic; live: the packets of a sensor"),
        DeclareLaunchArgument("config", default_value=in_package("config", "node.yaml"),
                              description="file of parameters, as `terracut config` checks it"),
        DeclareLaunchArgument("options", default_value="",
                              description="further options of the command, like '--in /velodyne_points'"),
        DeclareLaunchArgument("program", default_value="terracut", description="the program, or its path"),
        DeclareLaunchArgument("rviz", default_value="false", description="true: open RViz, too"),
        DeclareLaunchArgument("fixed_frame", default_value="terracut_ground",
                              description="frame that RViz shows; of node the frame of the answers"),
        OpaqueFunction(function=start_terracut),
        Node(package="rviz2", executable="rviz2", condition=IfCondition(LaunchConfiguration("rviz")),
             arguments=["-d", in_package("layouts", "terracut.rviz"),
                        "-f", LaunchConfiguration("fixed_frame")]),
    ])
