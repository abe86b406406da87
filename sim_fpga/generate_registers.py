#!/usr/bin/env python3
"""Makes the C++ constants, the Verilog constants and the documentation of the register map from its one source.

usage: generate_registers.py registers.json (--hpp | --vh | --md) FILE
       generate_registers.py registers.json --check DIRECTORY    exit 1 where a committed file is not up to date
"""
import hashlib
import json
import pathlib
import sys

NOTE = "Generated from sim_fpga/registers.json; edit that."


def without_meanings(node):
    if isinstance(node, dict):
        return {key: without_meanings(value) for key, value in node.items() if key != "meaning"}
    return [without_meanings(item) for item in node] if isinstance(node, list) else node


def checksum(source):
    """The checksum of everything on which both sides must agree: all but the meanings."""
    text = json.dumps(without_meanings(source), sort_keys=True, separators=(",", ":"))
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "big")


def number(text):
    return int(text, 16)


def extents(source):
    """(name, first byte, end) of everything in the window."""
    for register in source["registers"]:
        yield register["name"], number(register["offset"]), number(register["offset"]) + 8
    for ring in source["rings"]:
        start = number(ring["offset"])
        yield ring["name"], start, start + ring["most_entries"] * ring["entry_bytes"]
        most = ring["most_entries"]
        assert most & (most - 1) == 0, f"{ring['name']}: entries must be a power of two"


def verify(source):
    """Checks that words are aligned and inside the window, and that no two share a byte, nor two fields a bit."""
    end = 0
    for name, start, stop in sorted(extents(source), key=lambda extent: extent[1]):
        assert start % 8 == 0 and start >= end, f"{name}: not aligned, or it overlaps what is before it"
        end = stop
    assert end <= number(source["window_bytes"]), "the window is too small"
    for name, word in all_words(source):
        used = [(bit["bit"], 1) for bit in word.get("bits", [])]
        used += [(field["low"], field["bits"]) for field in word.get("fields", [])]
        end = 0
        for low, bits in sorted(used):
            assert low >= end and low + bits <= 64, f"{name}: bit {low} is used twice, or beyond the word"
            end = low + bits


def entry_words(ring):
    """(PREFIX_NAME, word) of all words of all kinds of entries of a ring."""
    for entry in ring["entries"]:
        prefix = "_".join(part for part in (ring["name"], entry.get("name")) if part)
        for word in entry["words"]:
            yield f"{prefix}_{word['name']}", word


def all_words(source):
    for register in source["registers"]:
        yield register["name"], register
    for ring in source["rings"]:
        yield from entry_words(ring)


def constants(source):
    """(NAME, value, meaning, kind) of everything, in the map's order.

    Kinds: wide (64 bits), address, count, bit, field (its value is (low, bits)).
    """
    yield "WINDOW_BYTES", number(source["window_bytes"]), "", "count"
    magic = next(register for register in source["registers"] if register["name"] == "MAGIC")
    yield "MAGIC_VALUE", number(magic["reset"]), "", "wide"
    yield "VERSION_VALUE", source["version"], "", "wide"
    yield "MAP_CHECKSUM_VALUE", checksum(source), "", "wide"
    for register in source["registers"]:
        yield register["name"], number(register["offset"]), register["meaning"], "address"
        yield from choices(register)
    for ring in source["rings"]:
        yield ring["name"], number(ring["offset"]), ring["meaning"], "address"
        yield f"{ring['name']}_MOST_ENTRIES", ring["most_entries"], "", "count"
        yield f"{ring['name']}_ENTRY_BYTES", ring["entry_bytes"], "", "count"
        for name, word in entry_words(ring):
            yield name, number(word["offset"]), word["meaning"], "address"
            yield from choices({**word, "name": name})


def choices(word):
    for bit in word.get("bits", []):
        yield f"{word['name']}_{bit['name']}", bit["bit"], bit["meaning"], "bit"
    for field in word.get("fields", []):
        yield f"{word['name']}_{field['name']}", (field["low"], field["bits"]), field["meaning"], "field"
    for value in word.get("values", []):
        yield f"{word['name']}_{value['name']}", value["value"], value["meaning"], "wide"


def camel(name):
    return "k" + "".join(part.capitalize() for part in name.split("_"))


def hpp(source):
    forms = {"wide": ("std::uint64_t", "0x{:X}"), "address": ("std::size_t", "0x{:X}"), "count": ("std::size_t", "{}"),
             "bit": ("std::uint64_t", "std::uint64_t{{1}} << {}"), "field": ("RegisterField", "{{{0[0]}, {0[1]}}}")}
    lines = [f"// The register map: byte offsets into the window, bits and values. {NOTE}", "#pragma once", "",
             "#include <cstddef>", "#include <cstdint>", "", '#include "sim_fpga/register_field.hpp"', "",
             "namespace lockstep::registers {", ""]
    for name, value, meaning, kind in constants(source):
        lines += [f"/// {meaning}"] if meaning else []
        lines.append(f"inline constexpr {forms[kind][0]} {camel(name)} = {forms[kind][1].format(value)};")
    return "\n".join(lines + ["", "}  // namespace lockstep::registers", ""])


def vh(source):
    forms = {"wide": "[63:0] LOCKSTEP_{} = 64'h{:X}", "address": "[19:0] LOCKSTEP_{} = 20'h{:05X}",
             "count": "LOCKSTEP_{} = {}", "bit": "LOCKSTEP_{}_BIT = {}",
             "field": "LOCKSTEP_{0}_LOW = {1[0]}, LOCKSTEP_{0}_BITS = {1[1]}"}
    lines = [f"// The register map: byte offsets, bit numbers and values. {NOTE}"]
    lines += [f"localparam {forms[kind].format(name, value)};" for name, value, _, kind in constants(source)]
    return "\n".join(lines + [""])


def choice_rows(word):
    for bit in word.get("bits", []):
        yield f"| | bit {bit['bit']} | | | `{bit['name']}`: {bit['meaning']} |"
    for field in word.get("fields", []):
        bits = f"{field['low']} to {field['low'] + field['bits'] - 1}"
        yield f"| | bits {bits} | | | `{field['name']}`: {field['meaning']} |"
    for value in word.get("values", []):
        yield f"| | {value['value']} | | | `{value['name']}`: {value['meaning']} |"


def md(source):
    lines = [f"# {source['title']}: register map, version {source['version']}", "", f"<!-- {NOTE} -->", "",
             f"One flat window of {source['window_bytes']} bytes; all words have 64 bits, little-endian. It behaves as",
             "memory: no access has a side effect, and each word is written by one side alone, the device or the host",
             "(power-up resets both sides' words). So the same map holds over ordinary memory, shared memory, a mapped file",
             "or a mapped device. Every word is read with acquire order and written with release order: a reader of a new",
             "head, sequence or run number also sees what was written before it.", "",
             f"Map checksum: `0x{checksum(source):016X}`", "", "## Registers", "",
             "| offset | name | writer, host's access | reset | meaning |", "|---|---|---|---|---|"]
    for r in source["registers"]:
        lines.append(f"| {r['offset']} | `{r['name']}` | {r['writer']}, {r['access']} | {r['reset']} | {r['meaning']} |")
        lines += choice_rows(r)
    for ring in source["rings"]:
        place = f"(n mod {ring['entries_in']})" if "entries_in" in ring else "n"  # a ring, or a table
        lines += ["", f"## {ring['name']}", "", f"From {ring['offset']}: entries of {ring['entry_bytes']} bytes, "
                  f"written by the {ring['writer']}. Entry n is at {ring['offset']} + {place} x "
                  f"{ring['entry_bytes']}. {ring['meaning']}"]
        for entry in ring["entries"]:
            lines += ["", f"### {entry['name']}", "", entry["meaning"]] if "name" in entry else []
            lines += ["", "| offset in entry | name | | | meaning |", "|---|---|---|---|---|"]
            for word in entry["words"]:
                lines.append(f"| {word['offset']} | `{word['name']}` | | | {word['meaning']} |")
                lines += choice_rows(word)
    return "\n".join(lines + [""])


def stale_files(source, directory):
    committed = {"REGISTERS.md": md(source), "registers.vh": vh(source)}
    return [name for name, text in committed.items() if (directory / name).read_text() != text]


def main(arguments):
    if len(arguments) != 3 or arguments[1] not in ("--hpp", "--vh", "--md", "--check"):
        sys.exit(__doc__)
    source = json.loads(pathlib.Path(arguments[0]).read_text())
    verify(source)
    form, target = arguments[1], pathlib.Path(arguments[2])
    if form == "--check":
        stale = stale_files(source, target)
        sys.exit(f"not up to date: {', '.join(stale)}; build target lockstep_registers_doc" if stale else 0)
    target.write_text({"--hpp": hpp, "--vh": vh, "--md": md}[form](source))


main(sys.argv[1:])
