#!/usr/bin/env python3
"""The rules of the code that can be checked automatically: layers (check_layers.py), what core may not use, sizes, format.

Usage: check_style.py ROOT    Prints each breach as file:line: what; exits 1 where there is one.
"""
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True
import check_layers  # noqa: E402

SOURCES = ("core", "sim_fpga", "services", "clients", "tests")
# Core receives messages and time: it does no I/O, starts no threads, reads no clocks.
FORBIDDEN_IN_CORE = re.compile(
    r"#include <(chrono|thread|mutex|iostream|fstream|ctime|condition_variable|filesystem|unistd\.h|sys/.*)>"
    r"|clock_gettime|std::chrono|std::rand\b|random_device|spdlog")
# Callers decide by the errors of core, so an error is a type (docs/decisions/code/typed-errors-in-core.md).
SENTENCE = re.compile(r"std::(un)?expected<.*std::string>[ (;]")
MAY_RETURN_SENTENCES = {"core/coordinator/program/row_store.hpp"}
# A remedy is an action (core/faults.hpp: Remedy). Its words are the client's: a shell, a page, a sender.
SHELL_COMMAND = re.compile(r'^(?!\s*//)[^/]*"[^"]*\blockstep [a-z]')
MAX_LINES = 500
MAX_WIDTH = 120  # of Verilog; clang-format knows the width of C++
UNFINISHED = re.compile(r"\b(TODO|FIXME|XXX)\b")


def sources(root):
    for layer in SOURCES:
        for path in sorted((root / layer).rglob("*")):
            if path.suffix in (".hpp", ".cpp", ".v", ".vh"):
                yield layer, path


def breaches(root, layer, path):
    name = path.relative_to(root).as_posix()
    lines = path.read_text().splitlines()
    if len(lines) > MAX_LINES:
        yield f"{name}:{MAX_LINES}: {len(lines)} lines; split it into ideas"
    for number, line in enumerate(lines, 1):
        if layer == "core" and FORBIDDEN_IN_CORE.search(line):
            yield f"{name}:{number}: core has no I/O, threads or clocks: {line.strip()}"
        if layer == "core" and SENTENCE.search(line) and name not in MAY_RETURN_SENTENCES:
            yield f"{name}:{number}: an error of core is a type with values, not a sentence: {line.strip()}"
        if layer == "core" and SHELL_COMMAND.search(line):
            yield f"{name}:{number}: core names actions, not commands of the shell: {line.strip()}"
        if UNFINISHED.search(line):
            yield f"{name}:{number}: unfinished: {line.strip()}"
        if path.suffix in (".v", ".vh"):
            yield from (f"{name}:{number}: {what}" for what in verilog_breaches(line))
    if path.suffix == ".v" and not lines[0].startswith("// "):
        yield f"{name}:1: a module begins with a comment that says what it does"


def verilog_breaches(line):
    """No formatter of Debian keeps these."""
    if len(line) > MAX_WIDTH:
        yield f"{len(line)} characters; at most {MAX_WIDTH}"
    if "\t" in line or line != line.rstrip():
        yield "a tab, or a blank at the end"
    if not line.isascii():
        yield "not all tools read characters beyond ASCII"


def format_breaches(root, paths):
    result = subprocess.run(["clang-format", "--dry-run", "-Werror", *map(str, paths)], cwd=root,
                            capture_output=True, text=True, check=False)
    for line in result.stderr.splitlines():
        if ": error:" in line:
            yield line.replace(str(root) + "/", "") + " (clang-format -i corrects it)"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    files = list(sources(root))
    found = [b for layer, path in files for b in breaches(root, layer, path)]
    found += check_layers.breaches(root, check_layers.load(root))
    found += format_breaches(root, [path for _, path in files if path.suffix in (".hpp", ".cpp")])
    print("\n".join(found) if found else f"{len(files)} files are in order")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
