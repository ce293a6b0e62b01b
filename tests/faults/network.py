#!/usr/bin/env python3
"""A client and a server, each in a network namespace of its own, with a wire between them that
delays, loses and cuts: the output is that of a network without faults.

    network.py TRCD TRC FAULT_CLIENT

The wire connects two TUN devices; it needs no module of the kernel but that one. Exit code 77 where
namespaces or TUN devices are not allowed.
"""

import array
import ctypes
import fcntl
import heapq
import os
import random
import select
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

CLONE_NEWUSER, CLONE_NEWNET = 0x10000000, 0x40000000
TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000
SERVER, CLIENT = "10.77.0.1", "10.77.0.2"
SKIPPED = 77


def enter_namespace():
    """Root needs no user namespace, and may not make one where it lives in a chroot."""
    libc = ctypes.CDLL(None, use_errno=True)
    uid, gid = os.getuid(), os.getgid()
    flags = CLONE_NEWNET | (CLONE_NEWUSER if uid != 0 else 0)
    if libc.unshare(flags) != 0:
        raise OSError(ctypes.get_errno(), "unshare")
    if uid != 0:
        for name, text in (("setgroups", "deny"), ("uid_map", f"0 {uid} 1"), ("gid_map", f"0 {gid} 1")):
            with open(f"/proc/self/{name}", "w") as file:
                file.write(text)


def open_end(address, peer):
    """A TUN device of a new namespace; its packets are read from the descriptor."""
    tun = os.open("/dev/net/tun", os.O_RDWR)
    fcntl.ioctl(tun, TUNSETIFF, struct.pack("16sH", b"wire", IFF_TUN | IFF_NO_PI))
    for command in (
        ["ip", "addr", "add", address, "peer", peer, "dev", "wire"],
        ["ip", "link", "set", "wire", "up"],
        ["ip", "link", "set", "lo", "up"],
    ):
        subprocess.run(command, check=True)
    return tun


def run_end(address, peer, channel, command):
    """Becomes `command` in a namespace whose end of the wire is sent through `channel`."""
    try:
        enter_namespace()
        tun = open_end(address, peer)
    except OSError as fault:
        print(f"no network namespace here: {fault}", file=sys.stderr)
        sys.exit(SKIPPED)
    with socket.socket(fileno=channel) as pipe:
        pipe.sendmsg([b"t"], [(socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", [tun]))])
    os.execv(command[0], command)


class Wire(threading.Thread):
    """Carries packets between two descriptors, in order in each direction."""

    def __init__(self, ends, delay_s, loss, seed):
        super().__init__(daemon=True)
        self.ends, self.delay_s, self.loss = ends, delay_s, loss
        self.random = random.Random(seed)
        self.cut = False
        self.stopped = False
        self.lost = 0
        self.carried = 0

    def run(self):
        under_way, count = [], 0
        while not self.stopped:
            wait = 0.1
            if under_way:
                wait = min(wait, max(0.0, under_way[0][0] - time.monotonic()))
            for end in select.select(self.ends, [], [], wait)[0]:
                packet = os.read(end, 65536)
                if self.cut or self.random.random() < self.loss:
                    self.lost += 1
                    continue
                count += 1
                other = self.ends[1] if end == self.ends[0] else self.ends[0]
                heapq.heappush(under_way, (time.monotonic() + self.delay_s, count, other, packet))
            while under_way and under_way[0][0] <= time.monotonic():
                _, _, other, packet = heapq.heappop(under_way)
                self.carried += 1
                try:
                    os.write(other, packet)
                except OSError:
                    pass  # That end has gone.


class Net:
    """A server and what runs against it."""

    def __init__(self, folder, trcd, **wire):
        self.folder, self.processes, self.ends = folder, [], []
        self.log = open(os.path.join(folder, "log"), "w+")
        self.start(SERVER, CLIENT, self.log,
                   [trcd, "--listen", f"{SERVER}:50051", "--insecure", "--keepalive-time-s", "2",
                    "--keepalive-timeout-s", "2", "--min-client-ping-interval-s", "1"])
        self.wire_settings = wire
        self.wait_for_server()

    def wait_for_server(self):
        """A client that comes before it listens is refused, and gives up."""
        end = time.monotonic() + 30
        while time.monotonic() < end:
            with open(self.log.name) as log:
                if '"event":"started"' in log.read():
                    return
            time.sleep(0.01)
        sys.exit("the server did not start")

    def start(self, address, peer, output, command):
        ours, theirs = socket.socketpair()
        process = subprocess.Popen(
            [sys.executable, __file__, "--end", address, peer, str(theirs.fileno())] + command,
            pass_fds=[theirs.fileno()], stdout=output, stderr=subprocess.PIPE)
        self.processes.append(process)
        theirs.close()
        with ours:
            data, ancillary, _, _ = ours.recvmsg(1, socket.CMSG_SPACE(4))
        if not data:
            sys.stderr.write(process.stderr.read().decode())
            sys.exit(process.wait())
        self.ends.append(array.array("i", ancillary[0][2])[0])
        return process

    def client(self, command):
        process = self.start(CLIENT, SERVER, subprocess.PIPE, command)
        self.wire = Wire(self.ends, **self.wire_settings)
        self.wire.start()
        return process

    def close(self):
        self.wire.stopped = True
        self.wire.join()
        for process in self.processes:
            process.kill()
            process.wait()
        for end in self.ends:
            os.close(end)


def program(turns):
    lines = ["N5 G1 G41 V.G.WZ_AKT.R=0.5 X0 Y10 F800"]
    for turn in range(turns):
        x, y = 20 * turn, 10 + turn * 7 % 11
        lines += [f"G1 X{x + 5} Y{y}", f"X{x + 10}", f"G2 X{x + 16} I3 J0", "M8"]
    return "\n".join(lines + ["G40", "G1 X0 Y-100", "M30", ""])


def check(name, programs, disturb, pause_ms, **wire):
    trcd, trc, fault_client = programs
    with tempfile.TemporaryDirectory() as folder:
        source, output = os.path.join(folder, "program.nc"), os.path.join(folder, "out.nc")
        with open(source, "w") as file:
            file.write(program(2500))
        expected = subprocess.run([trc, "compensate", source], check=True, capture_output=True).stdout
        net = Net(folder, trcd, **wire)
        try:
            client = net.client(
                [fault_client, f"{SERVER}:50051", source, output, str(pause_ms), "1500"])
            client.stdout.readline()  # It has begun.
            disturb(net.wire)
            said, fault = client.communicate(timeout=90)
        finally:
            net.close()
        with open(output, "rb") as file:
            same = file.read() == expected
        print(f"{name}: exit {client.returncode}, {said.decode().strip()}, {net.wire.carried} packets "
              f"carried, {net.wire.lost} lost, output {'the same' if same else 'DIFFERENT'}")
        if client.returncode != 0 or not same:
            sys.exit(f"{name} failed: {fault.decode()}")
        return int(said.decode().split()[-1]), net.wire.lost


def cut_for(seconds):
    def disturb(wire):
        time.sleep(0.3)
        wire.cut = True
        time.sleep(seconds)
        wire.cut = False

    return disturb


def main():
    programs = [os.path.abspath(path) for path in sys.argv[1:4]]
    _, lost = check("delay and loss", programs, lambda wire: None, 0, delay_s=0.05, loss=0.02, seed=1)
    if lost == 0:
        sys.exit("nothing was lost: this was no test")
    # Shorter than the keepalive: TCP itself carries on.
    check("short partition", programs, cut_for(1), 10, delay_s=0, loss=0, seed=2)
    # Longer: the stream is given up on both sides and resumed.
    resumed, _ = check("long partition", programs, cut_for(6), 30, delay_s=0, loss=0, seed=3)
    if resumed == 0:
        sys.exit("the stream outlived the partition: this was no test")


if __name__ == "__main__":
    if sys.argv[1] == "--end":
        run_end(sys.argv[2], sys.argv[3], int(sys.argv[4]), sys.argv[5:])
    else:
        main()
