#!/usr/bin/env python3
"""The plate of deploy/examples/crooked-plate.textproto, engraved with its height map and without it. Uses nothing of
Lockstep but its messages and its CSV files; the plate's top is computed from the formula of docs/configuration.md.

    levelled_plate.py heights MESSAGES      prints the second touch of each point as x_mm,y_mm,z_mm
    levelled_plate.py engraving HEIGHTS     prints a program that engraves lines on the plate
    levelled_plate.py compare LEVEL BENT SVG    compares the places by the steps with the plate, and draws them
"""
import csv
import math
import re
import sys

STEPS_PER_MM = 400  # of all axes
DEPTH_MM = 0.2
LINES_Y = (55, 80, 105)
FROM_X, TO_X = 72, 128
# Bilinear between points 10 mm apart, the ball of 2 mm on a slope, and the steps of the touches.
DEEPER_MM = 0.03
CROOKED_MM = 0.3  # without the map the depth is wrong by more than that somewhere


def top(x, y):
    wave = 0.15 * math.sin(2 * math.pi * (x - 60) / 120) * math.sin(2 * math.pi * (y - 40) / 120)
    return 30 + 0.008 * (x - 60) - 0.005 * (y - 40) + wave


def heights(messages):
    print("x_mm,y_mm,z_mm")
    points = re.findall(r"touched at X ([\d.]+) +Y ([\d.]+) +Z ([\d.]+)", open(messages).read())[1::2]
    assert len(points) == 49, f"{len(points)} points"
    for point in points:
        print(",".join(point))


def engraving(table):
    """Z is level in the program: by the height of the map's first point."""
    first = next(csv.DictReader(open(table)))
    depth = float(first["z_mm"]) - DEPTH_MM
    print("G21 G90 G94\nG0 Z60")
    for y in LINES_Y:
        print(f"G0 X{FROM_X} Y{y}\nG0 Z34\nG1 Z{depth:.4f} F300\nG1 X{TO_X} F900\nG0 Z60")
    print("M2")


def steps_of(folder, motor):
    with open(f"{folder}/steps_{motor}.csv") as file:
        return [(int(row["tick"]), motor, int(row["position"])) for row in csv.DictReader(file)]


def cuts(folder):
    """The places while X moves on a line of the program below the plate's highest place, by the steps: x, y, z in mm."""
    counts = {"X": 0, "Y": 0, "Z": 0}
    found = {y: [] for y in LINES_Y}
    for _, motor, position in sorted(step for motor in counts for step in steps_of(folder, motor)):
        counts[motor] = position
        x, y, z = (counts[axis] / STEPS_PER_MM for axis in "XYZ")
        if motor == "X" and FROM_X < x < TO_X and y in found and z < 31:
            found[y].append((x, z))
    for y, places in found.items():
        assert len(places) > 1000, f"{folder}: only {len(places)} places of the cut at Y{y}"
    return found


def wrong_depth(found):
    return max(abs(top(x, y) - z - DEPTH_MM) for y, places in found.items() for x, z in places)


def picture(level, bent):
    """The plate and both paths from the side, in a panel for each line."""
    width, height, scale_x, scale_z, gap = 1100, 220, 17.5, 130, 30

    def panel(i, y):
        low, base = 29.5, 60 + i * (height + gap)
        to = lambda x, z: f"{70 + (x - 70) * scale_x:.1f} {base + height - (z - low) * scale_z:.1f}"
        line = lambda points: "M" + "L".join(to(x, z) for x, z in points)
        surface = [(70 + k * 0.5, top(70 + k * 0.5, y)) for k in range(121)]
        plate = line([(70, low), *surface, (130, low)]) + "Z"
        ways = ""
        for found, colour, dash in ((level, "#b5480a", "7 4"), (bent, "#0067ab", "none")):
            ways += f'<path d="{line(found[y][::100])}" fill="none" stroke="{colour}" stroke-width="2.5" stroke-dasharray="{dash}"/>'
        marks = "".join(f'<text x="62" y="{base + height - (z - low) * scale_z + 4:.1f}" text-anchor="end">{z:.1f}</text>'
                        f'<path d="M66 {base + height - (z - low) * scale_z:.1f}H70" stroke="#555"/>' for z in (29.5, 30.0, 30.5, 31.0))
        return (f'<path d="{plate}" fill="#d9dee3" stroke="#555"/>{ways}{marks}'
                f'<text x="80" y="{base + 16}">Y {y} mm</text>')

    panels = "".join(panel(i, y) for i, y in enumerate(LINES_Y))
    below = 60 + len(LINES_Y) * (height + gap)
    places = "".join(f'<text x="{70 + (x - 70) * scale_x:.1f}" y="{below}" text-anchor="middle">X {x}</text>' for x in range(70, 131, 10))
    legend = '<tspan fill="#555">grey: the plate</tspan>, <tspan fill="#0067ab">blue: the tool with the height map</tspan>, ' \
             '<tspan fill="#b5480a">brown, dashed: without it</tspan>. ' \
             f"Z in mm, {scale_z / scale_x:.1f} times as large as X; by the steps of a simulated run."
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width + 60} {below + 20}" font-family="sans-serif" font-size="13">'
            f'<rect width="{width + 60}" height="{below + 20}" fill="#fff"/>'
            f'<text x="20" y="24" font-size="16">A crooked plate, engraved 0.2 mm deep</text><text x="20" y="46">{legend}</text>'
            f'{panels}{places}</svg>\n')


def compare(level_folder, bent_folder, svg):
    level, bent = cuts(level_folder), cuts(bent_folder)
    without, with_map = wrong_depth(level), wrong_depth(bent)
    assert without > CROOKED_MM, f"without the map the depth is wrong by {without:.3f} mm only"
    assert with_map <= DEEPER_MM, f"with the map the depth is wrong by {with_map:.3f} mm"
    print(f"the depth of {DEPTH_MM} mm is wrong by at most {with_map:.3f} mm with the map, by {without:.3f} mm without")
    open(svg, "w").write(picture(level, bent))


{"heights": heights, "engraving": engraving, "compare": compare}[sys.argv[1]](*sys.argv[2:])
