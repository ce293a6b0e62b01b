"""Tool radius compensation (G41/G42) of CNC programs.

    import trc
    print(trc.compensate(open("part.nc").read(), radius=5, server="box:50051").text)

Without `server` the package starts a `trcd` of this machine on a socket of its own. A program that
cannot be compensated raises TrcError: its diagnostics name line, cause and remedy. Nothing of a
result that was not returned may be machined.
"""

from .client import Client, compensate, compensate_path, survey_radii
from .errors import ServerError, TrcError
from .path import Block, CompensatedPath, Kind, Path
from .result import (
    Diagnostic, PathPart, PathResult, Place, ProgramPart, RelatedPlace, Result, Severity)
from .survey import Clearance, LargestRadius, Survey, SurveyedRadius, SurveyPlace, UncutWall
from .tls import Tls
from .version import __version__

__all__ = [
    "Block",
    "Clearance",
    "Client",
    "CompensatedPath",
    "Diagnostic",
    "Kind",
    "LargestRadius",
    "Path",
    "PathPart",
    "PathResult",
    "Place",
    "ProgramPart",
    "RelatedPlace",
    "Result",
    "ServerError",
    "Severity",
    "Survey",
    "SurveyPlace",
    "SurveyedRadius",
    "Tls",
    "TrcError",
    "UncutWall",
    "__version__",
    "compensate",
    "compensate_path",
    "survey_radii",
]
