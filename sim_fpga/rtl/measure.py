#!/usr/bin/env python3
"""Synthesizes, places and routes the designs of this folder for iCE40 parts, and writes the table of README.md.

Usage: measure.py README            writes the table again
       measure.py README --check    exits 1 if a row differs; places only designs of one axis, which takes a minute
       measure.py README --device   writes the table of the device of one motor again, which takes minutes
       measure.py README --motors   writes the table of the motors' chip again, from five placements; with --check it
                                    exits 1 if the table differs
"""
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
BEGIN, END = "<!-- table -->\n", "<!-- end -->\n"
HEAD = """\
| design | axes | LUT4 | flip-flops | block RAM | UP5K, MHz | HX8K, MHz | steps/s for each axis, UP5K | HX8K | the paper's own |
|---|---|---|---|---|---|---|---|---|---|
"""
DEVICE_BEGIN = "<!-- device -->\n"
DEVICE_HEAD = """\
| design | LUT4 | flip-flops | block RAM | UP5K, MHz | HX8K, MHz |
|---|---|---|---|---|---|
"""
MOTORS_BEGIN = "<!-- motors -->\n"
MOTORS_HEAD = """\
| motors | LUT4 | flip-flops | block RAM | SPRAM | UP5K, MHz |
|---|---|---|---|---|---|
"""
SEEDS = range(1, 6)
PARTS = {
    "UP5K": ["--up5k", "--package", "sg48", "--freq", "48"],
    "HX8K": ["--hx8k", "--package", "ct256", "--freq", "150"],
}
# What a paper prints of the part and the speed of its own design, by the design's folder and its number of axes.
OF_PAPER = {
    ("lam", 1): "335 logic elements of a Cyclone II, LUT4 with a flip-flop; 1,667 steps/s at 10 kHz (Table 1)",
    ("carrica", 3): "an XC4006 of 6,000 gates, 256 blocks of two LUT4 and a LUT3; words of 16 bits; 50,000 steps/s, "
                    "a T_c of 400 ns at 40 MHz (Sections III, V)",
    ("lai", 1): "an adder and two registers of 8 bits (Section 3)",
    ("lai", 2): "a soft-core 8051 plans; at most 255 pulses per 6.5 ms, four in the experiment (Section 3)",
    ("ranade", 6): "an XC3S400, which has 7,168 LUT4; 100,000 steps/s, a tick of 1 us at 20 MHz",
}
FLIP_FLOP, LUT, RAM = re.compile(r"SB_DFF"), re.compile(r"SB_LUT4"), re.compile(r"SB_RAM40_4K")
SPRAM = re.compile(r"SB_SPRAM256KA")


class Design:
    """A module, its parameters, for which numbers of axes it is measured, and the clocks of its shortest step."""

    def __init__(self, name, folder, top, clocks_per_step, axes=(1, 3, 6), shared=False, synth="synth_ice40",
                 **parameters):
        self.name, self.folder, self.top, self.axes = name, folder, top, axes
        self.clocks_per_step = clocks_per_step
        self.shared = shared  # one module serves all axes; otherwise each has a copy
        self.synth = synth
        self.parameters = parameters

    def copies(self, axes):
        return 1 if self.shared else axes

    def sources(self):
        return " ".join(str(path) for folder in (self.folder, "drive") for path in sorted((HERE / folder).glob("*.v")))

    def chosen(self):
        sets = " ".join(f"-set {name} {value}" for name, value in self.parameters.items())
        return f"chparam {sets} {self.top};" if sets else ""


def designs():
    yield Design("Lam: delay counter and six states", "lam", "lam_controller", 2)
    yield Design("Carrica: comparator, 40 bits", "carrica", "carrica_controller", 18, LAST=17)
    yield Design("Carrica: comparator, 24 bits", "carrica", "carrica_controller", 18, LAST=17, FRACTION=24,
                 STEP_BITS=16)
    yield Design("Lai: DDA", "lai", "dda", 256 / 255)
    yield Design("Lai: serial line, planner, DDAs", "lai", "two_axis_controller", 256 / 255 * 5, (2,), True,
                 LAST_CLOCK=4)
    yield Design("Ranade: two adders for each axis", "ranade", "add_only_axis", 4)
    for axes in (1, 3, 6):
        yield Design("Ranade: one adder for all axes", "ranade", "add_only_engine", 12 * axes, (axes,), True, N=axes,
                     MOTOR_BITS=max(1, (axes - 1).bit_length()))


def devices():
    yield Design("all of a motor's hardware, 64 pieces in the ring", "axis", "axis_chip", 0, (1,), True)
    yield Design("of it the pins of the motor", "axis", "axis_pins", 0, (1,), True)


def motors():
    yield Design("6", "motors", "motors_chip", 0, (6,), True, "synth_ice40 -spram", MOTORS=6)


def yosys(script, work):
    out = work / "out.json"
    subprocess.run(["yosys", "-q", "-p", f"{script} write_json {out}"], check=True)
    return json.loads(out.read_text())


def synthesized(design, work):
    """The netlist of one copy."""
    return yosys(f"read_verilog -I{HERE.parent} {design.sources()}; {design.chosen()} {design.synth} "
                 f"-top {design.top};",
                 work)["modules"][design.top]


def count(module, kind):
    return sum(bool(kind.match(cell["type"])) for cell in module["cells"].values())


def ports(module, direction):
    return [(name, len(port["bits"])) for name, port in module["ports"].items()
            if port["direction"] == direction and name != "clk"]


def with_few_pins(design, module, copies):
    """A top module for placing: one shift register gives the inputs of all copies, another one takes the outputs."""
    inputs, outputs = ports(module, "input"), ports(module, "output")
    in_bits, out_bits = sum(bits for _, bits in inputs), sum(bits for _, bits in outputs)
    last = out_bits * copies - 1
    lines = [f"module few_pins (input clk, input in, output out); reg [{in_bits - 1}:0] i; reg [{last}:0] o;",
             f"wire [{last}:0] w; always @(posedge clk) begin i <= {{i, in}};",
             "o <= in ? w : o >> 1; end assign out = o[0];"]
    for copy in range(copies):
        at, connections = copy * 7, []
        for name, bits in inputs:
            taken = ", ".join(f"i[{(at + bit) % in_bits}]" for bit in reversed(range(bits)))
            connections.append(f".{name}({{{taken}}})")
            at += bits
        at = copy * out_bits
        for name, bits in outputs:
            connections.append(f".{name}(w[{at + bits - 1}:{at}])")
            at += bits
        lines.append(f"{design.top} copy{copy} (.clk(clk), {', '.join(connections)});")
    return "\n".join(lines) + "\nendmodule\n"


def netlist_with_few_pins(design, module, copies, work):
    wrapper, netlist = work / "few_pins.v", work / "placed.json"
    wrapper.write_text(with_few_pins(design, module, copies))
    subprocess.run(["yosys", "-q", "-p", f"read_verilog -I{HERE.parent} {design.sources()} {wrapper}; {design.chosen()} "
                    f"{design.synth} -top few_pins -json {netlist}"], check=True)
    return netlist


def megahertz(design, module, copies, work):
    """The highest clock in each of the parts."""
    netlist = netlist_with_few_pins(design, module, copies, work)
    return [placed(netlist, options) for options in PARTS.values()]


class DoesNotFit(Exception):
    """The part has fewer cells than the design needs."""


def placed(netlist, options, seed=1):
    run = subprocess.run(["nextpnr-ice40", *options, "--json", str(netlist), "--seed", str(seed),
                          "--pcf-allow-unconstrained", "--timing-allow-fail"], capture_output=True, text=True,
                         check=False)
    found = re.findall(r"Max frequency for clock .*?: ([\d.]+) MHz", run.stderr)
    if "no BELs remaining" in run.stderr or "Failed to expand region" in run.stderr:
        raise DoesNotFit
    if run.returncode or not found:
        raise RuntimeError(run.stderr[-2000:])
    return float(found[-1])


def rounded(steps_per_s):
    """To two digits, downwards."""
    digits = 10 ** (len(str(int(steps_per_s))) - 2)
    return f"{int(steps_per_s) // digits * digits:,}"


def rows_of(design, check):
    """The rows of a design. Without the clocks where a check does not place it."""
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        module = synthesized(design, work)
        return [row(design, module, axes, check and axes > 1, work) for axes in design.axes]


def row(design, module, axes, only_cells, work):
    copies = design.copies(axes)
    cells = [design.name, str(axes)] + [f"{count(module, kind) * copies:,}" for kind in (LUT, FLIP_FLOP, RAM)]
    if only_cells:
        return cells
    clocks = megahertz(design, module, copies, work)
    return (cells + [f"{int(clock)}" for clock in clocks]
            + [rounded(clock * 1e6 / design.clocks_per_step) for clock in clocks]
            + [OF_PAPER.get((design.folder, axes), "")])


def device_row(design):
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        module = synthesized(design, work)
        netlist = netlist_with_few_pins(design, module, 1, work)
        return ([design.name] + [f"{count(module, kind):,}" for kind in (LUT, FLIP_FLOP, RAM)]
                + [clock_in(netlist, options) for options in PARTS.values()])


def motors_row(design):
    """The clock is the lowest one of all seeds."""
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        module = synthesized(design, work)
        netlist = netlist_with_few_pins(design, module, 1, work)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            clocks = list(pool.map(lambda seed: placed(netlist, PARTS["UP5K"], seed), SEEDS))
        return ([design.name] + [f"{count(module, kind):,}" for kind in (LUT, FLIP_FLOP, RAM, SPRAM)]
                + [f"{min(clocks):.1f}"])


def clock_in(netlist, options):
    try:
        return f"{int(placed(netlist, options))}"
    except DoesNotFit:
        return "does not fit"


def write_table(readme, begin, table):
    before, rest = readme.read_text().split(begin)
    readme.write_text(before + begin + table + END + rest.split(END, 1)[1])


def text(rows, head=HEAD):
    return head + "".join("| " + " | ".join(cells) + " |\n" for cells in rows)


def differences(rows, table):
    old = {tuple(cells[:2]): cells for cells in
           ([cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()[2:])}
    if len(old) != len(rows):
        yield f"the table has {len(old)} rows, and there are {len(rows)} designs"
    for cells in rows:
        before = old.get(tuple(cells[:2]), [])
        if before[:len(cells)] != cells:
            yield f"now {cells}, in the table {before[:len(cells)]}"


def main():
    readme, check = pathlib.Path(sys.argv[1]), "--check" in sys.argv
    if "--motors" in sys.argv:
        table = text([motors_row(design) for design in motors()], MOTORS_HEAD)
        if not check:
            write_table(readme, MOTORS_BEGIN, table)
        elif MOTORS_BEGIN + table + END not in readme.read_text():
            print(f"now\n{table}\nwhich is not in {readme}\nremedy: {sys.argv[0]} {readme} --motors")
            return 1
        return 0
    if "--device" in sys.argv:
        write_table(readme, DEVICE_BEGIN, text([device_row(design) for design in devices()], DEVICE_HEAD))
        return 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        rows = [row for rows in pool.map(lambda design: rows_of(design, check), designs()) for row in rows]
    if not check:
        write_table(readme, BEGIN, text(rows))
        return 0
    found = list(differences(rows, readme.read_text().split(BEGIN)[1].split(END)[0]))
    print("\n".join(found) or "the table is current")
    if found:
        print("remedy: sim_fpga/rtl/update-readme build")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
