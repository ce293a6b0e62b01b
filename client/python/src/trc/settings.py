"""Keyword arguments as the setup of the protocol.

Each field of PathSetup, TrcOptions and ProgramSetup has its own name as a keyword, with a value as
in JSON; enums also by the word of the control, as in transition="G26".
"""

from __future__ import annotations

from typing import Any, Iterable, Mapping, Union

from google.protobuf import json_format

from .errors import TrcError
from .v1 import options_pb2, setup_pb2, survey_pb2

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


def _value(descriptor: Any, value: Any) -> Any:
    """An enum in the spelling of the protocol; all else as it is."""
    enum = descriptor.enum_type
    if enum is None or not isinstance(value, str):
        return value
    word = WORDS.get(descriptor.name, {}).get(value.upper(), value.upper())
    matching = [name for name in enum.values_by_name if name == word or name.endswith("_" + word)]
    return matching[0] if len(matching) == 1 else value


def path_setup(settings: Mapping[str, Any]) -> setup_pb2.PathSetup:
    """A PathSetup of keywords; `radius` is short for `tool_radius`."""
    fields = setup_pb2.PathSetup.DESCRIPTOR.fields_by_name
    options = options_pb2.TrcOptions.DESCRIPTOR.fields_by_name
    json: dict[str, Any] = {}
    for name, value in settings.items():
        name = {"radius": "tool_radius"}.get(name, name)
        if value is None:
            continue
        if name in fields:
            json[name] = _value(fields[name], value)
        elif name in options:
            json.setdefault("options", {})[name] = value
        else:
            raise TypeError(f"{name!r} is no setting; there are {', '.join(sorted(fields))} and "
                            f"the options {', '.join(sorted(options))}")
    return _parsed(json, setup_pb2.PathSetup())


def program_setup(settings: Mapping[str, Any], tools: Tools = ()) -> setup_pb2.ProgramSetup:
    """A ProgramSetup of keywords: its own fields, and those of its path."""
    own = setup_pb2.ProgramSetup.DESCRIPTOR.fields_by_name
    mine = {name: _value(own[name], value) for name, value in settings.items()
            if name in own and name not in ("path", "tools") and value is not None}
    path = {name: value for name, value in settings.items() if name not in mine}
    table = ([{"number": number, "radius": radius} for number, radius in tools.items()]
             if isinstance(tools, Mapping) else list(tools))
    setup = _parsed({**mine, "tools": table}, setup_pb2.ProgramSetup())
    setup.path.CopyFrom(path_setup(path))
    return setup


def survey_setup(radii: Iterable[float], is_path: bool, uncut: bool, largest: bool,
                 settings: Mapping[str, Any]) -> survey_pb2.SurveySetup:
    """A SurveySetup: what is asked, and keywords as of a program or a path."""
    setup = survey_pb2.SurveySetup(radii=radii, want_uncut=uncut, without_largest=not largest)
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
