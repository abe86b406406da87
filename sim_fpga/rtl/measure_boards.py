#!/usr/bin/env python3
"""Places and routes the motors' chip for the boards of the folder boards, and writes their table of README.md.

Usage: measure_boards.py README BUILD            writes the table again, from five placements of each board
       measure_boards.py README BUILD --check    exits 1 if the first placement is not as the table says
It builds in the directory BUILD. It fails if a placement does not reach the board's clock, or leaves its SRAM no time.
"""
import pathlib
import re
import subprocess
import sys

from measure import SEEDS, text, write_table

HERE = pathlib.Path(__file__).resolve().parent
BEGIN = "<!-- boards -->\n"
HEAD = """\
| board | logic cells | block RAM | clock, MHz | at most, MHz | to the SRAM and back, ns |
|---|---|---|---|---|---|
"""
SRAM_NS = 10


def placed(board, seed, build):
    """Logic cells, block RAM, the clock of the motors, the highest possible one, and the delays between that and pins."""
    subprocess.run(["make", "-s", "-C", HERE, "bitstream", f"BOARD={board}", f"SEED={seed}", f"BUILD={build}"], check=True,
                   stdout=subprocess.DEVNULL)
    log = (build / board / f"{seed}.log").read_text()
    cells, memories = (int(re.search(rf"{kind}: *(\d+)/", log)[1]) for kind in ("ICESTORM_LC", "ICESTORM_RAM"))
    highest, clock = re.findall(r"Max frequency for clock *'motors\.clk\S*: ([\d.]+) MHz \(PASS at ([\d.]+) MHz", log)[-1]
    delays = (re.findall(rf"Max delay {way} *: ([\d.]+) ns", log)[-1]
              for way in (r"<async> *-> posedge motors\.clk\S*", r"posedge motors\.clk\S* *-> <async>"))
    return cells, memories, float(clock), float(highest), sum(float(delay) for delay in delays)


def row(board, seeds, build):
    runs = [placed(board, seed, build) for seed in seeds]
    cells, memories, clock = runs[0][:3]
    highest, delay = min(run[3] for run in runs), max(run[4] for run in runs)
    if delay + SRAM_NS > 1000 / clock:
        sys.exit(f"{board}: {delay:.1f} ns to the SRAM and back, and its {SRAM_NS} ns, are longer than a clock")
    return [board, f"{cells:,}", str(memories), f"{clock:.0f}", f"{highest:.0f}", f"{delay:.1f}"]


def main():
    readme, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    boards = sorted(path.stem for path in (HERE / "boards").glob("*.pcf"))
    if "--check" not in sys.argv:
        write_table(readme, BEGIN, text([row(board, SEEDS, build) for board in boards], HEAD))
        return 0
    for board in boards:
        now = row(board, SEEDS[:1], build)
        if f"| {' | '.join(now[:4])} |" not in readme.read_text():
            print(f"now {now[:4]}, which is not in {readme}\nremedy: sim_fpga/rtl/measure_boards.py {readme} {build}")
            return 1
        print(f"{board}: {now}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
