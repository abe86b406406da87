// Reads G-code into moves. All modal words are resolved, and every target is absolute, in mm.
#include <cstdio>

#include "core/gcode/gcode.hpp"

int main() {
    using namespace lockstep;
    const char* const text =
        "#<side> = 20\n"
        "G21 G90 F1200\n"
        "o1 repeat [4]\n"
        "  G91 G1 X#<side>\n"
        "  G3 X5 Y5 I0 J5\n"
        "o1 endrepeat\n"
        "M2\n";
    const GcodeSetup setup{.program_name = "corners",
                           .axes = {{.name = "X", .max_mm = 200}, {.name = "Y", .max_mm = 200}},
                           .chord_tolerance_mm = 0.1};
    const auto program = parse_gcode(text, setup);
    if (!program) {
        for (const GcodeError& error : program.error()) {
            std::printf("corners:%d:%d: %s\n", error.line, error.column, error.message.c_str());
        }
        return 1;
    }
    for (const Block& block : program->blocks) {
        if (const auto* move = std::get_if<ProgramMove>(&block.action)) {
            std::printf("line %d: to X%.4f Y%.4f at %.1f mm/s\n", block.line.value_or(0), move->target_mm[0],
                        move->target_mm[1], move->feed_mm_s);
        }
    }
}
