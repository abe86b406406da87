#!/usr/bin/env python3
"""Assembles program/*.asm: motors_program.vh is what motors_core.v runs, motors_constants.vh the constant words of the
map, motors_sizes.vh the sizes that the other modules share with the program.

Usage: assemble.py                      writes them again
       assemble.py --check              exits 1 if one differs
       assemble.py BOARD.asm DIRECTORY  writes those of a board into the directory: what the board's file says of a NAME
                                        counts, and not what program/0_registers.asm says

A line is one of these. Numbers are Python's, with the names that were defined before.

    NAME = NUMBER
    reg NAME LIMBS [ADDRESS]       a register of so many limbs of 16 bits; NAME[n] is its limb n
    NAME:                          a label
    OPERATION A, B                 A, B: registers; B: also #NUMBER, pins or checks. Of all limbs of A, or as add.2 says
    ld A, [NUMBER] | [p+NUMBER]    from the memory; st stores there
    show A, [NUMBER]               stores 24 words
    jmp, jz, ... LABEL             jumps; call LABEL; ret
    FUNCTION [A]                   a function outside of the registers, such as next

The core has no interlocks. An instruction says how many clocks it waits until its registers and flags are there.
"""
import pathlib
import re
import sys

HEAD = "// Made by assemble.py; edit program/*.asm.\n"
REGISTERS = pathlib.Path(__file__).resolve().parents[2] / "registers.vh"
HERE = pathlib.Path(__file__).resolve().parent
DATA = {name: code for code, name in enumerate("nop add sub cmp mov and andn or xor tst ld st".split())}
WRITES = {"add", "sub", "mov", "and", "andn", "or", "xor", "ld"}
JUMP, FUNCTION = 12, 13
JUMPS = {name: code for code, name in enumerate(
    "jmp jz jnz jc jnc jstep jnostep jless jback joverflow jtick jlate jshow jtouched jlast".split())}
NEEDS_ZERO = {"jz", "jnz"}
FUNCTIONS = {name: code for code, name in enumerate(
    "take next first shown entry small_entry word step_forward step_backward levels enable times analog untouch rest"
    .split())}
RESULT_CLOCKS = 3   # from reading a limb to reading its result
WORDS_IN_LINE = 4
LOAD_CLOCKS = 4     # to reading what a load brings; it is written a clock later than other results
ZERO_CLOCKS = 2     # from reading the last limb to a jump by zero


class Mistake(Exception):
    """What is wrong with a line."""


class Assembler:
    def __init__(self):
        self.names, self.registers, self.labels = {}, {}, {}
        self.fixed = set()                 # names that the board's file has
        self.free = 0
        self.code, self.jumps = [], []     # words; (index, label, line)
        self.clock = 0
        self.ready = {}                    # limb: the clock from which on it can be read
        self.zero_ready = 0
        self.write_ready = 0               # the clock from which on a result can be written

    def value(self, text):
        return int(eval(text, {"__builtins__": {}}, self.names))

    def number(self, text):
        """The low 16 bits: what fits into an instruction."""
        return self.value(text) & 0xffff

    def register(self, text):
        """Address, limbs; of NAME[n] one, though more may follow."""
        match = re.fullmatch(r"(\w+)(?:\[(\d+)\])?", text)
        if not match or match[1] not in self.registers:
            raise Mistake(f"there is no register {text}")
        address, limbs = self.registers[match[1]]
        return (address + int(match[2]), 1) if match[2] else (address, limbs)

    def define(self, words):
        name, limbs = words[0], int(words[1])
        align = 4 if limbs > 2 else limbs
        if len(words) > 2:
            address = self.number(words[2])
        else:
            address = self.free = -(-self.free // align) * align
            self.free += limbs
        if address % align or address + limbs > 256:
            raise Mistake(f"{name} does not fit at {address}")
        self.registers[name] = (address, limbs)

    def emit(self, word, reads=(), limbs=1, ready=0):
        """reads: the registers' limbs, and in which clock of the instruction. ready: the clock when it can begin."""
        begin = max([ready] + [self.ready.get(address, 0) - limb for address, limb in reads])
        wait = max(0, begin - self.clock)
        is_one_clock = wait + limbs == 1
        self.code.append(is_one_clock << 34 | wait << 32 | word)
        self.clock += wait + limbs

    def limbs_of(self, name, limbs, address):
        if address % (4 if limbs > 2 else limbs):
            raise Mistake(f"{name} of {limbs} limbs at {address}")
        return limbs

    def data(self, name, limbs, operands):
        a, own = self.register(operands[0])
        limbs = self.limbs_of(name, limbs or own, a)
        word = DATA[name if name != "show" else "st"] << 28 | (limbs - 1) << 26 | a << 16
        reads = [(a + limb, limb) for limb in range(limbs)] if name not in ("mov", "ld") else []
        if name == "show":
            word |= 3 << 24 | self.number(operands[1][1:-1])
            limbs = 96
        elif name in ("ld", "st"):
            match = re.fullmatch(r"\[(p\+)?(.*)\]", operands[1])
            word |= (0x8000 if match[1] else 0) | self.number(match[2])
        elif operands[1].startswith("#"):
            word |= 1 << 24 | self.number(operands[1][1:])
        elif operands[1] in ("pins", "checks"):
            word |= 2 << 24 | (operands[1] == "checks")
        else:
            b, own = self.register(operands[1])
            self.limbs_of(name, limbs, b)
            if own < limbs and "[" not in operands[1]:
                raise Mistake(f"{operands[1]} has {own} limbs, not {limbs}")
            word |= b
            reads += [(b + limb, limb) for limb in range(limbs)]
        is_load = name == "ld"
        self.emit(word, reads, limbs, self.write_ready if name in WRITES and not is_load else 0)
        begin = self.clock - limbs
        if name in WRITES:
            for limb in range(limbs):
                self.ready[a + limb] = begin + limb + (LOAD_CLOCKS if is_load else RESULT_CLOCKS)
        if is_load:
            self.write_ready = self.clock + 1
        if name not in ("ld", "st", "show"):
            self.zero_ready = self.clock - 1 + ZERO_CLOCKS

    def jump(self, name, label, line):
        kind = {"call": 1, "ret": 2}.get(name, 0)
        if label:
            self.jumps.append((len(self.code), label, line))
        self.emit(JUMP << 28 | kind << 24 | JUMPS.get(name, 0) << 16,
                  ready=self.zero_ready if name in NEEDS_ZERO else 0)

    def function(self, name, operands):
        address, reads = 0, []
        if operands:
            address, _ = self.register(operands[0])
            reads = [(address, 0)]
        self.emit(FUNCTION << 28 | address << 16 | FUNCTIONS[name], reads, ready=self.write_ready)
        if name in ("take", "next", "first", "shown"):
            self.emit(0)                   # the next one reads registers of another motor
            self.ready = {}

    def line(self, text, place):
        text = text.split(";")[0].strip()
        if not text:
            return
        if match := re.fullmatch(r"(\w+):", text):
            self.labels[match[1]] = len(self.code)
        elif match := re.fullmatch(r"(\w+) *= *(.*)", text):
            if match[1] not in self.fixed:
                self.names[match[1]] = self.value(match[2])
        else:
            name, _, rest = text.partition(" ")
            name, _, limbs = name.partition(".")
            operands = [operand.strip() for operand in rest.split(",")] if rest else []
            if name == "reg":
                self.define(rest.split())
            elif name in DATA and name != "nop" or name == "show":
                self.data(name, int(limbs or 0), operands)
            elif name in JUMPS or name in ("call", "ret"):
                self.jump(name, operands[0] if operands else None, place)
            elif name in FUNCTIONS:
                self.function(name, operands)
            else:
                raise Mistake(f"there is no operation {name}")

    def link(self):
        for index, label, place in self.jumps:
            if label not in self.labels:
                sys.exit(f"{place}: there is no label {label}")
            self.code[index] |= self.labels[label]
        if len(self.code) > 1024:
            sys.exit(f"the program has {len(self.code)} words; there is room for 1024")


def assembled(board=None):
    assembler = Assembler()
    for path in ([board] if board else []) + sorted((HERE / "program").glob("*.asm")):
        for number, text in enumerate(path.read_text().splitlines(), 1):
            try:
                assembler.line(text, f"{path.name}:{number}")
            except (Mistake, KeyError, IndexError, TypeError, NameError, SyntaxError) as mistake:
                sys.exit(f"{path.name}:{number}: {text.strip()}: {mistake!r}")
        if path == board:
            assembler.fixed = set(assembler.names)
    assembler.link()
    return assembler


def program_of(assembler):
    """The words, and the registers that are not 0 at power-up."""
    ones = [assembler.registers[name][0] + limb for name in ("NEVER", "SILENT_AT", "NEXT_DUE") for limb in range(4)]
    values = {**dict.fromkeys(ones, 0xffff), assembler.registers["IS_ZERO"][0]: 0xff,
              assembler.registers["PHASE"][0] + 3: 0x8000}
    # Synthesis leaves block RAM 0, and Yosys takes long to say so itself.
    lines = [HEAD, "initial begin\n`ifndef SYNTHESIS\n    for (i = 0; i < 1 << BITS; i = i + 1) begin\n"]
    lines += [f"        registers_{port}[i] = 0;\n" for port in "ab"]
    lines += ["    end\n`endif\n    for (i = 0; i < 1 << BITS; i = i + 256) begin\n"]
    lines += [f"        registers_{port}[i + {address}] = 16'h{value:04x};\n"
              for port in "ab" for address, value in sorted(values.items())]
    lines += ["    end\n"]
    words = [f"words[{index}] = 35'h{word:09x};" for index, word in enumerate(assembler.code)]
    lines += [f"    {' '.join(words[at:at + WORDS_IN_LINE])}\n" for at in range(0, len(words), WORDS_IN_LINE)]
    return "".join(lines) + "end\n"


def constants_of(assembler):
    """The constant words of the map."""
    names = assembler.names
    words = dict(re.findall(r"localparam \[\d+:0\] LOCKSTEP_(\w+) = \d+'h(\w+);", REGISTERS.read_text()))
    words = {name: int(value, 16) for name, value in words.items()}
    shown = {"MAGIC": words["MAGIC_VALUE"], "VERSION": words["VERSION_VALUE"],
             "MAP_CHECKSUM": words["MAP_CHECKSUM_VALUE"], "TICK_NS": names["TICK_NS"],
             "SEGMENT_ENTRIES": names["SEGMENT_ENTRIES"], "CAPTURE_ENTRIES": names["CAPTURE_ENTRIES"],
             "LEAST_STEP_TICKS": 2, "TIME_UNIT_PS": names["TIME_UNIT_PS"], "LONGEST_TIME": names["LONGEST_TIME"],
             "INPUT_CHANNELS": names["INPUTS"], "DIGITAL_CHANNELS": names["DIGITAL"],
             "ANALOG_CHANNELS": names["ANALOG"], "OUTPUT_ENTRIES": names["OUTPUT_ENTRIES"],
             "EVENT_ENTRIES": names["EVENT_ENTRIES"], "FEATURES": 0b1010, "LONGEST_PWM_PERIOD": 0,
             "LONGEST_PIECE_TICKS": 0xffffffff, "LEAD_TICKS": names["LEAD_TICKS"], "PIN_TICKS": 3}
    lines = [HEAD, "initial begin\n    for (i = 0; i < 128; i = i + 1) constants[i] = 0;\n"]
    for name, value in shown.items():
        lines += [f"    constants[{words[name] // 2 + limb}] = 16'h{value >> 16 * limb & 0xffff:04x};\n"
                  for limb in range(4)]
    return "".join(lines) + "end\n"


def sizes_of(assembler):
    """The parameters of a module that depend on the program. A motor without outputs has one that the board leaves out,
    because Verilog has no vector without bits."""
    names = ("TICK_CLOCKS", "INPUTS", "DIGITAL", "ANALOG")
    return HEAD + ",\n".join(f"parameter {name} = {max(1, assembler.names[name])}" for name in names) + "\n"


def write(directory, assembler, is_check):
    """Returns the names of the files that differed."""
    texts = {"motors_program.vh": program_of(assembler), "motors_constants.vh": constants_of(assembler),
             "motors_sizes.vh": sizes_of(assembler)}
    differing = [name for name, text in texts.items()
                 if not (directory / name).exists() or (directory / name).read_text() != text]
    if not is_check:
        for name in differing:
            (directory / name).write_text(texts[name])
    return differing


def main():
    is_check = "--check" in sys.argv
    if len(sys.argv) == 3:
        board, directory = (pathlib.Path(argument) for argument in sys.argv[1:])
        directory.mkdir(parents=True, exist_ok=True)
        write(directory, assembled(board), False)
        return 0
    differing = write(HERE, assembled(), is_check)
    if is_check and differing:
        print(f"{differing} differ from program/*.asm\nremedy: sim_fpga/rtl/motors/assemble.py")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
