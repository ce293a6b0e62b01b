"""Connections on their way to the server."""

import socket
import threading
import time


class Proxy(threading.Thread):
    """Carries connections to the server. `mode`: pass, slow (little at a time), hold (nothing moves)
    or cut (connections are lost, new ones too)."""

    def __init__(self, target):
        super().__init__(daemon=True)
        self.target, self.mode, self.stopped = target, "pass", False
        self.listener = socket.create_server(("127.0.0.1", 0), backlog=128)
        self.listener.settimeout(0.1)
        self.port = self.listener.getsockname()[1]

    def run(self):
        while not self.stopped:
            try:
                ours, _ = self.listener.accept()
                ours.settimeout(None)
                threading.Thread(target=self.carry_both_ways, args=(ours,), daemon=True).start()
            except TimeoutError:
                pass

    def carry_both_ways(self, ours):
        self.wait_while_held()
        try:
            with ours, socket.create_connection(("127.0.0.1", self.target), timeout=1) as theirs:
                theirs.settimeout(None)
                back = threading.Thread(target=self.carry, args=(theirs, ours), daemon=True)
                back.start()
                self.carry(ours, theirs)
                back.join()
        except OSError:
            pass  # Nobody is there.

    def carry(self, source, sink):
        """Until one of the two has gone, which is the end of the other one as well."""
        source.settimeout(0.1)
        try:
            while self.mode != "cut":
                self.wait_while_held()
                try:
                    data = source.recv(512 if self.mode == "slow" else 65536)
                except TimeoutError:
                    continue
                if not data:
                    break
                if self.mode == "slow":
                    time.sleep(0.01)
                self.wait_while_held()
                self.send(sink, data)
        except OSError:
            pass
        for end in (source, sink):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def send(self, sink, data):
        """However long the other side takes."""
        left = memoryview(data)
        while left and self.mode != "cut":
            try:
                left = left[sink.send(left):]
            except TimeoutError:
                pass

    def wait_while_held(self):
        while self.mode == "hold" and not self.stopped:
            time.sleep(0.05)
