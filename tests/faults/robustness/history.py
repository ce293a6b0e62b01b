"""What happened, in order."""

import json
import threading
import time


class History:
    """Everything asked, answered and done to the server, as JSON lines in a file; and what has failed."""

    def __init__(self, path):
        self.lock, self.events, self.file = threading.Lock(), [], open(path, "w")
        self.start, self.failures = time.monotonic(), []

    def add(self, actor, what, **more):
        event = {"s": round(time.monotonic() - self.start, 3), "actor": actor, "what": what, **more}
        with self.lock:
            self.events.append(event)
            self.file.write(json.dumps(event) + "\n")
            self.file.flush()

    def fail(self, why):
        self.failures.append(why)
        self.add("check", "FAILED", why=why)
        print(f"FAILED: {why}", flush=True)

    def count(self, **wanted):
        """How many events have these values."""
        return sum(1 for event in self.events
                   if all(event.get(name) == value for name, value in wanted.items()))
