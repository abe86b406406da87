#!/usr/bin/env python3
"""Computes the path of the tool from the steps of two motors alone, and compares it with the program and with the
stepped path of the report page. Uses nothing of Lockstep but its CSV files, its report and its page.

    lockstep analyze run.lcm --csv DIR --json >DIR/report.json
    motor_path.py core-xy outline.gcode DIR DIR/run.html --svg path.svg
"""
import argparse
import csv
import json
import math
import re

STEPS_PER_MM = 80  # of all motors in both examples
# X and Y in mm by the counts of the motors, and how far a step of each motor moves them at most.
MACHINES = {
    "core-xy": (("A", "B"), lambda a, b: ((a + b) / 2 / STEPS_PER_MM, (a - b) / 2 / STEPS_PER_MM), 1),
    "gantry": (("X", "Y1", "Y2"), lambda x, y1, y2: (x / STEPS_PER_MM, (y1 + y2) / 2 / STEPS_PER_MM), 1),
}


def arc(start, end, centre, sign):
    """Points of an arc from `start` to `end`; `sign` is 1 if it goes counter-clockwise. A full circle if they are equal."""
    radius = math.dist(start, centre)
    first = math.atan2(start[1] - centre[1], start[0] - centre[0])
    sweep = (math.atan2(end[1] - centre[1], end[0] - centre[0]) - first) * sign % (2 * math.pi) or 2 * math.pi
    pieces = math.ceil(sweep * radius / 0.1)
    at = [first + sign * sweep * i / pieces for i in range(1, pieces)]
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in at] + [end]


def program(path):
    """The points of the commanded path: G0 to G3 with absolute X and Y, from the origin."""
    points = [(0.0, 0.0)]
    for line in open(path):
        words = dict((w, float(n)) for w, n in re.findall(r"([A-Z])(-?[\d.]+)", re.sub(r"\(.*?\)", "", line)))
        if "X" not in words:
            continue
        at, to = points[-1], (words["X"], words["Y"])
        centre = (at[0] + words.get("I", 0), at[1] + words.get("J", 0))
        points += arc(at, to, centre, 1 if words["G"] == 3 else -1) if "I" in words else [to]
    return points


def steps_of(folder, motor, since):
    with open(f"{folder}/steps_{motor}.csv") as file:
        return [(int(row["tick"]), int(row["position"])) for row in csv.DictReader(file) if int(row["tick"]) >= since]


def places(folder, motors, place, since):
    """The tool's place after each tick at which a motor made a step, from the origin."""
    counts = dict.fromkeys(motors, 0)
    steps = sorted((tick, motor, position) for motor in motors for tick, position in steps_of(folder, motor, since))
    path = [place(*counts.values())]
    for i, (tick, motor, position) in enumerate(steps):
        assert abs(position - counts[motor]) == 1, f"{motor} goes from {counts[motor]} to {position} at tick {tick}"
        counts[motor] = position
        if i + 1 == len(steps) or steps[i + 1][0] != tick:
            path.append(place(*counts.values()))
    return path


def distance(at, a, b):
    """Of a place from the line between two points."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = dx * dx + dy * dy
    share = max(0, min(1, ((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / length)) if length else 0
    return math.hypot(at[0] - a[0] - share * dx, at[1] - a[1] - share * dy)


class Nearest:
    """Finds the distance of places from a path, by its parts in each square of a grid."""

    def __init__(self, path, cell=1.0):
        self.path, self.cell, self.grid = path, cell, {}
        for i, (a, b) in enumerate(zip(path, path[1:])):
            for x in range(*self.span(a[0], b[0])):
                for y in range(*self.span(a[1], b[1])):
                    self.grid.setdefault((x, y), []).append(i)

    def span(self, a, b):
        return math.floor((min(a, b) - 0.1) / self.cell), math.floor((max(a, b) + 0.1) / self.cell) + 1

    def distance(self, at):
        parts = self.grid.get((math.floor(at[0] / self.cell), math.floor(at[1] / self.cell)), [])
        return min((distance(at, self.path[i], self.path[i + 1]) for i in parts), default=math.inf)


def farthest(path, other):
    nearest = Nearest(other)
    return max(nearest.distance(at) for at in path)


def stepped_of_page(page):
    """The stepped path that the report page draws."""
    charts = json.loads(re.search(r'id="charts"[^>]*>(.*?)</script>', open(page).read(), re.S).group(1))
    stepped = charts["path"]["stepped"]
    return [(x, y) for x, y in zip(stepped["x"], stepped["y"]) if x is not None]


def picture(commanded, by_motors, by_page, title):
    """The whole paths, and a corner of each kind 40 times as large."""
    def lines(parts, to, colour, width):
        way = "".join("M{:.1f} {:.1f}L{:.1f} {:.1f}".format(*to(a), *to(b)) for a, b in parts)
        return f'<path d="{way}" fill="none" stroke="{colour}" stroke-width="{width}" stroke-linecap="round"/>'

    def panel(left, size, centre, half, name):
        scale = size / (2 * half)
        to = lambda p: (left + size / 2 + (p[0] - centre[0]) * scale, 60 + size / 2 - (p[1] - centre[1]) * scale)
        near = lambda path: [part for part in zip(path, path[1:]) if distance(centre, *part) < 2 * half]
        dots = lines([(a, a) for a, _ in near(by_motors)], to, "#b5480a", 4.5)
        clip = f"clip{left}"
        return (f'<clipPath id="{clip}"><rect x="{left}" y="60" width="{size}" height="{size}"/></clipPath>'
                f'<text x="{left}" y="50">{name}</text>'
                f'<rect x="{left}" y="60" width="{size}" height="{size}" fill="#fff" stroke="#999"/>'
                f'<g clip-path="url(#{clip})">{lines(near(by_page), to, "#7fb3e6", 5)}'
                f'{dots if half < 5 else lines(near(by_motors[::40]), to, "#b5480a", 2)}'
                f'{lines(near(commanded), to, "#222", 1)}</g>')

    return ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1120 470" font-family="sans-serif" font-size="13">'
            '<rect width="1120" height="470" fill="#fff"/>'
            f'<text x="20" y="24" font-size="16">{title}</text>'
            + panel(20, 350, (42, 40), 46, "the whole path, mm")
            + panel(390, 350, (60.0, 10.0), 0.3, "0.6 mm around X60 Y10, where an arc begins")
            + panel(760, 350, (84.0, 58.0), 0.3, "0.6 mm around the corner X84 Y58")
            + '<text x="20" y="440"><tspan fill="#222">black: commanded</tspan>, '
              '<tspan fill="#2f75b5">blue: stepped, by lockstep analyze</tspan>, '
              '<tspan fill="#b5480a">brown: each place by the motors\' steps, by an independent script</tspan></text></svg>')


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("machine", choices=MACHINES)
    arguments.add_argument("gcode")
    arguments.add_argument("folder", help="with steps_MOTOR.csv and report.json")
    arguments.add_argument("page", help="the report page")
    arguments.add_argument("--svg", help="draws the paths")
    given = arguments.parse_args()
    motors, place, steps = MACHINES[given.machine]
    report = json.load(open(given.folder + "/report.json"))
    job = next(job for job in report["jobs"] if job["kind"] == "run")
    first = min(int(axis["first_tick"]) for axis in report["axes"] if "first_tick" in axis)
    commanded = program(given.gcode)
    by_motors = places(given.folder, motors, place, first + job["begun_s"] * 1e6)
    by_page = stepped_of_page(given.page)
    if given.svg:
        open(given.svg, "w").write(picture(commanded, by_motors, by_page, f"{given.machine}: the path of the motors"))

    most = math.sqrt(2) * steps / STEPS_PER_MM  # a step of each motor
    off = farthest(by_motors, commanded)
    missed = farthest(commanded, by_motors)
    drawn = farthest(by_page, by_motors)
    left_out = farthest(by_motors, by_page)
    said = job["largest_distance_mm"]
    print(f"{given.machine}: {len(by_motors)} places by the motors' steps, at most {off:.4f} mm from the program, which "
          f"is at most {missed:.4f} mm from them; analyze says {said:.4f} mm; its page draws places at most {drawn:.4f} mm from these, and leaves out places at most "
          f"{left_out:.4f} mm from what it draws")
    assert len(by_motors) > 10_000 and 100 < len(by_page) < len(by_motors) / 4
    assert off <= most and missed <= most and drawn <= most, most
    assert left_out <= 2 * most, most  # the page leaves out what a picture does not need
    assert abs(off - said) < 1e-3, (off, said)
    assert job["made_steps"] == job["asked_steps"] and report["verdict"] == "good"


main()
