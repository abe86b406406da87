// Parses any bytes as G-code: the result is a program within travel, or errors with line and column.
#include <cmath>
#include <cstdint>
#include <string>

#include "core/gcode/gcode.hpp"
#include "tests/fuzz/require.hpp"

namespace lockstep {
namespace {

void check_move(const ProgramMove& move, const GcodeSetup& setup) {
    require(move.target_mm.size() == setup.axes.size(), "a move has a target for each axis");
    for (std::size_t i = 0; i < setup.axes.size(); ++i) {
        const bool within = move.target_mm[i] >= setup.axes[i].min_mm && move.target_mm[i] <= setup.axes[i].max_mm;
        require(within, "a target is within travel");
    }
    require(move.rapid || (move.feed_mm_s > 0 && move.feed_mm_s <= kMaxFeed_mm_s), "a feed is within its bounds");
}

}  // namespace
}  // namespace lockstep

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace lockstep;
    static const GcodeSetup setup{.program_name = "any",
                                  .axes = {{"X", 0, 200, 5, 0}, {"Y", -50, 50, 0, 1}, {"C", -360, 360, 0, 0}},
                                  .limits = {.repeated_lines = 20'000}};
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto program = parse_gcode(text, setup);
    if (!program) {
        require(!program.error().empty(), "a refusal has an error");
        for (const GcodeError& error : program.error()) {
            require(error.line >= 1 && error.column >= 1 && !error.message.empty(), "an error has a place and a text");
        }
        return 0;
    }
    for (const Block& block : program->blocks) {
        require(block.line >= 1, "a block has its line");
        if (const auto* move = std::get_if<ProgramMove>(&block.action)) { check_move(*move, setup); }
        if (const auto* dwell = std::get_if<Dwell>(&block.action)) {
            require(dwell->seconds >= 0 && std::isfinite(dwell->seconds), "a dwell has a length");
        }
    }
    return 0;
}
