#!/usr/bin/env python3
"""Measures the way of a block through trc and prints the performance table of its README.

Every figure is told with what it is to be and with what it can be compared: the aim, and the echo of
the same messages, or LinuxCNC's interpreter on the same program where `rs274` is installed.
"""

import argparse
import contextlib
import datetime
import json
import os
import pathlib
import platform
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = ROOT / "build/bench/bin"
G26 = ["--set", "transition=G26"]


class Table:
    """The rows: what, aim, measured, compared with."""

    def __init__(self):
        self.rows = []

    def add(self, what, aim, measured, compared=""):
        self.rows.append((what, aim, measured, compared))
        print(f"  {what}: {measured}", file=sys.stderr)

    def print(self):
        print("| Way | Aim | Measured | Compared with |\n|---|---|---|---|")
        for row in self.rows:
            print("| " + " | ".join(row) + " |")


def millions(rate):
    return f"{rate / 1e6:.2f} million/s"


def aim(value, bound, text, at_most=True):
    """The measured text, marked where it misses its aim."""
    met = value <= bound if at_most else value >= bound
    return text if met else f"{text} (missed)"


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_for(port, process):
    """Returns when somebody accepts connections there."""
    for _ in range(6000):
        with contextlib.suppress(OSError):
            socket.create_connection(("127.0.0.1", port)).close()
            return
        if process.poll() is not None:
            break
        time.sleep(0.005)
    sys.exit("error: the server does not start")


@contextlib.contextmanager
def serving(program, *flags):
    """Runs a server at a free loopback port; gives its address."""
    port = free_port()
    address = f"127.0.0.1:{port}"
    process = subprocess.Popen([program, *flags, address])
    try:
        wait_for(port, process)
        yield address
    finally:
        process.terminate()
        process.wait()


def trcd(*flags):
    return serving(BIN / "trcd", "--log-level", "warning", *flags, "--listen")


def echo_server():
    return serving(BIN / "trc_echo_server")


def load_command(address, *options):
    return [BIN / "trc", "load", "--server", address, "--json", *map(str, options)]


def load(address, *options):
    ended = subprocess.run(load_command(address, *options), stdout=subprocess.PIPE, text=True)
    if ended.returncode != 0:
        sys.exit(f"error: trc load {' '.join(map(str, options))} ended with {ended.returncode}: "
                 f"{ended.stdout}")
    return json.loads(ended.stdout)


def saturating(layout, *more):
    return ["--closed", "--streams", 4, "--connections", 2, "--blocks", 200_000, "--batch", 1024,
            "--layout", layout, "--ramp", 0.5, *G26, *more]


def core(table):
    """Stages in one process, CPU time a block: the median of three runs."""
    ended = subprocess.run(
        [BIN / "trc_bench", "--benchmark_format=json", "--benchmark_repetitions=3",
         "--benchmark_report_aggregates_only=true",
         "--benchmark_filter=^(core: blocks to blocks|nc: text to text|wire: served)"],
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True)
    each = {entry["run_name"].split("/")[0]: 1e9 * entry["each"]
            for entry in json.loads(ended.stdout)["benchmarks"]
            if entry["aggregate_name"] == "median"}

    def row(what, name, bound, compared):
        ns = each[name]
        wanted = f"≤ {bound} ns" if bound else ""
        text = f"{ns:.0f} ns a block, {1e3 / ns:.2f} million/s"
        table.add(what, wanted, aim(ns, bound or ns, text), compared)

    row("Core alone, native blocks in and out", "core: blocks to blocks", 70, "")
    row("NC text to NC text, one process", "nc: text to text", 350, "")
    row("A request in columns to its answer, no transport", "wire: served columns", None, "")
    row("The same in messages", "wire: served blocks", None, "")


def throughput(table, seconds):
    for layout, bound, rate_aim in (("columns", 150, 5e6), ("blocks", None, 1.8e6)):
        with echo_server() as address:
            ceiling = load(address, "--duration", seconds,
                           *saturating(layout, "--verify", 0))
        with trcd() as address:
            real = load(address, "--duration", seconds, *saturating(layout))
        ns, echo_ns = real["server"]["nsPerBlock"], ceiling["server"]["nsPerBlock"]
        rate, echo_rate = real["blocksPerSecond"], ceiling["blocksPerSecond"]
        table.add(f"`CompensatePath`, {layout}, 1024 a message, CPU of the server",
                  f"≤ {bound} ns" if bound else "",
                  aim(ns, bound or ns, f"{ns:.0f} ns a block"),
                  f"echo {echo_ns:.0f} ns, {ns / echo_ns:.1f} ×")
        table.add(f"The same, both sides on {os.cpu_count()} cores", f"≥ {rate_aim / 1e6:.1f} million/s",
                  aim(rate, rate_aim, millions(rate), at_most=False),
                  f"echo {millions(echo_rate)}, {100 * rate / echo_rate:.0f} %")


def program(table, seconds):
    with trcd() as address:
        report = load(address, "--duration", seconds, *saturating("text"))
    rate = report["blocksPerSecond"]
    table.add("`CompensateProgram`, both sides", "≥ 1.5 million lines/s",
              aim(rate, 1.5e6, millions(rate), at_most=False),
              f"server {report['server']['nsPerBlock']:.0f} ns CPU a line")


def scaling(table, seconds):
    """What a second core brings: one thread computing, and two."""
    cores = os.cpu_count()
    rates = {}
    for threads in (1, cores):
        with trcd("--worker-threads", str(threads)) as address:
            rates[threads] = load(address, "--duration", seconds, "--verify", 0,
                                  *saturating("columns"))["blocksPerSecond"]
    table.add(f"4 streams, {cores} worker threads against 1", "more",
              f"{rates[cores] / rates[1]:.2f} ×", "the client takes its share of the cores")


def latency(table, seconds):
    job = ["--blocks", 100, "--batch", 128, *G26]
    with trcd() as address:
        quiet = load(address, "--rate", 20, "--streams", 5, "--duration", seconds, *job)
        full = load(address, "--closed", "--streams", 200, "--duration", seconds, *job)
        rate = 0.6 * full["streamsPerSecond"]
        busy = load(address, "--rate", rate, "--streams", 200, "--ramp", 1, "--duration", seconds,
                    *job)
    first = quiet["firstOutputMs"]
    met = first["p50"] <= 0.3 and first["p99"] <= 1
    table.add("First output of a stream of 100 blocks, 20 streams/s", "p50 ≤ 0.3 ms, p99 ≤ 1 ms",
              f"{first['p50']:.2f} ms, {first['p99']:.2f} ms" + ("" if met else " (missed)"),
              "from the intended start")
    p99 = busy["streamMs"].get("p99", 0)
    fault = busy["unfinished"] + sum(busy["errors"].values())
    table.add(f"Streams of 100 blocks at 60 % of saturation ({rate:.0f}/s), at most 200 at once",
              "p99 ≤ 20 ms, no error",
              aim(p99 if not fault else 1e9, 20, f"{p99:.1f} ms, {fault} errors"),
              f"{busy['verified']} verified")


def memory(table, blocks):
    with trcd() as address:
        report = load(address, "--closed", "--jobs", 1, "--blocks", blocks, "--batch", 1024,
                      "--duration", 300, "--verify", 0, *G26)
    resident = report["server"]["residentMib"]
    swing = resident["most"] - resident["least"]
    met = swing <= 16 and resident["most"] < 64
    table.add(f"{blocks / 1e6:g} million blocks through one stream, memory of the server",
              "flat to ± 8 MiB, < 64 MiB",
              f"{resident['least']:.1f} to {resident['most']:.1f} MiB" + ("" if met else " (missed)"),
              millions(report["blocksPerSecond"]))


def start(table):
    """From the start of the process to the first connection it takes while it serves."""
    times = []
    for _ in range(7):
        begin = time.monotonic()
        process = subprocess.Popen([BIN / "trcd", "--listen", "127.0.0.1:0"],
                                   stdout=subprocess.PIPE, text=True)
        port = int(json.loads(process.stdout.readline())["ports"])
        socket.create_connection(("127.0.0.1", port)).close()
        times.append(1e3 * (time.monotonic() - begin))
        process.terminate()
        process.communicate()
    best = sorted(times)[len(times) // 2]
    table.add("Start of `trcd` to SERVING", "≤ 50 ms", aim(best, 50, f"{best:.0f} ms"),
              "median of 7")


def starvation(table, blocks):
    """Small jobs beside one huge selection that is masked as a whole."""
    job = ["--rate", 50, "--streams", 50, "--blocks", 100, "--batch", 128, *G26]
    with trcd("--max-session-memory-mib", "16384") as address:
        alone = load(address, "--duration", 5, *job)
        masked = subprocess.Popen(
            load_command(address, "--jobs", 1, "--blocks", blocks, "--batch", 1024, "--masking",
                         "--shape", "meander", "--set", "tool_radius=15", "--verify", 0,
                         "--duration", 240, *G26),
            stdout=subprocess.PIPE, text=True)
        others = subprocess.Popen(load_command(address, "--duration", 300, *job),
                                  stdout=subprocess.PIPE, text=True)
        report = masked.communicate()[0]
        others.send_signal(signal.SIGINT)
        beside = json.loads(others.communicate()[0])
    masked_report = json.loads(report)
    end = ""
    if masked_report["completed"] != 1:
        end = ", " + (" ".join(masked_report["errors"]) or "not finished in time")
    table.add(f"Streams of 100 blocks beside one masked selection of {blocks / 1e6:g} million",
              "not starved",
              f"p99 {beside['streamMs']['p99']:.1f} ms, max {beside['streamMs']['max']:.1f} ms",
              f"alone {alone['streamMs']['p99']:.1f} ms; the selection took "
              f"{masked_report['seconds']:.0f} s{end}, "
              f"{masked_report['server']['residentMib']['most']:.0f} MiB")


def rs274_program(text):
    """The sample in the words of the RS274NGC interpreter."""
    lines = ["G17 G90 G21 G91.1 F1000"]
    for line in text.splitlines():
        words = line.split(maxsplit=1)[1]
        if words.startswith(("G17", "V.G", "G26")):
            continue
        words = words.replace("G42 G01", "G42.1 D10 G01").replace("G00", "G0")
        lines.append(words)
    return "\n".join(lines) + "\n"


def cpu_of(command, cwd):
    """CPU seconds of a program that has to end well."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, cwd=cwd, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def peer(table, blocks):
    if not shutil.which("rs274"):
        print("  rs274 is not installed (package linuxcnc-uspace): left out", file=sys.stderr)
        return
    with tempfile.TemporaryDirectory() as folder:
        text = subprocess.run([BIN / "trc", "generate", "--shape", "random", "--blocks",
                               str(blocks)], stdout=subprocess.PIPE, text=True, check=True).stdout
        path = pathlib.Path(folder)
        (path / "part.nc").write_text(text.replace(" G25", " G26"))
        (path / "part.ngc").write_text(rs274_program(text))
        ours = cpu_of([BIN / "trc", "compensate", "part.nc", "-o", "part_g40.nc"], folder)
        theirs = cpu_of(["rs274", "-g", "part.ngc", "out.txt"], folder)
    table.add(f"`trc compensate`, file to file, {blocks / 1e6:g} million lines", "",
              f"{1e9 * ours / blocks:.0f} ns CPU a line",
              f"LinuxCNC's `rs274` {1e9 * theirs / blocks:.0f} ns, {theirs / ours:.1f} ×")


def survey(table, blocks, radii):
    """Many radii of one program against as many runs of it, all of them measured."""
    with tempfile.TemporaryDirectory() as folder:
        with open(pathlib.Path(folder) / "part.nc", "w", encoding="utf-8") as part:
            subprocess.run([BIN / "trc", "generate", "--shape", "random", "--blocks", str(blocks)],
                           stdout=part, check=True)
        asked = [f"{4 + i / radii:.6g}" for i in range(radii)]
        together = cpu_of([BIN / "trc", "radii", "part.nc", "--radii", ",".join(asked),
                           "--no-largest"], folder)
        alone = sum(cpu_of([BIN / "trc", "compensate", "part.nc", "--radius", radius, "--set",
                            "verify=enforce", "-o", "out.nc", "--force"], folder)
                    for radius in asked)
    table.add(f"`trc radii`, {radii} radii, {blocks} lines",
              "≤ 0.6 of as many runs", aim(together / alone, 0.6, f"{together / alone:.2f}"),
              f"{1e9 * together / blocks / radii:.0f} ns CPU a line and radius, a run "
              f"{1e9 * alone / blocks / radii:.0f} ns")


def machine():
    model = platform.processor() or "unknown processor"
    with contextlib.suppress(OSError):
        for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT,
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                            text=True).stdout.strip()
    one, five, _ = os.getloadavg()
    return (f"{datetime.date.today()}, {os.cpu_count()} cores of {model}, commit "
            f"{commit or 'unknown'}, load average {one:.1f} before ({five:.1f} over five minutes)")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=5, help="of each load run (default 5)")
    parser.add_argument("--blocks", type=int, default=10_000_000,
                        help="of the long path (default 10 million)")
    parser.add_argument("--masked-blocks", type=int, default=10_000_000,
                        help="of the masked selection, some 500 bytes each (default 10 million)")
    parser.add_argument("--only", help="the names of steps, with commas between")
    arguments = parser.parse_args()

    table = Table()
    steps = {
        "core": lambda: core(table),
        "peer": lambda: peer(table, 1_000_000),
        "survey": lambda: survey(table, 100_000, 16),
        "throughput": lambda: throughput(table, arguments.seconds),
        "program": lambda: program(table, arguments.seconds),
        "scaling": lambda: scaling(table, arguments.seconds),
        "latency": lambda: latency(table, arguments.seconds),
        "memory": lambda: memory(table, arguments.blocks),
        "start": lambda: start(table),
        "starvation": lambda: starvation(table, arguments.masked_blocks),
    }
    chosen = arguments.only.split(",") if arguments.only else list(steps)
    for name in chosen:
        if name not in steps:
            sys.exit(f"error: no step {name}; there are {', '.join(steps)}")
    described = machine()
    for name in chosen:
        print(name, file=sys.stderr)
        steps[name]()
    table.print()
    print(f"\n`tests/bench/table.sh`, {described}.")


if __name__ == "__main__":
    main()
