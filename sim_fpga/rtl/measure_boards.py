#!/usr/bin/env python3
"""Places and routes the motors' chip for the boards of the folder boards, and writes their table of README.md.

Usage: measure_boards.py README BUILD               writes the table again, from five placements of each board
       measure_boards.py README BUILD --check       exits 1 if the first placement is not as the table says
       measure_boards.py README BUILD --check-all   the same of all five, and of the clocks
It builds in the directory BUILD. It fails if a placement leaves less than SPARE of the board's clock, if that is not the
clock of which the board's program knows, or if an SRAM has no time.
"""
import pathlib
import re
import subprocess
import sys

from measure import SEEDS, text, write_table

HERE = pathlib.Path(__file__).resolve().parent
BEGIN = "<!-- boards -->\n"
HEAD = """\
| board | logic cells | block RAM | SPRAM | clock, MHz | at most, MHz | to the SRAM and back, ns |
|---|---|---|---|---|---|---|
"""
SPARE = 1.05
SRAM_NS = 10
CLOCK = r"'(?:motors\.)?clk\S*"
FIRST_CELLS = 5  # those that a check of the first placement compares


def placed(board, seed, build):
    """The parts that are used, the clock of the motors, the highest possible one, and the delays between that and pins."""
    subprocess.run(["make", "-s", "-C", HERE, "bitstream", f"BOARD={board}", f"SEED={seed}", f"BUILD={build}"], check=True,
                   stdout=subprocess.DEVNULL)
    log = (build / board / f"{seed}.log").read_text()
    used = [re.search(rf"ICESTORM_{kind}: *(\d+)/", log) for kind in ("LC", "RAM", "SPRAM")]
    highest, clock = re.findall(rf"Max frequency for clock *{CLOCK}: ([\d.]+) MHz \(PASS at ([\d.]+) MHz", log)[-1]
    delays = (re.findall(rf"Max delay {way} *: ([\d.]+) ns", log)[-1]
              for way in (rf"<async> *-> posedge {CLOCK[1:]}", rf"posedge {CLOCK[1:]} *-> <async>"))
    pll = re.search(r"Derived frequency constraint of ([\d.]+) MHz for net", log)
    if pll and pll[1] != f"{float(clock):.1f}":
        sys.exit(f"{board}: the PLL makes {pll[1]} MHz, and boards/{board}.pcf says {clock} of the clock")
    return [int(part[1]) if part else 0 for part in used], float(clock), float(highest), sum(map(float, delays))


def clock_of_program(board):
    return int(re.search(r"^CLOCK_HZ = (\d+)", (HERE / "boards" / f"{board}.asm").read_text(), re.M)[1]) / 1e6


def row(board, seeds, build):
    runs = [placed(board, seed, build) for seed in seeds]
    used, clock = runs[0][:2]
    highest, delay = min(run[2] for run in runs), max(run[3] for run in runs)
    if clock != clock_of_program(board):
        sys.exit(f"{board}: CLOCK_HZ of boards/{board}.asm is not the {clock} MHz of boards/{board}.pcf")
    if highest < SPARE * clock:
        sys.exit(f"{board}: {highest} MHz are less than {SPARE} times its clock of {clock} MHz")
    has_sram = "sram_" in (HERE / "boards" / f"{board}.pcf").read_text()
    if has_sram and delay + SRAM_NS > 1000 / clock:
        sys.exit(f"{board}: {delay:.1f} ns to the SRAM and back, and its {SRAM_NS} ns, are longer than a clock")
    return [board] + [f"{part:,}" for part in used] + [f"{clock:.0f}", f"{highest:.0f}", f"{delay:.1f}" if has_sram else ""]


def main():
    readme, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    boards = sorted(path.stem for path in (HERE / "boards").glob("*.pcf"))
    checks, checks_all = "--check" in sys.argv, "--check-all" in sys.argv
    rows = [row(board, SEEDS[:1] if checks else SEEDS, build) for board in boards]
    if not checks and not checks_all:
        write_table(readme, BEGIN, text(rows, HEAD))
        return 0
    for now in rows:
        cells = now[:FIRST_CELLS] if checks else now
        if f"| {' | '.join(cells)} |" not in readme.read_text():
            print(f"now {cells}, which is not in {readme}\nremedy: sim_fpga/rtl/measure_boards.py {readme} {build}")
            return 1
        print(f"{now[0]}: {now}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
