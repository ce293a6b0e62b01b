#!/usr/bin/env python3
"""Lets LinuxCNC compensate contours of ours and keeps its answers.

    make_vectors.py [--seed N] [--walks N] [--folder F]

writes vectors.txt and known_faults.txt; the same numbers give the same files.
Needs the program rs274 (Debian package linuxcnc-uspace) and the standard library
alone. The tests read the two files and need neither.

Of all random walks the first --accepted ones that LinuxCNC accepts are kept, the
first --refused ones that it refuses, and every one that meets a fault.

One contour in a file, mm in the compensation plane (G17: X Y, G18: Z X), circle
centres absolute:

    contour <name> <plane> <side> <tool radius>
    approach <x> <y>                            start of the approach block
    start <x> <y>                               its end: the contour begins
    line <x> <y>                                the programmed blocks
    cw <x> <y> <centre x> <centre y>
    ccw <x> <y> <centre x> <centre y>
    retract <x> <y>                             end of the block after G40
    path <x> <y>                                start of the first compensated block
    line … cw … ccw …                           what LinuxCNC made of the contour
    exit <x> <y>                                where it went after G40
    refused <message>                           instead of path and exit
    fault <name> <contour block>                where LinuxCNC is wrong, see README.md
    end
"""
import argparse
import math
import pathlib
import random
import subprocess
import tempfile

from contours import DIGITS, random_contour
from known_faults import KNOWN_FAULTS

# LinuxCNC leaves a corner below this alone, rad; a constant in its source.
THRESHOLD = 0.05
# LinuxCNC calls an arc gouged when its sweep grows by more than this many rad.
LARGEST_GROWTH = 0.0254


def number(value):
    text = ('%.*f' % (DIGITS, value)).rstrip('0').rstrip('.')
    return '0' if text in ('-0', '') else text


def program(contour):
    """The contour as a LinuxCNC program. The line of block k has the index 5 + k."""
    axes, offsets = ('XY', 'IJ') if contour.plane == 'G17' else ('ZX', 'KI')

    def at(point):
        return ' '.join(axis + number(value) for axis, value in zip(axes, point))

    select = 'G41.1' if contour.side == 'left' else 'G42.1'
    lines = ['G21 %s G90 G91.1 G64 G40' % contour.plane, 'F1000', 'G0 ' + at(contour.approach),
             '%s D%s' % (select, number(2 * contour.radius)), 'G1 ' + at(contour.start)]
    for k, block in enumerate(contour.blocks):
        text = {'line': 'G1 ', 'cw': 'G2 ', 'ccw': 'G3 '}[block[0]] + at(block[1])
        if block[0] != 'line':
            text += ''.join(' ' + word + number(centre - start) for word, centre, start
                            in zip(offsets, block[2], contour.start_of(k)))
        lines.append(text)
    return lines + ['G40', 'G1 ' + at(contour.retract), 'M2']


class Answer:
    """What LinuxCNC did: the blocks from the end of its entry on, or a message and its place."""

    def __init__(self, contour):
        lines = program(contour)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / 'contour.ngc'
            path.write_text('\n'.join(lines) + '\n')
            done = subprocess.run(['rs274', '-g', str(path)], capture_output=True, text=True,
                                  timeout=60, check=False)
        self.blocks, self.exit, self.message, self.block_read = [], None, None, None
        if done.returncode == 0:
            self.read_calls(done.stdout, contour.plane)
            return
        said = [line for line in done.stderr.splitlines() if line not in ('', 'executing')]
        self.message = said[0]
        self.block_read = lines.index(said[1].strip()) - 5

    def read_calls(self, text, plane):
        active = None
        for line in text.splitlines():
            name, _, rest = line.split(None, 2)[2].partition('(')
            words = [word.strip() for word in rest.rstrip(')').split(',')]
            if name == 'COMMENT' and 'compensation on' in line:
                active = True
            elif name == 'COMMENT' and 'compensation off' in line and active:
                active = False
            elif name == 'STRAIGHT_FEED' and active is not None:
                end = words[0:2] if plane == 'G17' else [words[2], words[0]]
                if active:
                    self.blocks.append(('line', end))
                elif self.exit is None:
                    self.exit = end
            elif name == 'ARC_FEED' and active:
                kind = 'ccw' if int(words[4]) > 0 else 'cw'
                self.blocks.append((kind, words[0:2], words[2:4]))


def fault_of(contour, answer):
    """Name and contour block (1-based) of a fault of LinuxCNC's, or None."""
    if answer.message is None:
        return reversed_line(contour, answer)
    if answer.message.startswith('Arc move in concave corner'):
        return false_gouge(contour, answer)
    return None


def reversed_line(contour, answer):
    """A line that runs against its programmed direction: accepted, and cuts too deep."""
    seat, position = 0, [float(w) for w in answer.blocks[0][1]]
    for k in range(len(contour.blocks)):
        seat += 1
        end = [float(w) for w in answer.blocks[seat][1]]
        if contour.blocks[k][0] == 'line':
            heading = contour.tangents(k)[0]
            along = ((end[0] - position[0]) * math.cos(heading)
                     + (end[1] - position[1]) * math.sin(heading))
            if along < -2e-4:
                return 'reversed_line', k + 1
        position = end
        if k + 1 < len(contour.blocks) and contour.turn_to_tool(k) < -THRESHOLD:
            seat += 1
            position = [float(w) for w in answer.blocks[seat][1]]
    return None


def false_gouge(contour, answer):
    """The arc before the block being read is refused for the corner that was left alone before it."""
    k = answer.block_read - 1
    if k < 1 or contour.blocks[k][0] != ('ccw' if contour.side == 'left' else 'cw'):
        return None
    turn = contour.turn_to_tool(k - 1)
    radius = math.dist(contour.start_of(k), contour.blocks[k][2])
    if -THRESHOLD < turn < 0 and -turn * contour.radius / (radius - contour.radius) > LARGEST_GROWTH:
        return 'false_gouge', k + 1
    return None


def pair(point):
    return ' '.join(number(float(word)) for word in point)


def block_text(block):
    return ' '.join([block[0]] + [pair(point) for point in block[1:]])


def text_of(contour, answer, fault):
    lines = ['contour %s %s %s %s' % (contour.name, contour.plane, contour.side,
                                      number(contour.radius)),
             'approach ' + pair(contour.approach), 'start ' + pair(contour.start)]
    lines += [block_text(block) for block in contour.blocks]
    lines.append('retract ' + pair(contour.retract))
    if answer.message is not None:
        lines.append('refused ' + answer.message)
    else:
        lines.append('path ' + pair(answer.blocks[0][1]))
        lines += [block_text(block) for block in answer.blocks[1:]]
        lines.append('exit ' + pair(answer.exit))
    if fault:
        lines.append('fault %s %d' % fault)
    return '\n'.join(lines + ['end', ''])


def random_vectors(options):
    rng = random.Random(options.seed)
    accepted = refused = 0
    for walk in range(1, options.walks + 1):
        contour = random_contour(rng, str(walk))
        answer = Answer(contour)
        fault = fault_of(contour, answer)
        if fault:
            keep = True
        elif answer.message is None:
            accepted += 1
            keep = accepted <= options.accepted
        else:
            refused += 1
            keep = refused <= options.refused
        if keep:
            yield text_of(contour, answer, fault)
    print('%d walks: %d accepted, %d refused, %d with a fault'
          % (options.walks, accepted, refused, options.walks - accepted - refused))


def main():
    here = pathlib.Path(__file__).parent
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--seed', type=int, default=20261121)
    parser.add_argument('--walks', type=int, default=4000)
    parser.add_argument('--accepted', type=int, default=300)
    parser.add_argument('--refused', type=int, default=60)
    parser.add_argument('--folder', type=pathlib.Path, default=here)
    options = parser.parse_args()
    note = '# Made by make_vectors.py; LinuxCNC is the package linuxcnc-uspace of Debian 12.\n'
    known = ['# %s\n%s' % (sentence, text_of(contour, Answer(contour), None))
             for sentence, contour in KNOWN_FAULTS]
    (options.folder / 'known_faults.txt').write_text(note + ''.join(known))
    (options.folder / 'vectors.txt').write_text(note + ''.join(random_vectors(options)))


if __name__ == '__main__':
    main()
