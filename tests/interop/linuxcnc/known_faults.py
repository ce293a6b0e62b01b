"""The contours behind known_faults.txt: small, written by hand, one question each."""
import math

from contours import Contour, rounded


def lines(*points):
    return [('line', rounded(*point)) for point in points]


def polyline(count, length, turn):
    """Lines from (0, 0) that turn by `turn` rad at every vertex."""
    position, blocks = (0.0, 0.0), []
    for k in range(count):
        position = rounded(position[0] + length * math.cos(k * turn),
                           position[1] + length * math.sin(k * turn))
        blocks.append(('line', position))
    return blocks


def arc_in_a_bend(kink):
    """A line, a kink away from the tool, an arc of 6 mm around the tool, an outside corner."""
    start, radius, sweep = (20.0, 0.0), 6.0, 0.8
    centre = rounded(start[0] + radius * math.sin(kink), start[1] + radius * math.cos(kink))
    heading = sweep - kink
    end = rounded(centre[0] + radius * math.sin(heading), centre[1] - radius * math.cos(heading))
    last = rounded(end[0] + 20 * math.cos(heading - 0.3), end[1] + 20 * math.sin(heading - 0.3))
    return [('line', start), ('ccw', end, centre), ('line', last)]


def left(name, radius, start, blocks, retract=None):
    return Contour(name, 'G17', 'left', radius, start, blocks, retract=retract)


KNOWN_FAULTS = [
    ('Two pockets of 40 mm joined by a neck of 4 mm: locally fine, too narrow for the tool.',
     left('keyhole', 3, (20, 0),
          lines((40, 0), (40, 18), (60, 18), (60, 0), (100, 0), (100, 40), (60, 40), (60, 22),
                (40, 22), (40, 40), (0, 40), (0, 0), (20, 0)))),
    ('Inside corner with a chamfer of 1 mm, far too small for the tool.',
     left('chamfer', 5, (0, 0), lines((30, 0), (31, 1), (31, 30)))),
    ('Inside corner with a fillet of 0.5 mm, smaller than the tool.',
     left('fillet', 5, (0, 0),
          [('line', (29.5, 0)), ('ccw', (30, 0.5), (29.5, 0.5)), ('line', (30, 30))])),
    ('Inside corner with a bead of 0.5 mm that the tool cannot follow.',
     left('bead', 5, (0, 0),
          [('line', (29.5, 0)), ('cw', (30, 0.5), (30, 0)), ('line', (30, 30))])),
    ('Inside polyline that turns by 0.049 rad at each vertex.',
     left('inside_polyline', 10, (0, 0), polyline(24, 2, 0.049))),
    ('Outside polyline that turns by 0.04 rad at each vertex.',
     left('outside_polyline', 10, (0, 0), polyline(24, 2, -0.04))),
    ('Outside kink of 0.04 rad, inside arc of 6 mm, outside corner.',
     left('kink_before_arc', 5, (0, 0), arc_in_a_bend(0.04))),
    ('The same contour without the kink.',
     left('no_kink_before_arc', 5, (0, 0), arc_in_a_bend(0.0))),
    ('Exact reversal of two lines: the tip of a thin wall.',
     left('cusp_of_lines', 5, (0, 0), lines((30, 0), (5, 0)))),
    ('Exact reversal into an arc that bends away from the tool: a tip.',
     left('cusp_outside', 5, (0, 0), [('line', (30, 0)), ('ccw', (20, -10), (30, -10))])),
    ('Exact reversal into an arc that bends towards the tool: a slit.',
     left('cusp_inside', 5, (0, 0), [('line', (30, 0)), ('cw', (20, 10), (30, 10))])),
    ('A block shorter than its trim, followed by one in the same direction.',
     left('short_block', 5, (-20, 0), lines((0, 0), (0, 2), (0, 22)))),
    ('After G40 straight through the contour.',
     left('exit_through_contour', 5, (0, 0), lines((0, 30), (30, 30), (30, 0), (10, 0)),
          retract=(20, 40))),
    ('After G40 a move of 5 mm straight at the contour, to 0.1 mm from it.',
     left('exit_at_contour', 5, (0, 0), lines((0, 30), (30, 30)), retract=(30.1, 30))),
]
