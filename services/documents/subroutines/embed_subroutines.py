#!/usr/bin/env python3
"""Makes a C++ source that contains the subroutines of a directory, files NAME.ngc.

Usage: embed_subroutines.py DIRECTORY OUT.cpp
"""
import pathlib
import sys

HEAD = """#include "services/documents/subroutines/builtin_subroutines.hpp"

#include <array>
#include <utility>

namespace lockstep {

std::optional<std::string_view> builtin_subroutine(std::string_view name) {
    static constexpr std::array kTexts{
"""
TAIL = """    };
    for (const auto& [known, text] : kTexts) {
        if (known == name) { return text; }
    }
    return std::nullopt;
}

}  // namespace lockstep
"""


def main():
    directory, out = map(pathlib.Path, sys.argv[1:])
    rows = "".join(f'        std::pair<std::string_view, std::string_view>{{"{path.stem}", R"ngc({path.read_text()})ngc"}},\n'
                   for path in sorted(directory.glob("*.ngc")))
    out.write_text(HEAD + rows + TAIL)


if __name__ == "__main__":
    main()
