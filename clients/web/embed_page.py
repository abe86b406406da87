#!/usr/bin/env python3
"""Makes a C++ source that contains the files of a directory: the assembler includes their bytes.

Usage: embed_page.py DIRECTORY OUT.cpp    A directory that is missing or empty gives a source without files.
"""
import hashlib
import pathlib
import re
import sys

TYPES = {
    ".html": "text/html; charset=utf-8", ".js": "text/javascript; charset=utf-8", ".css": "text/css; charset=utf-8",
    ".json": "application/json", ".svg": "image/svg+xml", ".png": "image/png", ".ico": "image/x-icon",
    ".webmanifest": "application/manifest+json", ".woff2": "font/woff2", ".txt": "text/plain; charset=utf-8",
    ".wasm": "application/wasm",
}
HASHED = re.compile(r"-[A-Za-z0-9_-]{8,}\.[a-z0-9]+$")


def part(number, path, name):
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:32]
    symbol = f"lockstep_page_{number}"
    included = f"""asm(".pushsection .rodata\\n.balign 16\\n{symbol}:\\n.incbin \\"{path}\\"\\n{symbol}_end:\\n.popsection\\n");
extern const char {symbol}[] __attribute__((visibility("hidden")));
extern const char {symbol}_end[] __attribute__((visibility("hidden")));
"""
    kind = TYPES.get(path.suffix, "application/octet-stream")
    kept = "true" if HASHED.search(path.name) else "false"
    row = f'        {{"/{name}", {{{symbol}, {symbol}_end}}, "{kind}", "\\"{digest}\\"", {kept}}},\n'
    return included, row


def main():
    directory, out = map(pathlib.Path, sys.argv[1:])
    files = sorted(path for path in directory.rglob("*") if path.is_file()) if directory.is_dir() else []
    parts = [part(i, path.resolve(), path.relative_to(directory).as_posix()) for i, path in enumerate(files)]
    rows = "".join(row for _, row in parts)
    table = (f"    static const std::array<Asset, {len(parts)}> kAssets{{{{\n{rows}    }}}};\n    return kAssets;\n"
             if parts else "    return {};\n")
    symbols = 'extern "C" {\n' + "".join(included for included, _ in parts) + "}\n\n" if parts else ""
    out.write_text('#include <array>\n\n#include "clients/web/api/assets.hpp"\n\n' + symbols +
                   "namespace lockstep::web {\n\nstd::span<const Asset> embedded_assets() {\n" + table + "}\n\n}\n")


if __name__ == "__main__":
    main()
