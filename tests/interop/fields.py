"""fields.py IDL OUT NAMESPACE STRUCT...: a C++ header that shows the fields of these structs of IDL by their names there, of
the classes that Fast DDS' generator makes: visit_fields(value, f) calls f(name, field) in the order of the definition."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parents[2] / "examples/ros2"))
import copy_idl  # noqa: E402

source, out, namespace, *wanted = sys.argv[1:]
bodies = dict(copy_idl.structs(copy_idl.without_comments(pathlib.Path(source).read_text())))
lines = ["#pragma once", f"namespace {namespace} {{"]
for name in wanted:
    calls = [f'  f("{field}", value.{field}());' for field in copy_idl.fields(bodies[name])]
    lines += ["template <class F>", f"void visit_fields(const {name}& value, F&& f) {{", *calls, "}"]
pathlib.Path(out).write_text("\n".join([*lines, "}", ""]))
