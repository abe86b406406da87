#include "clients/lockstep/job/restart.hpp"

#include <fmt/format.h>

#include <utility>

namespace lockstep {
namespace {

std::expected<std::vector<ApproachMove>, std::string> find_approach(const RestartOptions& options,
                                                                    const MachineConfig& machine,
                                                                    const Program& program,
                                                                    const std::vector<double>& stands_mm,
                                                                    const std::vector<double>& begins_mm) {
    if (stands_mm == begins_mm) { return {}; }
    if (options.straight) { return straight_approach(stands_mm, begins_mm); }
    const auto lifts = lifts_of(machine, options.lift);
    if (!lifts) { return std::unexpected(lifts.error()); }
    return approach(machine, *lifts, stands_mm, begins_mm, feed_before(program, options.from_line));
}

}  // namespace

std::expected<Rest, std::string> rest_of(const Program& program, std::string_view text, const GcodeSetup& setup,
                                         const RestartOptions& options, const MachineConfig& machine,
                                         const std::vector<double>& stands_mm) {
    return rest_of(program, modal_state_at(text, setup, options.from_line), options, machine, stands_mm);
}

std::expected<Rest, std::string> rest_of(const Program& program, ModalState modal, const RestartOptions& options,
                                         const MachineConfig& machine, const std::vector<double>& stands_mm) {
    const std::vector<double> begins_mm = place_before(program, options.from_line);
    auto left = program_from(program, options.from_line, begins_mm);
    if (!left) {
        return std::unexpected(fmt::format("nothing is left from line {}; the last motion is in line {}",
                                           options.from_line, left.error().value_or(0)));
    }
    auto moves = find_approach(options, machine, program, stands_mm, begins_mm);
    if (!moves) { return std::unexpected(moves.error()); }
    left->start_mm = stands_mm;
    std::vector<Block> blocks;
    for (const ApproachMove& step : *moves) { blocks.push_back({left->blocks.front().line, step.move}); }
    left->blocks.insert(left->blocks.begin(), blocks.begin(), blocks.end());
    return Rest{*std::move(left), *std::move(moves), std::move(modal)};
}

}  // namespace lockstep
