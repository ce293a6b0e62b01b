"""Programs to be compensated, and what `trc` makes of them without a server."""

import os
import subprocess

RADII = "0.3,0.5,1"


def program(rng, kind, shorter):
    """A contour as a program: plain, masked as a whole, with a mistake, or with more than there is room
    for. `shorter`: so many times, but for the last kind."""
    turns = {"plain": rng.randint(5, 4000 // shorter), "masked": rng.randint(5, 8000 // shorter),
             "huge": 120000, "mistake": rng.randint(5, 500)}[kind]
    lines = ["G141"] if kind in ("masked", "huge") else []
    lines.append("N5 G1 G41 V.G.WZ_AKT.R=0.5 X0 Y10 F800")
    for turn in range(turns):
        x, y = 20 * (turn % 4000), 10 + turn * 7 % 11
        lines += [f"G1 X{x + 5} Y{y}", f"X{x + 10}", f"G2 X{x + 16} I3 J0", "M8"]
        if turn % 4000 == 3999:
            lines += ["G1 Y200", "X-50", "Y10"]
    if kind == "mistake":
        lines.append("G2 X0 Y0 I1 J1")
    return "\n".join(lines + ["G40", "G1 X0 Y-100", "M30", ""])


class Case:
    """A program in a file; `alone`: exit code and output of `trc` by itself, for each of its commands.
    Nothing is known of what is too large for the server."""

    COMMANDS = {"compensate": [], "verify": [], "radii": ["--radii", RADII]}

    def __init__(self, trc, folder, number, kind, rng, shorter):
        self.kind, self.source, self.alone = kind, os.path.join(folder, f"case{number}.nc"), {}
        with open(self.source, "w") as file:
            file.write(program(rng, kind, shorter))
        if kind == "huge":
            return
        for command, options in self.COMMANDS.items():
            local = subprocess.run([trc, command, self.source, *options], capture_output=True, timeout=300)
            self.alone[command] = (local.returncode, local.stdout)

    def line(self, trc, command, port, ca):
        """The command line that asks a server."""
        return [trc, command, self.source, *self.COMMANDS[command], "--server", f"127.0.0.1:{port}",
                "--tls-ca", ca]


def make_cases(trc, folder, rng, shorter):
    kinds = ["plain"] * 4 + ["masked"] * 3 + ["mistake"] + ["huge"]
    return [Case(trc, folder, number, kind, rng, shorter) for number, kind in enumerate(kinds)]
