#!/usr/bin/env python3
"""Packs a program for the flash of an RP2040 into a UF2 file, which the board's boot ROM takes as a file on its USB drive.

Usage: pack_uf2.py PROGRAM.elf PROGRAM.uf2    The first 252 bytes are the second stage of booting, which gets its CRC.
"""
import pathlib
import struct
import sys

FLASH = 0x10000000
FAMILY_RP2040 = 0xE48BFF56
HAS_FAMILY = 0x2000
BLOCK = 256
STAGE = 252


def image(elf):
    """What the flash contains, from its beginning: the segments at their load addresses."""
    table, = struct.unpack_from("<I", elf, 28)
    entry_size, entries = struct.unpack_from("<2H", elf, 42)
    flash = bytearray()
    for entry in range(entries):
        kind, offset, _, address, size = struct.unpack_from("<5I", elf, table + entry * entry_size)
        if kind == 1 and size > 0:
            at = address - FLASH
            flash = flash.ljust(at + size, b"\0")
            flash[at:at + size] = elf[offset:offset + size]
    return bytes(flash)


def crc32_mpeg2(data):
    """Not reflected, and not inverted at the end: as the boot ROM computes it."""
    rest = 0xFFFFFFFF
    for byte in data:
        rest ^= byte << 24
        for _ in range(8):
            rest = (rest << 1 ^ (0x04C11DB7 if rest >> 31 else 0)) & 0xFFFFFFFF
    return rest


def with_crc(program):
    return program[:STAGE] + struct.pack("<I", crc32_mpeg2(program[:STAGE])) + program[STAGE + 4:]


def blocks(program):
    parts = [program[at:at + BLOCK].ljust(BLOCK, b"\0") for at in range(0, len(program), BLOCK)]
    for number, part in enumerate(parts):
        yield struct.pack("<8I", 0x0A324655, 0x9E5D5157, HAS_FAMILY, FLASH + number * BLOCK, BLOCK, number, len(parts),
                          FAMILY_RP2040) + part.ljust(476, b"\0") + struct.pack("<I", 0x0AB16F30)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program = with_crc(image(pathlib.Path(sys.argv[1]).read_bytes()))
    pathlib.Path(sys.argv[2]).write_bytes(b"".join(blocks(program)))


if __name__ == "__main__":
    main()
