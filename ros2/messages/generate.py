#!/usr/bin/env python3
"""generate.py OUT FOLDER... : C++ structs from the interface definitions of ROS 2 packages.

Each FOLDER holds packages, or is one: PACKAGE/msg/*.msg, srv/*.srv, action/*.action. What a distribution of ROS 2 defines in
another way is in DISTRIBUTION/PACKAGE/..., and gives OUT/DISTRIBUTION/PACKAGE/Name.hpp with namespace
ros2::DISTRIBUTION::PACKAGE. For each definition OUT gets PACKAGE/Name.hpp with the structs of namespace ros2::PACKAGE: members with defaults, constants, the type's name, its
type hash (RIHS01), `visit_fields` and equality. Of services there are Name_Request and Name_Response; of actions the parts that
travel (Name_SendGoal_Request, ...), and Name, which holds their names together. A definition that is not understood ends the run with FILE:LINE and a sentence.
"""
import hashlib
import json
import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

# name in a definition: (C++ type, number of the type in a type description)
PRIMITIVES = {
    "int8": ("std::int8_t", 2), "uint8": ("std::uint8_t", 3), "char": ("std::uint8_t", 3),
    "int16": ("std::int16_t", 4), "uint16": ("std::uint16_t", 5), "int32": ("std::int32_t", 6),
    "uint32": ("std::uint32_t", 7), "int64": ("std::int64_t", 8), "uint64": ("std::uint64_t", 9),
    "float32": ("float", 10), "float64": ("double", 11), "bool": ("bool", 15), "byte": ("std::uint8_t", 16),
    "string": ("std::string", 17),
}
BOUNDED_STRING, NESTED = 21, 1
FIXED_ARRAY, BOUNDED_SEQUENCE, SEQUENCE = 48, 96, 144
EMPTY_MEMBER = "structure_needs_at_least_one_member"

LINE = re.compile(
    r"(?P<type>[A-Za-z]\w*(?:/[A-Za-z]\w*)*)(?:<=(?P<string_bound>\d+))?(?P<array>\[(?P<bounded><=)?(?P<length>\d*)\])?"
    r"\s+(?P<name>[A-Za-z]\w*)(?:\s*=\s*(?P<constant>.+)|\s+(?P<default>.+))?")


@dataclass
class Field:
    name: str
    kind: str  # a primitive, or the full name of a nested type
    array: str = "none"  # none, fixed, bounded, unbounded
    capacity: int = 0
    string_bound: int = 0
    default: str = ""


@dataclass
class Struct:
    package: str
    kind: str  # msg, srv, action
    name: str
    fields: list = field(default_factory=list)
    constants: list = field(default_factory=list)  # (kind, name, value)
    text: str = ""  # of a message: its definition

    @property
    def full_name(self):
        return f"{self.package}/{self.kind}/{self.name}"


class DefinitionError(Exception):
    pass


def read_line(line, package):
    """A Field, or a constant as (kind, name, value)."""
    match = LINE.fullmatch(line)
    if not match:
        raise DefinitionError(f"'{line}' is neither a field nor a constant")
    kind = match["type"]
    if kind not in PRIMITIVES:
        parts = kind.split("/")
        kind = "/".join([parts[0] if len(parts) > 1 else package, "msg", parts[-1]])
        if match["constant"] or match["default"]:
            raise DefinitionError(f"'{line}': only primitive types have constants and defaults")
    if kind == "std_msgs/msg/Header" or match["type"] == "Header":
        kind = "std_msgs/msg/Header"
    if match["constant"]:
        return kind, match["name"], match["constant"].strip()
    array = "none"
    if match["array"]:
        array = "bounded" if match["bounded"] else "fixed" if match["length"] else "unbounded"
    if array != "none" and match["default"]:
        raise DefinitionError(f"'{line}': defaults of arrays are not supported")
    if match["string_bound"] and kind != "string":
        raise DefinitionError(f"'{line}': only strings are bounded by <=")
    return Field(match["name"], kind, array, int(match["length"] or 0), int(match["string_bound"] or 0),
                 (match["default"] or "").strip())


def read_parts(path, package):
    """The fields and constants of each part of a definition; parts are separated by ---."""
    parts = [([], [])]
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        line = re.sub(r"#.*", "", line).strip()
        if line == "---":
            parts.append(([], []))
        elif line:
            try:
                item = read_line(line, package)
            except DefinitionError as error:
                raise DefinitionError(f"{path}:{number}: {error}") from error
            parts[-1][isinstance(item, tuple)].append(item)
    expected = {".msg": 1, ".srv": 2, ".action": 3}[path.suffix]
    if len(parts) != expected:
        raise DefinitionError(f"{path}:1: has {len(parts)} parts, must have {expected}")
    return parts


def structs_of(path, package):
    """The types that a definition gives, those that others use first."""
    parts = read_parts(path, package)
    name, kind = path.stem, path.suffix[1:]
    if kind == "msg":
        return [Struct(package, kind, name, *parts[0], path.read_text(encoding="utf-8"))]
    if kind == "srv":
        return [Struct(package, kind, f"{name}_{end}", *part) for end, part in zip(("Request", "Response"), parts)]
    own = f"{package}/action/{name}_"
    goal_id = Field("goal_id", "unique_identifier_msgs/msg/UUID")
    stamp = Field("stamp", "builtin_interfaces/msg/Time")
    travelling = {
        "SendGoal_Request": [goal_id, Field("goal", own + "Goal")],
        "SendGoal_Response": [Field("accepted", "bool"), stamp],
        "GetResult_Request": [goal_id],
        "GetResult_Response": [Field("status", "int8"), Field("result", own + "Result")],
        "FeedbackMessage": [goal_id, Field("feedback", own + "Feedback")],
    }
    return ([Struct(package, kind, f"{name}_{end}", *part) for end, part in zip(("Goal", "Result", "Feedback"), parts)]
            + [Struct(package, kind, f"{name}_{end}", fields) for end, fields in travelling.items()])


# ---- type hashes: SHA-256 of a type's description as one line of JSON

def fields_of(struct):
    return struct.fields or [Field(EMPTY_MEMBER, "uint8")]


def type_description(struct):
    described = []
    for item in fields_of(struct):
        nested = "" if item.kind in PRIMITIVES else item.kind
        number = NESTED if nested else BOUNDED_STRING if item.string_bound else PRIMITIVES[item.kind][1]
        number += {"none": 0, "fixed": FIXED_ARRAY, "bounded": BOUNDED_SEQUENCE, "unbounded": SEQUENCE}[item.array]
        described.append({"name": item.name, "type": {"type_id": number, "capacity": item.capacity,
                                                      "string_capacity": item.string_bound, "nested_type_name": nested}})
    return {"type_name": struct.full_name, "fields": described}


def nested_types(struct, structs, found=None):
    """All types that are reached from one, by name."""
    found = {} if found is None else found
    for item in struct.fields:
        if item.kind not in PRIMITIVES and item.kind not in found:
            if item.kind not in structs:
                raise DefinitionError(f"{struct.full_name}: {item.name} is of type {item.kind}, which is not defined")
            found[item.kind] = structs[item.kind]
            nested_types(structs[item.kind], structs, found)
    return found


def type_hash(struct, structs):
    referenced = nested_types(struct, structs)
    text = json.dumps({"type_description": type_description(struct),
                       "referenced_type_descriptions": [type_description(referenced[name]) for name in sorted(referenced)]})
    return "RIHS01_" + hashlib.sha256(text.encode("utf-8")).hexdigest()


def whole_definition(struct, structs):
    """A message's definition with those of all types that it reaches, as recordings hold it (schema encoding ros2msg)."""
    nested = nested_types(struct, structs)
    parts = [struct.text] + [f"MSG: {nested[name].package}/{nested[name].name}\n{nested[name].text}" for name in sorted(nested)]
    return ("=" * 80 + "\n").join(part.rstrip("\n") + "\n" for part in parts)


# ---- C++

def cpp_type(item, own):
    """`own`: the types of the same definition, whose namespace needs no name."""
    inner = PRIMITIVES[item.kind][0] if item.kind in PRIMITIVES else "::ros2::{0}::{2}".format(*item.kind.split("/"))
    if item.kind in own:
        inner = item.kind.split("/")[2]
    if item.array == "none":
        return inner
    return f"std::array<{inner}, {item.capacity}>" if item.array == "fixed" else f"std::vector<{inner}>"


def literal(kind, value):
    if kind == "string":
        return json.dumps(value.strip("\"'"))
    if kind == "bool":
        return "true" if value.lower() in ("true", "1") else "false"
    if kind == "float32":
        return f"static_cast<float>({value})"
    return value


def cpp_action(name):
    parts = ("Goal", "Result", "Feedback", "SendGoal_Request", "SendGoal_Response", "GetResult_Request",
             "GetResult_Response", "FeedbackMessage")
    return [f"struct {name} {{", *[f"  using {part.replace('_', '')} = {name}_{part};" for part in parts], "};", ""]


def cpp_struct(struct, own, structs):
    lines = [f"struct {struct.name} {{",
             f"  static constexpr const char* kPackage = \"{struct.package}\";",
             f"  static constexpr const char* kKind = \"{struct.kind}\";",
             f"  static constexpr const char* kName = \"{struct.name}\";",
             f"  static constexpr const char* kTypeHash =\n      \"{type_hash(struct, structs)}\";"]
    if struct.text:
        lines.append(f'  static constexpr const char* kDefinition = R"ros2msg({whole_definition(struct, structs)})ros2msg";')
    for kind, name, value in struct.constants:
        base = "const char*" if kind == "string" else PRIMITIVES[kind][0]
        lines.append(f"  static constexpr {base} {name} = {literal(kind, value)};")
    lines.append("")
    for item in fields_of(struct):
        default = literal(item.kind, item.default) if item.default else ""
        lines.append(f"  {cpp_type(item, own)} {item.name}{{{default}}};")
    lines += ["", "  template <class Self, class Visitor>", "  static void visit_fields(Self& self, Visitor& visit) {"]
    lines += [f"    visit(\"{item.name}\", self.{item.name});" for item in fields_of(struct)]
    same = " && ".join(f"one.{item.name} == other.{item.name}" for item in fields_of(struct))
    return lines + ["  }", f"  friend bool operator==(const {struct.name}& one, const {struct.name}& other) {{",
                    f"    return {same};", "  }", "};"]


def cpp_header(path, own, distribution, structs):
    package = own[0].package
    namespace = "::".join(part for part in ("ros2", distribution, package) if part)
    used = {item.kind for struct in own for item in struct.fields if item.kind not in PRIMITIVES}
    used -= {struct.full_name for struct in own}
    includes = sorted("ros2_messages/{0}/{2}.hpp".format(*name.split("/")) for name in used)
    lines = [f"// Made from {package}/{path.parent.name}/{path.name} by ros2/messages/generate.py.", "#pragma once", "",
             *[f"#include <{name}>" for name in ("array", "cstdint", "string", "vector")], "",
             *[f"#include <{name}>" for name in includes], "", f"namespace {namespace} {{", ""]
    for struct in own:
        lines += [*cpp_struct(struct, {other.full_name for other in own}, structs), ""]
    if path.suffix == ".action":
        lines += cpp_action(path.stem)
    return "\n".join([*lines, f"}}  // namespace {namespace}", ""])


def definitions(folders):
    """All definition files below the folders, with their packages and distributions."""
    for folder in folders:
        for suffix in ("msg", "srv", "action"):
            for path in sorted(Path(folder).rglob(f"{suffix}/*.{suffix}")):
                parts = path.relative_to(folder).parts
                yield path, path.parent.parent.name, parts[0] if len(parts) == 4 else ""


def write_if_changed(path, text):
    if path.is_file() and path.read_text(encoding="utf-8") == text:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def main(arguments):
    if len(arguments) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        files = [(path, structs_of(path, package), distribution)
                 for path, package, distribution in definitions(arguments[1:])]
        common = {struct.full_name: struct for _, own, distribution in files if not distribution for struct in own}
        for path, own, distribution in files:
            structs = {**common, **{struct.full_name: struct for struct in own}}
            write_if_changed(Path(arguments[0], distribution, own[0].package, path.stem + ".hpp"),
                             cpp_header(path, own, distribution, structs))
    except DefinitionError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
