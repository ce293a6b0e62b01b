"""Connections on their way to the server."""

import select
import socket
import threading
import time


class Proxy(threading.Thread):
    """Carries connections to the server. `mode`: pass, slow (little at a time), hold (nothing moves)
    or cut (connections are reset, new ones too)."""

    def __init__(self, target):
        super().__init__(daemon=True)
        self.target, self.mode, self.stopped = target, "pass", False
        self.listener = socket.create_server(("127.0.0.1", 0), backlog=128)
        self.port = self.listener.getsockname()[1]
        self.pairs = {}

    def close(self, end):
        other = self.pairs.pop(end, None)
        if other is not None:
            self.pairs.pop(other, None)
            other.close()
        end.close()

    def accept(self):
        ours, _ = self.listener.accept()
        if self.mode == "cut":
            ours.close()
            return
        try:
            theirs = socket.create_connection(("127.0.0.1", self.target), timeout=1)
        except OSError:
            ours.close()
            return
        self.pairs[ours], self.pairs[theirs] = theirs, ours

    def carry(self, end):
        other = self.pairs.get(end)
        if other is None:
            return
        try:
            data = end.recv(512 if self.mode == "slow" else 65536)
            if data:
                other.settimeout(5)
                other.sendall(data)
                return
        except OSError:
            pass
        self.close(end)

    def run(self):
        while not self.stopped:
            if self.mode == "cut":
                for end in list(self.pairs):
                    self.close(end)
            if self.mode == "hold":
                time.sleep(0.05)
                continue
            if self.mode == "slow":
                time.sleep(0.01)
            try:
                ready, _, _ = select.select([self.listener, *self.pairs], [], [], 0.05)
            except (OSError, ValueError):
                self.pairs = {a: b for a, b in self.pairs.items() if a.fileno() >= 0 and b.fileno() >= 0}
                continue
            for end in ready:
                if end is self.listener:
                    self.accept()
                elif end in self.pairs:
                    self.carry(end)
