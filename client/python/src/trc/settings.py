"""Keyword arguments as the setup of the protocol.

Each field of PathSetup, TrcOptions and ProgramSetup has its own name as a keyword: numbers, True or
False, text, dictionaries for messages, and words for enums, those of the control too, as in
transition="G26". What has another type is refused here, with the name of the field: a radius of
"5,5" or None must not come out as another one.
"""

from __future__ import annotations

import base64
import difflib
import math
import numbers
import os
from typing import Any, Iterable, Mapping, Union

import numpy as np
from google.protobuf import json_format

from .errors import TrcError
from .v1 import block_pb2, options_pb2, setup_pb2, survey_pb2

WORDS = {
    "selection_mode": {
        "G138": "DIRECT", "G139": "INDIRECT", "G236": "ON_PATH", "G237": "PERPENDICULAR",
        "G238": "INSIDE_CORNER", "G239": "WITHOUT_BLOCK"},
    "transition": {"G25": "LINEAR", "G26": "CIRCULAR"},
    "contour_masking": {"G140": "OFF", "G141": "ON"},
    "feed_adaptation": {"G10": "OFF", "G11": "ON"},
    "plane": {"G17": "XY", "G18": "ZX", "G19": "YZ"},
}

Tools = Union[Mapping[int, float], Iterable[Mapping[str, Any]]]


def _fault(name: str, takes: str, value: Any) -> TypeError:
    return TypeError(f"{name} takes {takes}, not {value!r}")


def _two_names(one: str, other: str) -> TypeError:
    """Of a setting given under both names: which of the values is meant is not guessed."""
    return TypeError(f"{one} and {other} are one setting; give it under one of these names")


def _number(descriptor: Any, value: Any) -> Any:
    """A finite number, whole where the field is; of Python or numpy."""
    name = descriptor.name
    is_whole = descriptor.cpp_type not in (descriptor.CPPTYPE_DOUBLE, descriptor.CPPTYPE_FLOAT)
    kind = numbers.Integral if is_whole else numbers.Real
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, kind):
        raise _fault(name, "a whole number" if is_whole else "a number", value)
    if not math.isfinite(value):
        raise ValueError(f"{name} is {value}; it takes a finite number")
    return int(value) if is_whole else float(value)


def _enum(descriptor: Any, value: Any) -> Any:
    """The spelling of the protocol, by it, by its last word or by the word of the control."""
    enum = descriptor.enum_type
    if isinstance(value, int) and not isinstance(value, bool):
        return value
    of_control = WORDS.get(descriptor.name, {})
    if not isinstance(value, str):
        raise _fault(descriptor.name, "a word", value)
    word = of_control.get(value.upper(), value.upper())
    matching = [name for name in enum.values_by_name if name == word or name.endswith("_" + word)]
    if len(matching) == 1:
        return matching[0]
    names = [name for name in enum.values_by_name if not name.endswith("_UNSPECIFIED")]
    shared = len(os.path.commonprefix(names).rpartition("_")[0]) + 1
    known = [*of_control, *(name[shared:] for name in names)]
    raise ValueError(f"{descriptor.name} takes {', '.join(known)}, not {value!r}")


def _value(descriptor: Any, value: Any) -> Any:
    """What a field is given, checked, as JSON has it."""
    entry = descriptor.message_type
    if entry is not None and entry.GetOptions().map_entry:
        if not isinstance(value, Mapping) or not all(isinstance(name, str) for name in value):
            raise _fault(descriptor.name, "a dictionary of names", value)
        return {name: _single(entry.fields_by_name["value"], each) for name, each in value.items()}
    if descriptor.label == descriptor.LABEL_REPEATED:
        if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Iterable):
            raise _fault(descriptor.name, "a list", value)
        return [_single(descriptor, each) for each in value]
    return _single(descriptor, value)


def _single(descriptor: Any, value: Any) -> Any:
    if descriptor.message_type is not None:
        if not isinstance(value, Mapping):
            raise _fault(descriptor.name, "a dictionary", value)
        return _fields(descriptor.message_type, value, descriptor.name)
    if descriptor.enum_type is not None:
        return _enum(descriptor, value)
    if descriptor.cpp_type == descriptor.CPPTYPE_BOOL:
        if not isinstance(value, (bool, np.bool_)):
            raise _fault(descriptor.name, "True or False", value)
        return bool(value)
    if descriptor.type == descriptor.TYPE_BYTES:
        if not isinstance(value, (bytes, bytearray, memoryview)):
            raise _fault(descriptor.name, "bytes", value)
        return base64.b64encode(value).decode("ascii")
    if descriptor.cpp_type == descriptor.CPPTYPE_STRING:
        if not isinstance(value, str):
            raise _fault(descriptor.name, "text", value)
        return value
    return _number(descriptor, value)


def _fields(message_type: Any, given: Mapping[str, Any], of: str) -> dict[str, Any]:
    """A message as JSON, of a dictionary that has none but its fields."""
    known = message_type.fields_by_name
    for name in given:
        if name not in known:
            raise TypeError(f"{name!r} is no field of {of}; {_known(name, known)}")
    return {name: _value(known[name], value) for name, value in given.items()}


def _known(name: Any, names: Iterable[str]) -> str:
    """What was meant perhaps, or what there is."""
    meant = difflib.get_close_matches(str(name), names, 1)
    return f"did you mean {meant[0]!r}?" if meant else f"there are {', '.join(sorted(names))}"


def command(**fields: Any) -> Any:
    """A TrcCommand by its fields."""
    message = block_pb2.TrcCommand()
    return _parsed(_fields(message.DESCRIPTOR, fields, "a command"), message)


def path_setup(settings: Mapping[str, Any]) -> setup_pb2.PathSetup:
    """A PathSetup of keywords; `radius` is short for `tool_radius`."""
    fields = setup_pb2.PathSetup.DESCRIPTOR.fields_by_name
    options = options_pb2.TrcOptions.DESCRIPTOR.fields_by_name
    json: dict[str, Any] = {}
    short: dict[str, Any] = {}
    for given, value in settings.items():
        name = {"radius": "tool_radius"}.get(given, given)
        if value is None:
            continue
        if name in json:
            raise _two_names("radius", "tool_radius")
        if name in fields:
            json[name] = _value(fields[name], value)
        elif name in options:
            short[name] = _value(options[name], value)
        else:
            known = _known(name, ["radius", *fields, *options])
            raise TypeError(f"{name!r} is no setting; {known}")
    if short:
        nested = json.setdefault("options", {})
        for name, value in short.items():
            if name in nested:
                raise _two_names(name, f"options[{name!r}]")
            nested[name] = value
    return _parsed(json, setup_pb2.PathSetup())


def _tool_table(tools: Tools) -> list[dict[str, Any]]:
    tool = setup_pb2.Tool.DESCRIPTOR
    if isinstance(tools, Mapping):
        tools = [{"number": number, "radius": radius} for number, radius in tools.items()]
    elif isinstance(tools, (str, bytes)) or not isinstance(tools, Iterable):
        raise _fault("tools", "number → radius, or dictionaries", tools)
    table = []
    for each in tools:
        if not isinstance(each, Mapping):
            raise _fault("tools", "dictionaries", each)
        row = _fields(tool, each, "a tool")
        if "number" not in row or "radius" not in row:
            raise TypeError(f"a tool has a number and a radius; here is {dict(each)!r}")
        table.append(row)
    return table


def program_setup(settings: Mapping[str, Any], tools: Tools = ()) -> setup_pb2.ProgramSetup:
    """A ProgramSetup of keywords: its own fields, and those of its path."""
    for name in ("output", "response_layout"):
        if name in settings:
            raise TypeError(f"{name} is no setting here: text comes out, and with blocks=True of "
                            "compensate() the blocks too")
    settings = _with_files_of_bytes(settings)
    own = setup_pb2.ProgramSetup.DESCRIPTOR.fields_by_name
    mine = {name: _value(own[name], value) for name, value in settings.items()
            if name in own and name not in ("path", "tools") and value is not None}
    path = {name: value for name, value in settings.items() if name not in mine}
    setup = _parsed({**mine, "tools": _tool_table(tools)}, setup_pb2.ProgramSetup())
    setup.path.CopyFrom(path_setup(path))
    return setup


def _with_files_of_bytes(settings: Mapping[str, Any]) -> Mapping[str, Any]:
    """With those `subprograms` that are bytes, as a file has them, in `subprogram_files`."""
    texts = settings.get("subprograms")
    if not isinstance(texts, Mapping):
        return settings
    files = {name: text for name, text in texts.items() if not isinstance(text, str)}
    given = settings.get("subprogram_files") or {}
    for name in files:
        if name in given:
            raise _two_names(f"subprograms[{name!r}]", f"subprogram_files[{name!r}]")
    return {**settings,
            "subprograms": {name: text for name, text in texts.items() if name not in files},
            "subprogram_files": {**given, **files}}


def survey_setup(radii: Iterable[float], is_path: bool, uncut: bool, largest: bool,
                 settings: Mapping[str, Any]) -> survey_pb2.SurveySetup:
    """A SurveySetup: what is asked, and keywords as of a program or a path."""
    asked = survey_pb2.SurveySetup.DESCRIPTOR.fields_by_name
    setup = survey_pb2.SurveySetup(
        radii=_value(asked["radii"], radii), want_uncut=_value(asked["want_uncut"], uncut),
        without_largest=not largest)
    if is_path:
        setup.path.CopyFrom(path_setup(settings))
    else:
        setup.program.CopyFrom(program_setup(settings))
    return setup


def _parsed(json: Mapping[str, Any], message: Any) -> Any:
    try:
        return json_format.ParseDict(json, message)
    except json_format.ParseError as error:
        raise TrcError(str(error)) from error
