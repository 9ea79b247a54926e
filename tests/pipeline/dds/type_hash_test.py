#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Computes what ROS 2 calls the hash of each message type (RIHS01) from ros_types.idl, and compares it with what
terracut tells on the network.

The hash is the SHA-256 of the type's description as JSON, with those of all types in it (REP 2016). That of
PointCloud2 was seen at a ROS 2 Jazzy (shared/docs/outputs.md), those of the other messages below in the tests of
other writers of ROS 2 messages: by them this way of computing them is checked.

type_hash_test.py ros_types.idl topic_writer.cpp
"""

import hashlib
import json
import re
import sys
from pathlib import Path

PRIMITIVE = {"int8": 2, "octet": 3, "long": 6, "unsigned long": 7, "float": 10, "double": 11, "boolean": 15, "string": 17}  # FieldType.msg
BYTE = 16  # what an octet is where the .msg says byte
NESTED = 1
ARRAY, SEQUENCE = 48, 144  # one of fixed length, an unbounded one; on top
SEEN_AT_ROS = {
    "sensor_msgs/msg/PointCloud2": "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5",
    "vision_msgs/msg/Detection3DArray": "793f5eab9595ac1c0da07873cc859db42eae51f0ee76056db8562515d830e018",
    "visualization_msgs/msg/MarkerArray": "86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf",
    "sensor_msgs/msg/LaserScan": "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
    "geometry_msgs/msg/PolygonStamped": "b7cf07932f1523d4b4088075945c1a0141f7cd21da87cc940fc61652e9138b46",
    "nav_msgs/msg/OccupancyGrid": "8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7",
}
SAYS_BYTE = {("diagnostic_msgs/msg/DiagnosticStatus", "level")}


def ros_name(package: str, name: str) -> str:
    return f"{package}/msg/{name.removesuffix('_')}"


def read_types(idl: str) -> dict:
    """Name of each type: its fields, in order, as (name, type, is it a sequence, length of an array or 0)."""
    types = {}
    idl = re.sub(r"//[^\n]*", "", idl)
    for package, body in re.findall(r"module (\w+) \{ module msg \{ module dds_ \{(.*?)\n\}; \}; \};", idl, re.DOTALL):
        for name, fields in re.findall(r"struct (\w+) \{(.*?)\};", body, re.DOTALL):
            types[ros_name(package, name)] = [
                (field, type_name.removeprefix("sequence<").removesuffix(">"), type_name.startswith("sequence<"), int(length or 0))
                for type_name, field, length in re.findall(r"(\w[\w:<> ]*) (\w+)(?:\[(\d+)\])?;", fields)
            ]
    return types


def nested_name(type_name: str):
    parts = type_name.split("::")
    return ros_name(parts[0], parts[-1]) if len(parts) > 1 else None


def description(types: dict, name: str) -> dict:
    fields = []
    for field, type_name, is_sequence, length in types[name]:
        nested = nested_name(type_name)
        number = NESTED if nested else BYTE if (name, field) in SAYS_BYTE else PRIMITIVE[type_name]
        fields.append(
            {
                "name": field,
                "type": {
                    "type_id": number + (SEQUENCE if is_sequence else ARRAY if length else 0),
                    "capacity": length,
                    "string_capacity": 0,
                    "nested_type_name": nested or "",
                },
            }
        )
    return {"type_name": name, "fields": fields}


def types_in(types: dict, name: str, found: set) -> set:
    for _, type_name, *_ in types[name]:
        nested = nested_name(type_name)
        if nested and nested not in found:
            found.add(nested)
            types_in(types, nested, found)
    return found


def type_hash(types: dict, name: str) -> str:
    whole = {
        "type_description": description(types, name),
        "referenced_type_descriptions": [description(types, each) for each in sorted(types_in(types, name, set()))],
    }
    return hashlib.sha256(json.dumps(whole, separators=(", ", ": ")).encode()).hexdigest()


def main() -> int:
    types = read_types(Path(sys.argv[1]).read_text())
    told = re.findall(
        r"&(\w+?)_msg_dds__(\w+?)__desc,\s*\"RIHS01_([0-9a-f]{64})\"", Path(sys.argv[2]).read_text()
    )
    faults = [
        f"{name} has hash {type_hash(types, name)}, ROS 2 says {seen}"
        for name, seen in SEEN_AT_ROS.items()
        if type_hash(types, name) != seen
    ]
    for package, short, hash_told in told:
        name = ros_name(package, short)
        if type_hash(types, name) != hash_told:
            faults.append(f"{name} has hash {type_hash(types, name)}, told is {hash_told}")
    if len(told) < 9:
        faults.append(f"{len(told)} types with a hash are told; expected are 9")
    print("\n".join(faults) or f"{len(told)} hashes are right")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
