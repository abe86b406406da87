#include "core/program.hpp"

#include <algorithm>

namespace lockstep {

std::expected<Program, std::optional<std::int32_t>> program_from(const Program& program, std::int32_t line,
                                                                 std::vector<double> at_mm) {
    const auto first = std::find_if(program.blocks.begin(), program.blocks.end(),
                                    [&](const Block& block) { return block.line >= line; });
    if (first == program.blocks.end()) {
        return std::unexpected(program.blocks.empty() ? std::nullopt : program.blocks.back().line);
    }
    std::vector<double> begins_mm = program.start_mm;
    for (auto block = program.blocks.begin(); block != first; ++block) {
        if (const auto* move = std::get_if<ProgramMove>(&block->action)) { begins_mm = move->target_mm; }
    }
    Program rest{.name = program.name, .axes = program.axes, .start_mm = std::move(at_mm)};
    if (rest.start_mm != begins_mm) { rest.blocks.push_back({first->line, ProgramMove{begins_mm, 0, true}}); }
    rest.blocks.insert(rest.blocks.end(), first, program.blocks.end());
    return rest;
}

std::string line_label(std::optional<std::int32_t> line) { return line ? "line " + std::to_string(*line) + ": " : ""; }

}  // namespace lockstep
