"""Usage: sbom.py ROOT VERSION

Compares the bill of materials of an image with what is in the image: every library comes from a
listed package of the listed version, and every listed package has its papers there.
"""

import json
import os
import sys


def main(root, version):
    faults = []
    with open(f"{root}/usr/share/doc/trcd/sbom.cdx.json", encoding="utf-8") as file:
        bill = json.load(file)
    if bill["metadata"]["component"]["version"] != version:
        faults.append(f"is of version {bill['metadata']['component']['version']}")
    used = {}
    for component in bill["components"]:
        properties = {p["name"]: p["value"] for p in component["properties"]}
        used.setdefault(properties["trc:use"], {})[component["name"]] = component
    loaded, compiled = used.get("loaded", {}), used.get("compiled", {})
    for name in ("libc6", "libgrpc29", "libprotobuf32", "libssl3", "libstdc++6"):
        if name not in loaded:
            faults.append(f"{name} is not listed")
    for name in ("libcli11-dev", "libgrpc++-dev", "libtomlplusplus-dev"):
        if name not in compiled:
            faults.append(f"{name}, whose headers are compiled in, is not listed")

    described = {}
    for name in os.listdir(f"{root}/var/lib/dpkg/status.d"):
        with open(f"{root}/var/lib/dpkg/status.d/{name}", encoding="utf-8") as file:
            fields = dict(line.rstrip("\n").split(": ", 1) for line in file
                          if not line.startswith(" ") and ": " in line)
        described[name] = fields["Version"]
    if described != {name: c["version"] for name, c in loaded.items()}:
        faults.append("status.d and the list differ")
    for name in loaded:
        if not os.path.getsize(f"{root}/usr/share/doc/{name}/copyright"):
            faults.append(f"{name} has no copyright file")

    libraries = [f for folder, _, files in os.walk(f"{root}/usr/lib") for f in files]
    if len(libraries) < 20 or len(loaded) < 15 or len(loaded) > len(libraries):
        faults.append(f"{len(libraries)} libraries of {len(loaded)} packages")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
