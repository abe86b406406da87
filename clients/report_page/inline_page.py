#!/usr/bin/env python3
"""Writes an HTML page, with its scripts and styles inlined, as a C++ string.

Usage: inline_page.py NAME PAGE.html OUT.cpp    NAME is the C++ variable. Scripts and styles are beside the page.
"""
import pathlib
import re
import sys


def main():
    name = sys.argv[1]
    page, out = map(pathlib.Path, sys.argv[2:])

    def read(found):
        return (page.parent / found[1]).read_text()

    text = page.read_text()
    text = re.sub(r'<link rel="stylesheet" href="([^"]+)">', lambda found: f"<style>\n{read(found)}</style>", text)
    text = re.sub(r'<script src="([^"]+)"></script>', lambda found: f"<script>\n{read(found)}</script>", text)
    out.write_text('#include "clients/report_page/page_template.hpp"\n\nnamespace lockstep::analysis {\n\n'
                   f'const std::string_view {name} = R"page({text})page";\n\n}}\n')


if __name__ == "__main__":
    main()
