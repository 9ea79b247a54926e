#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The ROS 2 package holds together without ROS: manifest, launch file, layouts and topics, and the guide beside it.

package_test.py REPOSITORY

The launch file runs with stand-ins for the modules of ROS. Where catkin_pkg is installed, it reads the manifest, too, and
where PyYAML is, it reads the YAML files. build_test.cmake builds the package where ament_cmake is installed.
"""

import importlib.util
import json
import re
import sys
import types
import xml.etree.ElementTree as xml
from pathlib import Path
from unittest import mock

LAUNCH = ("ament_index_python", "launch", "launch.actions", "launch.conditions", "launch.substitutions", "launch_ros", "launch_ros.actions",
          "launch_ros.substitutions")


def manifest_faults(repository: Path, package: Path):
    """As REP 149 asks of format 3."""
    manifest = xml.parse(package / "package.xml").getroot()
    text = {tag: manifest.findtext(tag, "") for tag in ("name", "version", "description", "license")}
    version = re.search(r"^project\(terracut VERSION (\S+)", (repository / "CMakeLists.txt").read_text(), re.MULTILINE)[1]
    expected = {
        "format": (manifest.get("format"), "3"),
        "name": (text["name"], package.name),
        "version": (text["version"], version),
        "license": (text["license"], "Apache-2.0"),
        "build type": (manifest.findtext("export/build_type"), "ament_cmake"),
        "build tool": (manifest.findtext("buildtool_depend"), "ament_cmake"),
    }
    yield from (f"package.xml: {what} is {found}, expected is {wanted}"
                for what, (found, wanted) in expected.items() if found != wanted)
    if not re.fullmatch(r"[a-z][a-z0-9_]*", text["name"]):
        yield "package.xml: the name is not one of lower-case letters, digits and '_'"
    if not text["description"].strip() or not re.fullmatch(r"[\w.+-]+@[\w-]+(\.[\w-]+)+", manifest.find("maintainer").get("email")):
        yield "package.xml: no description, or no address of a maintainer"
    imported = set(re.findall(r"^(?:from|import) (launch\w*|ament_\w+)", launch_file(package).read_text(), re.MULTILINE))
    needed = {depend.text for depend in manifest.findall("exec_depend")}
    yield from (f"package.xml does not depend on {module}, which the launch file imports" for module in imported - needed)
    if importlib.util.find_spec("catkin_pkg"):
        from catkin_pkg.package import InvalidPackage, parse_package
        said = []
        try:
            parse_package(str(package), warnings=said)
        except InvalidPackage as error:
            said.append(error)
        yield from (f"catkin_pkg says of package.xml: {what}" for what in said)


def launch_file(package: Path) -> Path:
    return package / "launch/terracut.launch.py"


class Part:
    """Stands for anything that a launch description is made of."""

    def __init__(self, kind, *parts, **named):
        self.kind, self.parts, self.named = kind, parts, named

    def perform(self, context):  # of LaunchConfiguration
        return context[self.parts[0]]


def description_of(package: Path):
    modules = {}
    for name in LAUNCH:
        modules[name] = types.ModuleType(name)
        modules[name].__getattr__ = lambda kind: lambda *parts, **named: Part(kind, *parts, **named)
    modules["ament_index_python.packages"] = types.SimpleNamespace(
        get_package_prefix=lambda name: str(package), get_package_share_directory=lambda name: str(package))
    with mock.patch.dict(sys.modules, modules):
        spec = importlib.util.spec_from_file_location("launch_file", launch_file(package))
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module.generate_launch_description().parts[0]


def launch_faults(package: Path):
    entities = description_of(package)
    arguments = {part.parts[0]: part.named for part in entities if part.kind == "DeclareLaunchArgument"}
    starts = next(part for part in entities if part.kind == "OpaqueFunction").named["function"]
    for command in arguments["command"]["choices"]:
        own = package / "config" / f"{command}.yaml"
        if not own.is_file():
            yield f"the package has no {own.name}, which the launch file takes by itself"
        for config, taken in (("/a b/my.yaml", "/a b/my.yaml"), ("", str(own))):
            context = {"program": "", "config": config, "command": command,
                       "options": "--in '/points raw' --heights"}
            started = [part.named["cmd"] for part in starts(context)]
            expected = [["terracut", "--config", taken, command, "--in", "/points raw", "--heights"]]
            if started != expected:
                yield f"the launch file starts {started}, expected is {expected}"
    words = [argument["default_value"] for argument in arguments.values()]
    words += [word for part in entities if part.kind == "Node" for word in part.named["arguments"]]
    for word in words:
        kind, parts = getattr(word, "kind", "a text"), getattr(word, "parts", ())
        if kind == "PathJoinSubstitution" and not package.joinpath(*parts[0][1:]).is_file():
            yield f"the launch file names {parts[0][1:]}, which the package does not have"
        if kind == "LaunchConfiguration" and parts[0] not in arguments:
            yield f"the launch file uses the argument {parts[0]}, which it does not declare"


def topics_published(repository: Path) -> set[str]:
    return set(re.findall(r'Topic\{"([^"]+)"', (repository / "pipeline/ros_messages/topics.hpp").read_text()))


def preset_topics(repository: Path, preset: str) -> set[str]:
    text = (repository / "tools/cli/output/dds_output.cpp").read_text()
    return set(re.findall(r'"(/[^"]+)"', re.search(rf"case DdsPreset::{preset}:.*?break;", text, re.DOTALL)[0]))


def topic_faults(repository: Path, package: Path):
    published = topics_published(repository)
    foxglove = json.loads((package / "layouts/foxglove.json").read_text())
    shown = {
        "terracut.rviz": re.findall(r"\bValue: (/\S+?),", (package / "layouts/terracut.rviz").read_text()),
        "foxglove.json": [topic for panel in foxglove["configById"].values()
                          for topic in [*panel.get("topics", {}), *filter(None, [panel.get("topicToRender")])]],
    }
    for layout, topics in shown.items():
        if len(topics) < 5:
            yield f"layouts/{layout} shows {len(topics)} topics"
        yield from (f"layouts/{layout} shows {topic}, which is not published" for topic in topics if topic not in published)
    panels = {foxglove["layout"]["first"], foxglove["layout"]["second"]}
    if panels != set(foxglove["configById"]):
        yield f"layouts/foxglove.json places {sorted(panels)} and configures {sorted(foxglove['configById'])}"
    read = set(re.findall(r"topic: (/\S+)", (package / "nav2/costmap.yaml").read_text()))
    if read != preset_topics(repository, "kNav2"):
        yield f"nav2/costmap.yaml reads {sorted(read)}, the preset writes {sorted(preset_topics(repository, 'kNav2'))}"


def guide_faults(repository: Path):
    """The guide for users of scan_ground_filter names parameters and keys that there are, with their defaults."""
    page = (repository / "docs/guide/scan_ground_filter.md").read_text()
    reference = (repository / "docs/reference/parameters.md").read_text()
    defaults = {row[0]: row[3] for row in rows_of(reference)} | {row[0]: row[3] for row in rows_of(
        (repository / "docs/reference/configuration.md").read_text())}
    sections = {key.split(".")[0] for key in defaults}
    named = set(re.findall(r"`(\w+\.\w+)`", page)) | set(re.findall(r"--set (\S+)=", page))
    yield from (f"scan_ground_filter.md names {key}, which there is not" for key in named
                if key.split(".")[0] in sections and key not in defaults)
    for row in rows_of(page):
        for key, default in zip(re.findall(r"`(\w+\.\w+)`", row[2]), re.findall(r"[\d.]+", row[3])):
            if defaults.get(key) != default:
                yield f"scan_ground_filter.md says {default} of {key}, whose default is {defaults.get(key)}"


def rows_of(text: str) -> list[list[str]]:
    rows = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in text.splitlines() if line.startswith("|")]
    return [[row[0].strip("`"), *row[1:]] for row in rows if len(row) >= 4]


def yaml_faults(package: Path):
    if not importlib.util.find_spec("yaml"):
        return
    import yaml
    for path in [*package.rglob("*.yaml"), *package.rglob("*.rviz")]:
        try:
            yaml.safe_load(path.read_text())
        except yaml.YAMLError as error:
            yield f"{path.relative_to(package)}: {error}"


def main() -> int:
    repository = Path(sys.argv[1])
    package = repository / "tools/ros2/terracut_ros"
    faults = [*manifest_faults(repository, package), *launch_faults(package), *topic_faults(repository, package),
              *guide_faults(repository), *yaml_faults(package)]
    print("\n".join(faults) or "the package holds together")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
