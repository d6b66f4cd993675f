#!/usr/bin/env python3
"""python_stubs.py > python/spf/_core.pyi : the types of the compiled half, for editors and type checkers.

They are read from the module itself: its signatures, its documentation and, of parameters, the values of their fields.
What a signature leaves open (arrays and numbers that are checked by hand) is said here by the name of the argument; a new
name must be added. A test compares the result with the file.
"""
import inspect
import re
import textwrap

import spf._core as core

ARRAY = "NDArray[np.float64]"
POINTS = f"float | {ARRAY}"
ARGUMENTS = {
    **dict.fromkeys(["position", "velocity", "end_velocity", "goal", "robot", "low", "high", "center", "corners", "point", "points",
                     "direction", "preferred_side", "pose", "disturbance", "input", "twist_body", "coefficients",
                     "action", "durations"], "ArrayLike"),
    **dict.fromkeys(["time", "start_time", "duration", "radius", "robot_radius", "resolution", "max_distance", "distance",
                     "threshold", "mahalanobis", "ahead", "sigma", "heading", "steering_angle", "now"], "float"),
    **dict.fromkeys(["heading_from", "heading_to", "previous"], "ArrayLike | None"),
    **dict.fromkeys(["trial", "trials", "first", "jobs"], "int"),
    "seed": "int | None", "path": "str | os.PathLike[str]", "options": "dict[str, Any] | None",
    "settings": "dict[str, Any]", "scene_settings": "dict[str, Any]", "values": "dict[str, Any]",
    "detections": "Sequence[ArrayLike]", "progress": "Callable[[int, int, Trial], object] | None",
    "make": "Callable[[AgentParameters], Any]", "change": "Callable[[AgentParameters], object] | None",
    "shard": "tuple[int, int]",
}
OPEN = {"object", "dict", "list", "function", "Optional[function]", "Optional[dict]", "Tuple[int, int]"}
RETURNS = {
    **dict.fromkeys(["ProbabilityField.density", "ProbabilityField.mahalanobis", "ProbabilityField.risk",
                     "ProbabilityField.clearance", "OccupancyMap.distance", "CostToGo.cost_to_go", "PlanRequest.distance",
                     "PlanRequest.cost_to_go"], POINTS),
    "Scenario.__getitem__": "Any", "Trial.to_dict": "dict[str, Any]", "Trial.contact": "dict[str, Any] | None",
    "Trial.robots": "NDArray[np.void]", "Tracker.estimate": "dict[str, Any] | None", "Observation.ranges": f"{ARRAY} | None",
    "World.reset": "tuple[dict[str, Any], dict[str, Any]]",
    "World.step": f"tuple[dict[str, Any], {ARRAY}, bool, bool, dict[str, Any]]",
    "World.messages": "list[Message]", "World.active": "list[bool]", "Results.trials": "list[Trial]",
    "Results.rows": "list[dict[str, Any]]", "Results.pairs": "list[dict[str, Any]]", "Scenario.warnings": "list[str]",
    "Recording.plans": "list[dict[str, Any]]", "Recording.events": "list[dict[str, Any]]",
    "OccupancyMap.node_distances": "NDArray[np.float32]", "MethodTable.all": "dict[str, str]",
}
TYPES = [(r"spf\._core\.", ""), (r"numpy\.ndarray\[numpy\.float64\]", ARRAY), (r"numpy\.ndarray\[.*", ARRAY), (r"\bdict$", "dict[str, Any]"),
         (r"^List\[(.*)\]$", r"list[\1]"), (r"^Optional\[(.*)\]$", r"\1 | None")]
SPECIAL = {"__eq__": ["self", "other: object"], "__setattr__": ["self", "field: str", "value: Any"],
           "__deepcopy__": ["self", "memo: dict[int, Any]"]}
HEADER = '''"""The types of the compiled half; made by script/python_stubs.py."""
import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

class InputError(ValueError): ...
'''
SKIPPED = {"__module__", "__doc__", "__new__", "__hash__", "__getstate__", "__setstate__", "__repr__", "__dict__", "__weakref__"}


def python_type(text):
    for pattern, replacement in TYPES:
        text = re.sub(pattern, replacement, text)
    return text


def split(arguments):
    """At the commas outside of brackets and quotation marks."""
    parts, depth, quoted = [""], 0, False
    for letter in arguments:
        quoted ^= letter == "'"
        depth += 0 if quoted else (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0 and not quoted:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts if part.strip()]


def argument(text, where):
    name, _, rest = text.partition(": ")
    if not rest or name == "self":
        return name
    kind, has_default, default = rest.partition(" = ")
    if kind.startswith("numpy.ndarray"):
        kind = "ArrayLike"
    elif kind in OPEN:
        if name not in ARGUMENTS:
            raise SystemExit(f"python_stubs.py: ARGUMENTS lacks {name} of {where}")
        kind = ARGUMENTS[name]
    if default == "None" and not re.search("Any|None|Optional", kind):
        kind += " | None"
    simple = re.fullmatch(r"None|True|False|-?[\d.]+|'\w*'", default)
    return f"{name}: {python_type(kind)}" + (f" = {default if simple else '...'}" if has_default else "")


def documentation(text, indent):
    lines = textwrap.indent(f'"""{text.strip()}"""', indent).splitlines()
    return "\n".join(line.rstrip() for line in lines)


def function(name, doc, where, indent):
    head, _, text = doc.partition("\n")
    begin, end = head.index("("), head.rindex(") -> ")
    parts = split(head[begin + 1:end])
    arguments = SPECIAL.get(name) or [argument(part, where) for part in parts]
    if name == "__init__":
        arguments = ["**values: Any" if part == "**kwargs" else part for part in arguments]
    returns = "None" if name in ("__init__", "__setattr__") else RETURNS.get(where, python_type(head[end + 5:]))
    static = "" if arguments[:1] == ["self"] or indent == "" else f"{indent}@staticmethod\n"
    line = f"{static}{indent}def {name}({', '.join(arguments)}) -> {returns}:"
    return f"{line}\n{documentation(text, indent + '    ')}" if text.strip() else f"{line} ..."


def property_of(kind, name, member, sample):
    where = f"{kind.__name__}.{name}"
    if member.fset is not None:
        returns = type(getattr(sample, name)).__name__
    else:
        returns = RETURNS.get(where) or python_type(member.fget.__doc__.strip().splitlines()[0].split(" -> ")[1])
    lines = [f"    @property\n    def {name}(self) -> {returns}:", documentation(member.__doc__ or "", "        ")]
    if member.fset is not None:
        accepts = returns if returns in ("float", "int", "bool", "str") else f"{returns}"
        lines.append(f"    @{name}.setter\n    def {name}(self, value: {accepts}) -> None: ...")
    return "\n".join(lines)


def class_of(kind):
    sample = kind() if kind.__name__.endswith(("Parameters", "Weights")) else None
    lines = [f"class {kind.__name__}:", documentation(kind.__doc__, "    ")]
    for name, member in vars(kind).items():
        if name in SKIPPED or name.startswith("__pybind11") or member is None:
            continue
        if name == "__init__" and ") -> " not in member.__doc__:  # made by functions alone
            continue
        if isinstance(member, property):
            lines.append(property_of(kind, name, member, sample))
        else:
            lines.append(function(name, getattr(kind, name).__doc__, f"{kind.__name__}.{name}", "    "))
    return "\n".join(lines)


def stubs():
    parts = [HEADER]
    for name, value in vars(core).items():
        if name.startswith("_") or name == "InputError":
            continue
        parts.append(class_of(value) if inspect.isclass(value) else function(name, value.__doc__, name, ""))
    return "\n".join(parts) + "\n"


if __name__ == "__main__":
    print(stubs(), end="")
