#!/usr/bin/env python3
"""Runs LinuxCNC's rs274 on the LinuxCNC programs of tests/programs/dialects, and on what trc makes
of them: both are the same path, but for the moves to the contour and from it.

    programs.py TRC [RS274]      1: they differ by more than is explained below; 77: no rs274

An end of a motion that only one of them has is one point. LinuxCNC treats the corner after its
entry move as a corner of the contour, and rounds the end of the last block towards the exit; G138,
which trc follows there, ends and begins in the perpendicular point.
"""

import difflib
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAMS = pathlib.Path(__file__).resolve().parents[2] / 'programs' / 'dialects' / 'linuxcnc'

# What only LinuxCNC's path has, what only trc's has, and why.
ENTRY = 'the entry move'
EXPLAINED = {
    'absolute_centres': ((1, 1), ENTRY),
    'cam_profile_with_g41_1': ((1, 1), ENTRY),
    'cam_profile_with_k': (('executing K word given for arc in xy plane '
                            'G2 X10.000 Y50.000 I10.000 J0.000 K0.000', ''),
                           'K0 is a word of many post processors'),
    'cam_semicolon_comments': ((1, 1), ENTRY),
    'diameter_word': ((1, 1), ENTRY),
    'drilling_first': ((2, 2), 'the entry move, and Z after a bare G40'),
    'plane_behind_a_bare_g40': ((3, 2), 'the entry move, and the retract in space'),
    'spindles_and_m61': ((6, 8), 'rs274 alone does not load the tool of M61'),
    'tool_of_the_spindle': ((1, 1), ENTRY),
    'tool_zero_is_no_radius': ((1, 1), ENTRY),
}


def tools_of(program):
    """Number and radius, mm, as the head of the program says; one radius stands for all."""
    tools, radius = {}, None
    for line in program.splitlines():
        words = line.split()
        if line.startswith('; tool '):
            tools[int(words[2])] = float(words[3])
        if line.startswith('; radius '):
            radius = float(words[2]) * (25.4 if words[-1] == 'in' else 1)
    for number in {int(n) for n in re.findall(r'(?i)[td] *0*([1-9]\d*)\b', program)} | {1}:
        if radius is not None:
            tools.setdefault(number, radius)
    return tools


def without_head(program):
    return re.sub(r'\A(; (tool|radius|path)\b.*\n)+', '', program)


def path(rs274, folder, program):
    """The ends of the motions in the plane, or what LinuxCNC says against it."""
    (folder / 'program.ngc').write_text(program, encoding='latin-1')
    (folder / 'tool.var').write_text('')
    run = subprocess.run([rs274, '-g', '-t', folder / 'tool.tbl', '-v', folder / 'tool.var',
                          folder / 'program.ngc'], capture_output=True, text=True, timeout=60,
                         check=False)
    ends, before, unit = [], None, 1
    for line in run.stdout.splitlines():
        found = re.match(r'\s*\d+ N\S*\s+(\w+)\((.*)\)', line)
        if not found:
            continue
        name, words = found[1], [word.strip() for word in found[2].split(',')]
        if name == 'USE_LENGTH_UNITS':
            unit = 25.4 if 'INCH' in words[0] else 1
        if name in ('STRAIGHT_FEED', 'STRAIGHT_TRAVERSE'):
            end = tuple(float(word) for word in words[0:3])
        elif name == 'ARC_FEED':  # the plane X Y
            end = (float(words[0]), float(words[1]), float(words[5]))
        else:
            continue
        end = tuple(round(unit * value, 3) + 0.0 for value in end)
        if end != before:
            ends.append(end)
        before = end
    fault = [line for line in run.stderr.splitlines() if line and 'variable file' not in line]
    return ends, ' '.join(fault) if run.returncode else ''


def near(a, b):
    return max(abs(x - y) for x, y in zip(a, b)) < 2.5e-3


def only_in(theirs, ours):
    """The ends that one of the two has, in their order: rounded alike where they are near."""
    known = []

    def name(end):
        for index, other in enumerate(known):
            if near(end, other):
                return index
        known.append(end)
        return len(known) - 1

    a, b = [name(end) for end in theirs], [name(end) for end in ours]
    left, right = [], []
    for kind, a0, a1, b0, b1 in difflib.SequenceMatcher(None, a, b, False).get_opcodes():
        if kind != 'equal':
            left += theirs[a0:a1]
            right += ours[b0:b1]
    return left, right


def main():
    trc = sys.argv[1]
    rs274 = sys.argv[2] if len(sys.argv) > 2 else shutil.which('rs274')
    if rs274 is None:
        print('skipped: no rs274 here (package linuxcnc-uspace)')
        return 77
    wrong = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for file in sorted(PROGRAMS.glob('*.nc')):
            program = file.read_text(encoding='latin-1')
            if '; refused' in program:
                continue
            tools = tools_of(program)
            # rs274 alone takes the table for one in inch.
            (folder / 'tool.tbl').write_text(''.join(
                f'T{n} P{n} D{2 * r / 25.4:.9f}\n' for n, r in sorted(tools.items())))
            table = ','.join(f'{n}:{r}' for n, r in tools.items())
            run = subprocess.run([trc, 'compensate', file, '--dialect', 'linuxcnc', '-q', '--set',
                                  'tools=' + table], capture_output=True, text=True,
                                 encoding='latin-1', check=False)
            if run.returncode != 0:
                print(f'{file.stem}: trc: {run.stderr}')
                wrong += 1
                continue
            theirs, fault = path(rs274, folder, without_head(program))
            ours, our_fault = path(rs274, folder, without_head(run.stdout))
            left, right = only_in(theirs, ours)
            said = (len(left), len(right)) if not (fault or our_fault) else (fault, our_fault)
            expected = EXPLAINED.get(file.stem, ((0, 0), ''))
            if said != expected[0]:
                wrong += 1
                print(f'{file.stem}: {said}, expected {expected[0]}')
                print(f'  only LinuxCNC: {left}\n  only trc: {right}')
            else:
                print(f'{file.stem}: {len(ours)} ends, alone {said} {expected[1]}')
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
