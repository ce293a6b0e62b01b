"""Generates the modules of the protocol and the page of the interface, where their sources are: in
a checkout, not in an sdist."""

import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import setup

HERE = Path(__file__).resolve().parent
PROTO = HERE.parents[1] / "proto"
GENERATED = HERE / "src" / "trc" / "v1"


def generate():
    sources = sorted((PROTO / "trc" / "v1").glob("*.proto"))
    if not sources:
        return
    GENERATED.mkdir(exist_ok=True)
    (GENERATED / "__init__.py").write_text('"""Generated from proto/trc/v1."""\n')
    plugin = shutil.which("grpc_python_plugin")
    if plugin is None or shutil.which("protoc") is None:
        raise SystemExit("protoc and grpc_python_plugin are needed: "
                         "apt-get install protobuf-compiler protobuf-compiler-grpc")
    subprocess.run(
        ["protoc", f"-I{PROTO}", f"--python_out={GENERATED.parents[1]}",
         f"--grpc_python_out={GENERATED.parents[1]}", f"--pyi_out={GENERATED.parents[1]}",
         f"--plugin=protoc-gen-grpc_python={plugin}", *map(str, sources)],
        check=True)
    subprocess.run([sys.executable, HERE / "api_page.py", HERE / "src" / "trc" / "API.md"],
                   check=True)


# Before setuptools looks for the packages.
generate()
setup()
