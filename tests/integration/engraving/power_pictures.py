#!/usr/bin/env python3
"""The power map of a report page, compared with the picture of raster.gcode.

Usage: power_pictures.py PAGE            each pixel has the energy that is asked for
       power_pictures.py PAGE --missing  some cells are not known, and the others are as above
       power_pictures.py LOG --without FIRST LAST COPY  writes a copy without these changes of the device of X
"""
import json
import re
import sys

import make_raster
import read_log
from lockstep import channel_event_t

NOT_KNOWN = -2
NEAR = 6  # percent of a black pixel: where the path rests within a cell, its steps beside the rest are placed less exactly


def power_map(page):
    text = open(page, encoding="utf-8").read()
    return json.loads(re.search(r'id="charts">(.*?)</script>', text, re.S)[1])["powers"][0]


def rows(shown, lengths):
    """The numbers of the cells, the lowest row first."""
    numbers = [number for number, count in zip(lengths[::2], lengths[1::2]) for _ in range(count)]
    assert len(numbers) == shown["width"] * shown["height"]
    return [numbers[i : i + shown["width"]] for i in range(0, len(numbers), shown["width"])][::-1]


def check(page, has_gap):
    shown = power_map(page)
    print(shown["summary"])
    energy = next(of for of in shown["maps"] if of["name"] == "energy for each mm")
    made = rows(shown, energy["made"])
    unknown = sum(row.count(NOT_KNOWN) for row in made)
    assert (unknown > 0) == has_gap == shown["unknown"], unknown
    cell = shown["cell_mm"]
    compared = 0
    for row, line in enumerate(make_raster.picture()):
        j = int((make_raster.BOTTOM_MM + make_raster.PIXEL_MM * (row + 0.5)) / cell) - shown["bottom"]
        for column, power in enumerate(line):
            middle = (make_raster.LEFT_MM + make_raster.PIXEL_MM * (column + 0.5)) / cell - shown["left"]
            if power == 0 or not 0 <= j < shown["height"]:
                continue
            number = made[j][int(middle)]
            if number == NOT_KNOWN:
                continue
            wanted = 100 * power / make_raster.FULL_S
            assert abs(number - wanted) <= NEAR, f"pixel ({column}, {row}): {number} %, asked for {wanted} %"
            compared += 1
    burned = sum(power > 0 for line in make_raster.picture() for power in line)
    print(f"{compared} of {burned} pixels compared, {unknown} cells not known")
    assert compared >= (burned * 0.9 if has_gap else burned)


def copy_without(log, first, last, path):
    with open(log, "rb") as source, open(path, "wb") as copy:
        while header := source.read(read_log.EVENT.size):
            _, _, _, channel_length, data_length = read_log.EVENT.unpack(header)
            channel, data = source.read(channel_length), source.read(data_length)
            kind = read_log.TYPES.get(data[:8])
            message = kind.decode(data) if kind is channel_event_t else None
            if message is None or message.axis != "X" or not first <= message.sequence <= last:
                copy.write(header + channel + data)


if __name__ == "__main__":
    if sys.argv[2:3] == ["--without"]:
        copy_without(sys.argv[1], int(sys.argv[3]), int(sys.argv[4]), sys.argv[5])
    else:
        check(sys.argv[1], sys.argv[2:3] == ["--missing"])
