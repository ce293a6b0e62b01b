"""Programmed contours: what one is, and random ones a tool can follow corner by corner."""
import math

DIGITS = 6
RADII = (0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0)
ARC_SHARE = 0.34


def rounded(x, y):
    return round(x, DIGITS) + 0.0, round(y, DIGITS) + 0.0


class Contour:
    """Blocks ('line', end) or ('cw' | 'ccw', end, centre), with approach and retract target.

    The approach runs along the first block and the retract along the last one, unless told.
    """

    def __init__(self, name, plane, side, radius, start, blocks, retract=None):
        self.name, self.plane, self.side, self.radius = name, plane, side, radius
        self.start, self.blocks = start, blocks
        reach = 3 * radius + 1
        heading = self.tangents(0)[0]
        self.approach = rounded(start[0] - reach * math.cos(heading),
                                start[1] - reach * math.sin(heading))
        heading = self.tangents(len(blocks) - 1)[1]
        end = blocks[-1][1]
        self.retract = retract or rounded(end[0] + reach * math.cos(heading),
                                          end[1] + reach * math.sin(heading))

    def start_of(self, index):
        return self.blocks[index - 1][1] if index else self.start

    def tangents(self, index):
        """Headings at start and end of a block, rad."""
        block, start = self.blocks[index], self.start_of(index)
        end = block[1]
        if block[0] == 'line':
            heading = math.atan2(end[1] - start[1], end[0] - start[0])
            return heading, heading
        quarter = math.pi / 2 if block[0] == 'ccw' else -math.pi / 2
        centre = block[2]
        return (math.atan2(start[1] - centre[1], start[0] - centre[0]) + quarter,
                math.atan2(end[1] - centre[1], end[0] - centre[0]) + quarter)

    def turn_to_tool(self, index):
        """The turn after a block, rad; positive: an inside corner."""
        turn = self.tangents(index + 1)[0] - self.tangents(index)[1]
        turn = (turn + math.pi) % (2 * math.pi) - math.pi
        return turn if self.side == 'left' else -turn


def random_turn(rng):
    """A turn of every kind; none between 0.045 and 0.055 rad, where LinuxCNC changes its rule."""
    dice = rng.random()
    if dice < 0.10:
        return 0.0
    if dice < 0.22:
        return rng.choice((-1, 1)) * 10 ** rng.uniform(-4, math.log10(0.045))
    if dice < 0.30:
        return rng.choice((-1, 1)) * rng.uniform(0.055, 0.2)
    if dice < 0.62:
        return rng.uniform(0.2, 2.5)
    if dice < 0.94:
        return -rng.uniform(0.2, 2.5)
    return -rng.uniform(2.5, 3.05)


def trim(radius, turn):
    """What an inside corner of two lines takes off each of them."""
    return radius * math.tan(turn / 2) if turn > 0 else 0.0


def random_contour(rng, name):
    """Blocks long enough for what lines would lose at both corners; arcs may still not be."""
    plane = 'G17' if rng.random() < 0.6 else 'G18'
    side = rng.choice(('left', 'right'))
    radius = rng.choice(RADII)
    sense = 1 if side == 'left' else -1
    count = rng.randint(6, 16)
    turns = [random_turn(rng) for _ in range(count - 1)]
    start = position = rounded(rng.uniform(-50, 50), rng.uniform(-50, 50))
    heading = rng.uniform(-math.pi, math.pi)
    blocks = []
    for k in range(count):
        shortest = sum(trim(radius, turn) for turn in turns[max(k - 1, 0):k + 1])
        if rng.random() < ARC_SHARE:
            block, heading = random_arc(rng, position, heading, radius, sense, shortest)
        else:
            length = shortest + radius * rng.uniform(0.05, 4) + 0.1
            block = ('line', rounded(position[0] + length * math.cos(heading),
                                     position[1] + length * math.sin(heading)))
        blocks.append(block)
        position = block[1]
        if k < count - 1:
            heading += sense * turns[k]
    return Contour(name, plane, side, radius, start, blocks)


def random_arc(rng, position, heading, radius, sense, shortest):
    """An arc that leaves along `heading`, and the heading at its end."""
    around_tool = rng.random() < 0.5
    bend = sense if around_tool else -sense
    r = radius * (rng.uniform(1.15, 8) if around_tool else rng.uniform(0.3, 8))
    kept = r - radius if around_tool else r + radius
    sweep = min((1.4 * shortest + radius * rng.uniform(0.1, 4)) / kept, rng.uniform(2.0, 4.5))
    normal = heading + bend * math.pi / 2
    centre = rounded(position[0] + r * math.cos(normal), position[1] + r * math.sin(normal))
    spoke = math.atan2(position[1] - centre[1], position[0] - centre[0]) + bend * sweep
    r = math.hypot(position[0] - centre[0], position[1] - centre[1])
    end = rounded(centre[0] + r * math.cos(spoke), centre[1] + r * math.sin(spoke))
    return ('ccw' if bend > 0 else 'cw', end, centre), heading + bend * sweep
