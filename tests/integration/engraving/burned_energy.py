"""The energy that a laser gave to each pixel of raster.gcode, by the steps and the changes of the laser in a log.

It shares no code with Lockstep: only the record's messages, and the picture of make_raster.py.
"""
import bisect
from itertools import pairwise

import make_raster
import read_log
from lockstep import channel_event_t, step_batch_t

FULL_SCALE = 1 << 62
STEPS_PER_MM = 80
TICKS_PER_S = 1_000_000


class Motion:
    """The position of an axis over time: halfway between two counts at each step, and straight between steps."""

    def __init__(self, log, axis):
        batches = [m for m in log if isinstance(m, step_batch_t) and m.axis == axis]
        self.ticks, self.places = [], []
        for batch in sorted(batches, key=lambda m: m.sequence):
            count = batch.position_before
            for tick, direction in zip(read_log.step_ticks(batch), batch.direction):
                self.ticks.append(tick)
                self.places.append((count + direction / 2) / STEPS_PER_MM)
                count += direction

    def at(self, tick):
        i = bisect.bisect_right(self.ticks, tick)
        if i in (0, len(self.ticks)):
            return self.places[max(i - 1, 0)]
        begin, end = self.ticks[i - 1 : i + 1]
        share = (tick - begin) / (end - begin)
        return self.places[i - 1] + share * (self.places[i] - self.places[i - 1])

    def knots(self, begin, end):
        """The times of steps between two times."""
        return self.ticks[bisect.bisect_right(self.ticks, begin) : bisect.bisect_left(self.ticks, end)]


def powers(log, axis):
    """(tick, next tick, share at the first, slope for each tick) from each change of the laser to the next."""
    changes = sorted((m for m in log if isinstance(m, channel_event_t) and m.axis == axis), key=lambda m: m.sequence)
    assert [m.sequence for m in changes] == list(range(len(changes))), "changes are missing from the log"
    analog = [m for m in changes if m.kind == "analog"]
    return [(m.tick, after.tick, m.value / FULL_SCALE, m.detail / FULL_SCALE) for m, after in pairwise(analog)]


def crossings(x, begin, end):
    """The time divided where the axis passes from one pixel to the next: [(begin, end)]."""
    cuts = {begin, end}
    for left, right in pairwise([begin, *x.knots(begin, end), end]):
        a, b = ((x.at(t) - make_raster.LEFT_MM) / make_raster.PIXEL_MM for t in (left, right))
        for edge in range(int(min(a, b)) - 1, int(max(a, b)) + 2):
            if min(a, b) < edge < max(a, b):
                cuts.add(left + (edge - a) / (b - a) * (right - left))
    return pairwise(sorted(cuts))


def energies(path):
    """{(column, row): seconds of full power}, and the seconds of full power outside of the picture and its rows."""
    log = list(read_log.messages(path))
    x, y = Motion(log, "X"), Motion(log, "Y")
    found, outside = {}, 0.0
    for begin, end, share, slope in powers(log, "X"):
        if share == 0 and slope == 0:
            continue
        for left, right in crossings(x, begin, end):
            middle = (left + right) / 2
            power = min(1.0, max(0.0, share + slope * (middle - begin)))  # the mean, as it changes evenly
            energy = power * (right - left) / TICKS_PER_S
            column = (x.at(middle) - make_raster.LEFT_MM) / make_raster.PIXEL_MM
            row = (y.at(middle) - make_raster.BOTTOM_MM) / make_raster.PIXEL_MM
            is_on_a_row = abs(row - int(row) - 0.5) * make_raster.PIXEL_MM * STEPS_PER_MM < 0.6
            pixel = (int(column), int(row))
            if is_on_a_row and 0 <= column < make_raster.WIDTH and 0 <= row < make_raster.HEIGHT:
                found[pixel] = found.get(pixel, 0) + energy
            else:
                outside += energy
    return found, outside


def worst_pixel(path, feed_mm_min=make_raster.FEED_MM_MIN):
    """The largest difference of a pixel's energy from the picture's, as a share of a black pixel's, and its place."""
    found, outside = energies(path)
    black = make_raster.PIXEL_MM / (feed_mm_min / 60)
    picture = make_raster.picture()
    differences = {(column, row): found.get((column, row), 0) / black - power / make_raster.FULL_S
                   for row, line in enumerate(picture) for column, power in enumerate(line)}
    place = max(differences, key=lambda at: abs(differences[at]))
    return abs(differences[place]), place, outside / black
