#!/usr/bin/env python3
"""copy_idl.py IDL OUT: the messages of IDL as ROS 2 Humble has them, made again from Trivela's own definition.

OUT *.idl: @final instead of @appendable (plain CDR, which every DDS reads), without keys (Humble knows none), and with ROS 2's
names: trivela::msg::KickDecision becomes trivela_msgs::msg::dds_::KickDecision_. The fields stay as they are.
OUT a folder that ends in /: the package trivela_msgs for colcon, a .msg file a struct; an enum's constants stand where it is used.
"""
import pathlib
import re
import sys

ROS = {"boolean": "bool", "octet": "byte", "double": "float64", "float": "float32"}
PACKAGE = """<package format="3"><name>trivela_msgs</name><version>0.1.0</version><description>Trivela's messages</description>
<maintainer email="nobody@example.org">nobody</maintainer><license>see Trivela</license>
<buildtool_depend>ament_cmake</buildtool_depend><build_depend>rosidl_default_generators</build_depend>
<exec_depend>rosidl_default_runtime</exec_depend><member_of_group>rosidl_interface_packages</member_of_group>
<export><build_type>ament_cmake</build_type></export></package>
"""
CMAKE = """cmake_minimum_required(VERSION 3.8)
project(trivela_msgs)
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
file(GLOB messages RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} msg/*.msg)
rosidl_generate_interfaces(${PROJECT_NAME} ${messages})
ament_package()
"""


def without_comments(text):
    return re.sub(r"//[^\n]*", "", text)


def structs(text):
    """(name, body) of each struct."""
    return re.findall(r"struct (\w+) \{(.*?)\n\s*\};", text, re.S)


MEMBER = re.compile(r"^\s*(?:@\w+(?:\([^)]*\))? )*(\w+(?:<\d+>)?) (\w+)(?:\[(\d+)\])?;", re.M)


def fields(body):
    """Their names, in order."""
    return [name for _, name, _ in MEMBER.findall(body)]


def final_copy(text):
    """The text of an IDL file under ROS 2's names."""
    names = [name for name, _ in structs(text)]
    text = re.sub(r'@(unit|profile|topic_name|period|writers)\([^)]*\) |@key |#include "annotations.idl"\n', "", text)
    text = text.replace("@appendable", "@final")
    text = re.sub(rf"\b({'|'.join(names)})\b(?=[^\n]*[;{{])", r"\1_", without_comments(text))
    text = text.replace("module trivela {\nmodule msg {", "module trivela_msgs {\nmodule msg {\nmodule dds_ {")
    return re.sub(r"\};\s*\};\s*$", "};\n};\n};\n", text)


def ros_fields(body, enums):
    """The lines of a .msg file: the fields of a struct, an enum as its number with its labels as constants."""
    for kind, name, length in MEMBER.findall(body):
        if kind in enums:
            yield from (f"uint32 {label}={value}" for value, label in enumerate(enums[kind]))
            kind = "uint32"
        kind = re.sub(r"string<(\d+)>", r"string<=\1", kind)
        yield f"{ROS.get(kind, kind)}{f'[{length}]' if length else ''} {name}"


def write_package(text, folder):
    bare = without_comments(text)
    enums = {name: re.findall(r"\w+", labels) for name, labels in re.findall(r"enum (\w+) \{(.*?)\}", bare, re.S)}
    (folder / "msg").mkdir(parents=True, exist_ok=True)
    (folder / "package.xml").write_text(PACKAGE)
    (folder / "CMakeLists.txt").write_text(CMAKE)
    for name, body in structs(bare):
        (folder / "msg" / f"{name}.msg").write_text("\n".join(ros_fields(body, enums)) + "\n")


def main(source, out):
    text = pathlib.Path(source).read_text()
    if out.endswith("/"):
        write_package(text, pathlib.Path(out))
    else:
        pathlib.Path(out).write_text(final_copy(text))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except OSError as error:
        sys.exit(f"copy_idl.py: {error}")
