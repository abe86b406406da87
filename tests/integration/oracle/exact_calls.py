"""Reads programs with LinuxCNC's interpreter as a library, which gives all digits: for each NAME.ngc of a folder, writes
NAME.calls in the format of rs274's output, in inches. There is no tool table: the library crashes at a program that
uses one."""
import os
import pathlib
import sys
import time

import gcode

SECONDS_AT_MOST = 0.5
NAMES = {"straight_traverse": "STRAIGHT_TRAVERSE", "straight_feed": "STRAIGHT_FEED", "arc_feed": "ARC_FEED",
         "set_feed_rate": "SET_FEED_RATE", "set_g5x_offset": "SET_G5X_OFFSET", "set_g92_offset": "SET_G92_OFFSET",
         "tool_offset": "USE_TOOL_LENGTH_OFFSET", "set_xy_rotation": "SET_XY_ROTATION", "dwell": "DWELL"}
PLANES = {1: "XY", 2: "YZ", 3: "XZ"}


class Canon:
    """Collects the interpreter's calls."""

    def __init__(self, folder):
        self.parameter_file = str(folder / "parameters.var")
        pathlib.Path(self.parameter_file).write_text("")
        self.lines = ["USE_LENGTH_UNITS(CANON_UNITS_INCHES)"]
        self.ends_at = time.monotonic() + SECONDS_AT_MOST

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *numbers: self.add(name, numbers)

    def add(self, name, numbers):
        if name in NAMES:
            self.lines.append(f"{NAMES[name]}({', '.join(f'{number:.17g}' for number in numbers)})")

    def set_plane(self, plane):
        self.lines.append(f"SELECT_PLANE({PLANES[plane]})")

    def check_abort(self):
        return time.monotonic() > self.ends_at

    def get_tool(self, pocket):
        return (-1,) + (0.0,) * 12 + (0,)

    def get_axis_mask(self):
        return 0x3f

    def get_block_delete(self):
        return False

    def get_external_length_units(self):
        return 1.0

    def get_external_angular_units(self):
        return 1.0


def read(program):
    canon = Canon(program.parent)
    try:
        gcode.parse(str(program), canon, "G21", "", "")
    except KeyboardInterrupt:  # from check_abort: the library repeats a program that has ended
        pass
    program.with_suffix(".calls").write_text("\n".join(canon.lines) + "\n")


def main():
    for program in sorted(pathlib.Path(sys.argv[1]).glob("*.ngc")):
        child = os.fork()  # the library keeps the tool offset of the previous program
        if child == 0:
            read(program)
            os._exit(0)
        os.waitpid(child, 0)


main()
