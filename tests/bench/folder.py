#!/usr/bin/env python3
"""Measures `trc compensate … --output-dir` over a folder of small generated programs: in its own
processes, against one server and against two, a run that finds all unchanged, and one with other
wear. Prints a table.

folder.py [--programs N] [--jobs N] [--bin FOLDER]
"""
import argparse
import os
import pathlib
import random
import re
import signal
import socket
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SEED = 20


def write_programs(folder, count):
    """Pockets and outsides of 20 to 120 blocks with arcs; the lines in all of them."""
    rng = random.Random(SEED)
    lines = 0
    names = []
    for number in range(count):
        waves = rng.randrange(4, 28)
        pitch = rng.uniform(12, 30)
        height = rng.uniform(20, 80)
        text = [f"%P{number:05}", "N10 G90 G17 G00 X-20 Y-20",
                f"N20 D1 {rng.choice(('G41', 'G41', 'G42'))} G01 X0 Y0 F{rng.randrange(300, 1500)}",
                f"N30 Y{height:.3f}"]
        for wave in range(waves):
            text.append(f"G01 X{(wave + 0.5) * pitch:.3f} Y{height + rng.uniform(0, 2):.3f}")
            if rng.random() < 0.5:
                text.append(f"G02 X{(wave + 1) * pitch:.3f} Y{height:.3f} R{pitch:.3f}")
            else:
                text.append(f"G01 X{(wave + 1) * pitch:.3f} Y{height:.3f}")
        text += [f"G01 Y-{rng.uniform(15, 40):.3f}", "X-15", "G40 G01 X-40 Y-20", "M30", ""]
        name = folder / f"part{number:05}.nc"
        name.write_text("\n".join(text))
        names.append(str(name))
        lines += len(text) - 1
    return names, lines


def write_tools(folder, wear):
    """A table that every program takes its tool from."""
    tools = folder / f"tools{wear}.csv"
    tools.write_text(f"number,radius,wear\n1,4,{wear}\n")
    return str(tools)


class Servers:
    """So many at loopback ports, with one key."""

    def __init__(self, program, key, count):
        self.processes = []
        self.addresses = []
        for _ in range(count):
            with socket.socket() as probe:
                probe.bind(("127.0.0.1", 0))
                port = probe.getsockname()[1]
            self.addresses.append(f"127.0.0.1:{port}")
            self.processes.append(subprocess.Popen(
                [program, "--listen", self.addresses[-1], "--resume-key-file", key],
                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
            for _ in range(500):
                try:
                    socket.create_connection(("127.0.0.1", port)).close()
                    break
                except OSError:
                    time.sleep(0.02)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in self.processes:
            process.send_signal(signal.SIGTERM)
            process.wait()

    def used(self):
        """CPU seconds of all, and the most memory of one, MiB."""
        cpu, peak = 0.0, 0
        for process in self.processes:
            stat = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
            cpu += (int(stat[11]) + int(stat[12])) / os.sysconf("SC_CLK_TCK")
            status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
            peak = max(peak, int(re.search(r"VmHWM:\s*(\d+)", status)[1]) / 1024)
        return cpu, peak


def run(command, out):
    """Seconds, CPU seconds, memory of the largest process in MiB, what the table counts."""
    began = time.monotonic()
    with open(out, "w+", encoding="utf-8") as told:
        process = subprocess.Popen(command, stdout=told, stderr=subprocess.DEVNULL)
        _, _, used = os.wait4(process.pid, 0)
        seconds = time.monotonic() - began
        told.seek(0)
        lines = told.read().splitlines()
    blocks = sum(int(found[1]) for found in map(re.compile(r" (\d+) blocks").search, lines)
                 if found)
    return (seconds, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024, blocks,
            lines[-1] if lines else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--programs", type=int, default=10000)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--bin", default=str(ROOT / "build/bench/bin"))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        (scratch / "nc").mkdir()
        names, lines = write_programs(scratch / "nc", options.programs)
        print(f"{len(names)} programs, {lines} lines, seed {SEED}, {options.jobs} jobs\n")
        print("| Run | Time | Programs/s | Blocks out/s | CPU of `trc` | its memory | CPU of the "
              "servers | memory of one |")
        print("|---|---|---|---|---|---|---|---|")

        def measure(what, out, wear, servers=None):
            command = [options.bin + "/trc", "compensate", *names, "--tools",
                       write_tools(scratch, wear), "--output-dir", str(scratch / out), "--jobs",
                       str(options.jobs), "--server",
                       ",".join(servers.addresses) if servers else ""]
            before = servers.used()[0] if servers else 0
            seconds, cpu, memory, blocks, table = run(command, scratch / "table")
            assert table in (f"{len(names)} programs, {len(names)} {result}"
                             for result in ("done", "unchanged")), table
            of_servers = "– | –"
            if servers:
                used, peak = servers.used()
                of_servers = f"{used - before:.1f} s | {peak:.0f} MiB"
            print(f"| {what} | {seconds:.1f} s | {len(names) / seconds:.0f} | "
                  f"{blocks / seconds:.0f} | {cpu:.1f} s | {memory:.0f} MiB | "
                  f"{of_servers} |", flush=True)

        measure("in its own processes", "own", -0.01)
        measure("again, nothing changed", "own", -0.01)
        for count in (1, 2):
            with Servers(options.bin + "/trcd", str(scratch / "key"), count) as servers:
                measure(f"{count} server" + "s" * (count > 1), f"servers{count}", -0.01, servers)
        for name in os.listdir(scratch / "own"):
            if name.endswith(".nc"):
                made = {(scratch / out / name).read_bytes()
                        for out in ("own", "servers1", "servers2")}
                assert len(made) == 1, name + " differs from server to server"
        measure("in its own processes again, other wear", "own", -0.02)


if __name__ == "__main__":
    main()
