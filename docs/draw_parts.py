#!/usr/bin/env python3
"""Draws how the processes of a machine talk, as SVG on standard output.

Usage: draw_parts.py
"""
WIDTH, HEIGHT = 900, 430
DDS, LCM, WIRE = "#1f5fae", "#b35900", "#555555"
BOX = ('<rect x="{x}" y="{y}" width="{w}" height="{h}" rx="6" fill="{fill}" stroke="#444"/>'
       '<text x="{cx}" y="{cy}" text-anchor="middle" font-weight="bold">{title}</text>'
       '<text x="{cx}" y="{sy}" text-anchor="middle" font-size="12" fill="#444">{sub}</text>')
HEAD = f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}"
 font-family="DejaVu Sans, Verdana, sans-serif" font-size="15">
<defs>{''.join(f'<marker id="{name}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="5" markerHeight="5" orient="auto-start-reverse"><path d="M0 0L8 4L0 8z" fill="{colour}"/></marker>' for name, colour in (("dds", DDS), ("lcm", LCM), ("wire", WIRE)))}</defs>
<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>"""


def box(x, y, w, h, title, sub, fill="#eef3fa"):
    return BOX.format(x=x, y=y, w=w, h=h, title=title, sub=sub, fill=fill, cx=x + w / 2, cy=y + h / 2 - 3, sy=y + h / 2 + 15)


def line(points, kind, colour, both=False):
    path = "M" + "L".join(f"{x} {y}" for x, y in points)
    start = f' marker-start="url(#{kind})"' if both else ""
    return f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="2" marker-end="url(#{kind})"{start}/>'


def label(x, y, text, colour, anchor="middle"):
    return f'<text x="{x}" y="{y}" text-anchor="{anchor}" font-size="12" fill="{colour}">{text}</text>'


def picture():
    parts = [box(20, 120, 130, 60, "lockstep", "the command"), box(240, 120, 140, 60, "coordinator", "plans, publishes")]
    for row, name in enumerate("XYZ"):
        y = 40 + 80 * row
        parts += [box(500, y, 130, 60, f"axis {name}", "checks, decides"), box(690, y, 80, 60, "FPGA", "executes", "#f2f2f2"),
                  box(810, y, 70, 60, "motor", name, "#f2f2f2"), line([(631, y + 30), (688, y + 30)], "wire", WIRE, True),
                  line([(771, y + 30), (808, y + 30)], "wire", WIRE),
                  line([(382, 150), (498, y + 30)], "dds", DDS, True),
                  line([(565, y + 60), (565, y + 79)] if row < 2 else [(565, 260), (565, 330)], "dds" if row < 2 else "lcm",
                       DDS if row < 2 else LCM, row < 2)]
    parts += [line([(152, 150), (238, 150)], "dds", DDS, True), line([(310, 182), (310, 350), (478, 350)], "lcm", LCM),
              box(480, 332, 190, 60, "lcm-logger, lcm-spy", "record, watch", "#fdf3e7"),
              box(20, 332, 150, 60, "analyze, verify", "report, proof", "#fdf3e7"),
              line([(478, 375), (172, 375)], "lcm", LCM),
              label(195, 140, "commands", DDS), label(195, 168, "state", DDS), label(425, 96, "frames", DDS),
              label(425, 212, "states", DDS), label(575, 112, "states of each other", DDS, "start"),
              label(660, 32, "registers", WIRE), label(792, 32, "step, dir", WIRE),
              label(575, 300, "every step, position, run, figure", LCM, "start"), label(320, 300, "jobs", LCM, "start"),
              label(315, 393, "log", LCM),
              label(20, 30, "DDS: control", DDS, "start"), label(20, 50, "LCM: telemetry; control never depends on it", LCM, "start")]
    return HEAD + "\n".join(parts) + "\n</svg>\n"


if __name__ == "__main__":
    print(picture(), end="")
