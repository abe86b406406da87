#!/usr/bin/env python3
"""Makes raster.gcode: a picture of grey levels for laser.textproto, as senders of lasers write it.

    deploy/examples/make_raster.py > deploy/examples/raster.gcode
    deploy/examples/make_raster.py --check deploy/examples/raster.gcode    # whether it is the current one
    deploy/examples/make_raster.py --feed 600                              # slower, in mm/min

A ball in the light of a lamp at its upper left, its shadow, and a wedge of all levels. The lines go forth and back. A
line has one block for each run of pixels of one level, and S in this block is the power on the way to its end. M4 makes
the power follow the speed, so each millimetre gets the same energy also where the path is slow. Before and behind each
line there is room to get to the feed, without power.
"""
import argparse
import itertools
import math
import pathlib
import sys

WIDTH, HEIGHT = 40, 24  # pixels
PIXEL_MM = 0.25
LEFT_MM, BOTTOM_MM = 10.0, 10.0  # of the picture
OVERSCAN_MM = 1.0
FULL_S = 1000  # the full scale of the laser in laser.textproto
LEVELS = 10  # shades apart from white
FEED_MM_MIN = 3000


def shade(x, y):
    """The darkness from 0 to 1 of the point (x, y), in pixels from the lower left corner."""
    if x >= WIDTH - 10:
        return math.ceil(LEVELS * y / HEIGHT) / LEVELS if x < WIDTH - 2 else 0
    across, up, radius = x - 14.5, y - 13, 10
    inside = radius**2 - across**2 - up**2
    if inside > 0:
        light = (-across + up + 1.2 * math.sqrt(inside)) / radius / math.sqrt(1 + 1 + 1.2**2)
        return 0.95 - 0.9 * max(0.0, light)
    return 0.6 if ((x - 18) / 11) ** 2 + ((y - 2.5) / 2.2) ** 2 < 1 else 0


def picture():
    """Rows of S words, the lowest row first, each from left to right."""
    def power(column, row):
        return round(LEVELS * shade(column + 0.5, row + 0.5)) * FULL_S // LEVELS
    return [[power(column, row) for column in range(WIDTH)] for row in range(HEIGHT)]


def runs(row):
    """(S, its first column, its last column + 1) of each run of pixels of one level, without white edges."""
    at = 0
    found = []
    for power, pixels in itertools.groupby(row):
        end = at + len(list(pixels))
        found.append((power, at, end))
        at = end
    while found and found[0][0] == 0:
        found.pop(0)
    while found and found[-1][0] == 0:
        found.pop()
    return found


def number(mm):
    return f"{mm:.3f}".rstrip("0").rstrip(".")


def gcode(feed):
    yield "; A ball, its shadow and a wedge: made by make_raster.py"
    yield "G21 G90 G94 G17"
    yield "M8"
    yield "M4 S0"
    for number_of_row, row in enumerate(picture()):
        spans = runs(row)
        if not spans:
            continue
        to_right = number_of_row % 2 == 0
        way = 1 if to_right else -1
        if not to_right:
            spans = [(power, end, begin) for power, begin, end in reversed(spans)]
        place = [LEFT_MM + PIXEL_MM * column for _, _, column in spans]
        start = LEFT_MM + PIXEL_MM * spans[0][1]
        yield f"G0 X{number(start - way * OVERSCAN_MM)} Y{number(BOTTOM_MM + PIXEL_MM * (number_of_row + 0.5))}"
        yield f"G1 X{number(start)} S0 F{feed}"
        for (power, _, _), end in zip(spans, place):
            yield f"X{number(end)} S{power}"
        yield f"X{number(place[-1] + way * OVERSCAN_MM)} S0"
    yield "M5"
    yield "M9"
    yield "M2"


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--feed", type=int, default=FEED_MM_MIN, help=f"mm/min (default {FEED_MM_MIN})")
    arguments.add_argument("--check", type=pathlib.Path, metavar="FILE", help="fail unless FILE is the current one")
    given = arguments.parse_args()
    text = "\n".join(gcode(given.feed)) + "\n"
    if given.check is None:
        sys.stdout.write(text)
    elif given.check.read_text() != text:
        sys.exit(f"{given.check}: not as make_raster.py makes it: write it again with make_raster.py > {given.check}")


if __name__ == "__main__":
    main()
