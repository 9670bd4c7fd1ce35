"""ros_idl.py PACKAGE OUT STRUCT...: what ROS 2's own rosidl_adapter makes of the .msg files of a package: an IDL file each."""
import pathlib
import sys

from rosidl_adapter.msg import convert_msg_to_idl

package, out, *wanted = sys.argv[1:]
for name in wanted:
    convert_msg_to_idl(pathlib.Path(package), "trivela_msgs", pathlib.Path(f"msg/{name}.msg"), pathlib.Path(out))
