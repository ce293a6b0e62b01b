#!/usr/bin/python3
"""clang-tidy over the sources of core, proto/wire, server and client: over all of them in
continuous integration and with TRC_TEST_LONG, else over those that differ from the last commit, and
those of headers that do.
Usage, from the top of the source tree: tidy.py <scratch folder>

Much of the time that clang-tidy takes for a source goes into its headers. Sources of one folder are
therefore written one after the other into one file. Where such a file does not compile, because
two sources have a name in common, each half is tried on its own; where clang-tidy objects to it,
its sources are looked at one by one, so that each objection names the line it is about.

The scratch folder keeps a build description of its own (one command for each source, no precompiled
headers) and a mark for each source found clean, named by all that the verdict depends on: a second
run checks only what has changed.
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path.cwd()
SCRATCH = pathlib.Path(sys.argv[1]).absolute()
CHECKED = re.compile(r"(core|proto/wire|server|client)/")
LINES_TOGETHER = 2000


def output_of(*command):
    """What the command prints. If it fails, this program ends with what it said."""
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    return done.stdout


def describe_build():
    """The command that compiles each source, by its name from the top of the tree."""
    output_of("cmake", "-G", "Ninja", "-S", ".", "-B", SCRATCH, "-DTRC_TESTS=OFF",
              "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON", "-DCMAKE_UNITY_BUILD=OFF")
    # The sources include generated headers.
    targets = output_of("ninja", "-C", SCRATCH, "-t", "targets", "all")
    output_of("ninja", "-C", SCRATCH, *re.findall(r"^(.*\.pb\.h): ", targets, re.MULTILINE))
    commands = {}
    for entry in json.loads((SCRATCH / "compile_commands.json").read_text()):
        source = os.path.relpath(entry["file"], ROOT)
        if CHECKED.match(source):
            flags = re.sub(r" -o \S+", "", entry["command"])
            commands[source] = flags.replace(entry["file"], "@SOURCE@")
    return commands


def differs_from_last_commit():
    """The sources that do, and those of headers that do; None if there is no commit to compare."""
    head = subprocess.run(["git", "rev-parse", "-q", "--verify", "HEAD"], capture_output=True)
    if head.returncode != 0:
        return None
    names = output_of("git", "diff", "--name-only", "HEAD")
    names += output_of("git", "ls-files", "--others", "--exclude-standard")
    return {re.sub(r"\.h$", ".cpp", name) for name in names.splitlines()}


def names_of(text):
    """What a source may define for itself alone: sources of a batch should not share it."""
    unnamed = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.MULTILINE | re.DOTALL)
    type_name = re.compile(
        r"^(?:struct|class|enum|enum class|using) (\w+)(?: final)?(?: :.*)? ?[={]", re.MULTILINE)
    other_name = re.compile(
        r"^(?!return|using|template)\w[\w:<>,&*\[\] ]*[ &*](\w+)(?:\(|\{| =|;|\[)", re.MULTILINE)
    return {name for part in unnamed.findall(text)
            for names in (type_name, other_name) for name in names.findall(part)}


def in_batches(sources, commands):
    """Lists of sources that lie in one folder and are compiled alike."""
    batches = {}
    for source in sorted(sources):
        text = (ROOT / source).read_text()
        names = names_of(text)
        alike = batches.setdefault((os.path.dirname(source), commands[source]), [])
        batch = next((one for one in alike if not one["names"] & names
                      and one["lines"] + text.count("\n") <= LINES_TOGETHER), None)
        if batch is None:
            batch = {"sources": [], "names": set(), "lines": 0}
            alike.append(batch)
        batch["sources"].append(source)
        batch["names"] |= names
        batch["lines"] += text.count("\n")
    return [batch["sources"] for alike in batches.values() for batch in alike]


def tidy(source, command):
    """What clang-tidy says of a file that is compiled so; nothing if it is clean."""
    name = hashlib.sha256(str(source).encode()).hexdigest()[:16]
    build = SCRATCH / "checked" / name
    build.mkdir(parents=True, exist_ok=True)
    entry = {"directory": str(ROOT), "file": str(source),
             "command": command.replace("@SOURCE@", str(source))}
    (build / "compile_commands.json").write_text(json.dumps([entry]))
    done = subprocess.run(
        ["clang-tidy-14", "--quiet", f"--config-file={ROOT}/.clang-tidy", "-p", build, source],
        capture_output=True, text=True)
    return "" if done.returncode == 0 else done.stdout + done.stderr


def objections(batch, command):
    """What clang-tidy says of sources that are compiled alike, source by source."""
    if len(batch) == 1:
        said = tidy(ROOT / batch[0], command)
        return {batch[0]: re.sub(r"^.*warnings generated\.$", "", said, flags=re.MULTILINE)}
    together = SCRATCH / "together" / (batch[0] + ".to." + os.path.basename(batch[-1]))
    together.parent.mkdir(parents=True, exist_ok=True)
    together.write_text("".join((ROOT / source).read_text() for source in batch))
    said = tidy(together, command)
    if not said:
        return dict.fromkeys(batch, "")
    half = len(batch) // 2
    compiles = "[clang-diagnostic-error]" not in said
    parts = [[one] for one in batch] if compiles else [batch[:half], batch[half:]]
    return {source: text for part in parts for source, text in objections(part, command).items()}


def main():
    commands = describe_build()
    is_whole = os.environ.get("TRC_TEST_LONG") or os.environ.get("CI")
    changed = None if is_whole else differs_from_last_commit()
    common = hashlib.sha256((ROOT / ".clang-tidy").read_bytes())
    for folder in ("core", "proto", "server", "client"):
        for file in sorted((ROOT / folder).rglob("*")):
            if file.suffix in (".h", ".proto"):
                common.update(file.read_bytes())

    def mark_of(source):
        verdict = common.copy()
        verdict.update(commands[source].encode() + (ROOT / source).read_bytes())
        return SCRATCH / "clean" / verdict.hexdigest()[:32]

    due = [source for source in commands
           if (changed is None or source in changed) and not mark_of(source).exists()]
    (SCRATCH / "clean").mkdir(exist_ok=True)
    clean = True
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for said in pool.map(lambda batch: objections(batch, commands[batch[0]]),
                             in_batches(due, commands)):
            for source, text in said.items():
                if text:
                    print(text)
                    clean = False
                else:
                    mark_of(source).touch()
    sys.exit(0 if clean else 1)


main()
