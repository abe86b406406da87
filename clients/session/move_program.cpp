#include "clients/session/move_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clients/text/format.hpp"
#include "core/axis_unit.hpp"
#include "core/gcode/gcode.hpp"
#include "core/parse_number.hpp"
#include "services/documents/names.hpp"

namespace lockstep {
namespace {

constexpr double kMaxOwnMove_s = 600;

std::optional<double> number(std::string_view text) {
    if (text.starts_with('+')) { text.remove_prefix(1); }
    const auto value = parse_number<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::expected<void, std::string> check_travel(const AxisConfig& axis, double mm) {
    const bool is_within =
        mm >= axis.position_min_mm - kTravelTolerance_mm && mm <= axis.position_max_mm + kTravelTolerance_mm;
    if (is_within) { return {}; }
    return std::unexpected(fmt::format("{}={} is outside the travel of axis {}, {} to {} {}", axis.name, fixed(mm, 4),
                                       axis.name, fixed(axis.position_min_mm, 3), fixed(axis.position_max_mm, 3),
                                       unit_of(axis.name)));
}

std::expected<void, std::string> check_feed(const MoveOptions& options) {
    if (!options.feed_mm_min) { return {}; }
    const double feed = *options.feed_mm_min;
    if (feed >= kMinFeedPerMinute && feed <= kMaxFeed_mm_s * 60) { return {}; }
    return std::unexpected(fmt::format("--feed {} is out of range; it must be from {} to {} mm/min", fixed(feed, 3),
                                       fixed(kMinFeedPerMinute, 2), fixed(kMaxFeed_mm_s * 60, 0)));
}

std::expected<void, std::string> check_own(const MachineConfig& machine, const MoveOptions& options) {
    if (options.own && options.feed_mm_min) {
        return std::unexpected(
            std::string("--feed is the speed along the common line of all axes; with --own there is no common line"));
    }
    if (!options.own && options.in_s) {
        return std::unexpected(std::string("--in is only for moves of axes on their own; add --own, or give a --feed"));
    }
    const double least_s = static_cast<double>(machine.tick_ns) * 1e-9;
    if (!options.in_s || (*options.in_s >= least_s && *options.in_s <= kMaxOwnMove_s)) { return {}; }
    return std::unexpected(fmt::format("--in {} is out of range; it must be from {} to {} s", fixed(*options.in_s, 6),
                                       fixed(least_s, 6), fixed(kMaxOwnMove_s, 0)));
}

}  // namespace

std::optional<Ticks> ticks_of(const MachineConfig& machine, const MoveOptions& options) {
    if (!options.in_s) { return std::nullopt; }
    return Ticks{std::llround(*options.in_s * machine.ticks_per_second())};
}

std::expected<AxisTarget, std::string> parse_target(std::string_view word) {
    const std::size_t at = word.find('=');
    const auto mm = at == word.npos ? std::nullopt : number(word.substr(at + 1));
    if (mm && at > 0) { return AxisTarget{std::string(word.substr(0, at)), *mm}; }
    return std::unexpected("'" + std::string(word) +
                           "' is not a target; write an axis, = and a place in mm: X=10 or Y=-3.5");
}

std::expected<AxisIndex, std::string> find_axis(const MachineConfig& machine, std::string_view name) {
    if (const auto found = axis_in_any_case(machine, name)) { return *found; }
    return std::unexpected(fmt::format("machine '{}' has no axis '{}'; it has: {}", machine.name, name,
                                       fmt::join(machine.axis_names(), " ")));
}

std::expected<Program, std::string> move_program(const MachineConfig& machine, const std::vector<double>& start_mm,
                                                 const MoveOptions& options) {
    if (auto checked = check_feed(options); !checked) { return std::unexpected(checked.error()); }
    if (auto checked = check_own(machine, options); !checked) { return std::unexpected(checked.error()); }
    ProgramMove move{
        .target_mm = start_mm, .feed_mm_s = options.feed_mm_min.value_or(0) / 60, .rapid = !options.feed_mm_min};
    std::vector<bool> is_named(machine.axes.size());
    for (const std::string& word : options.targets) {
        const auto target = parse_target(word);
        if (!target) { return std::unexpected(target.error()); }
        const auto axis = find_axis(machine, target->axis);
        if (!axis) { return std::unexpected(axis.error()); }
        if (is_named[*axis]) { return std::unexpected("axis " + machine.axes[*axis].name + " is named twice"); }
        is_named[*axis] = true;
        move.target_mm[*axis] = target->mm + (options.relative ? start_mm[*axis] : 0);
        if (auto checked = check_travel(machine.axes[*axis], move.target_mm[*axis]); !checked) {
            return std::unexpected(checked.error());
        }
    }
    return Program{
        .name = "move", .axes = machine.axis_names(), .start_mm = start_mm, .blocks = {{.action = std::move(move)}}};
}

namespace {

std::string probes_text(const MachineConfig& machine) {
    std::string text;
    for (const InputConfig& input : machine.inputs) {
        if (input.use == InputUse::Probe) { text += fmt::format(" {} ({})", input.number.value_or(0), input.name); }
    }
    return text;
}

}  // namespace

std::expected<int, std::string> chosen_probe(const MachineConfig& machine, std::optional<int> number) {
    const std::string probes = probes_text(machine);
    if (probes.empty()) { return std::unexpected("the machine has no probe; write input { use: PROBE } in its file"); }
    const auto is_probe = [](const InputConfig& input) { return input.use == InputUse::Probe; };
    if (!number && has_several_probes(machine.inputs)) {
        return std::unexpected("the machine has several probes; choose one by its number:" + probes);
    }
    const int chosen = number.value_or(std::ranges::find_if(machine.inputs, is_probe)->number.value_or(0));
    if (input_numbered(machine.inputs, InputUse::Probe, chosen) != nullptr) { return chosen; }
    return std::unexpected(fmt::format("the machine has no probe {}; it has:{}", chosen, probes));
}

std::expected<Program, std::string> probe_program(const MachineConfig& machine, const std::vector<double>& start_mm,
                                                  const ProbeOptions& options) {
    const auto probe = chosen_probe(machine, options.probe);
    if (!probe) { return std::unexpected(probe.error()); }
    if (!options.move.feed_mm_min) { return std::unexpected("a probing move needs a feed; write --feed, in mm/min"); }
    auto program = move_program(machine, start_mm, options.move);
    if (!program) { return program; }
    auto& move = std::get<ProgramMove>(program->blocks.front().action);
    if (move.target_mm == start_mm) {
        return std::unexpected("the axes stand at the end of this move already; write a place further on");
    }
    move.mode = PathMode::ExactStop;
    move.is_feed_fixed = true;
    program->name = "probe";
    program->blocks.insert(program->blocks.begin(),
                           {.action = Probe{.input = *probe, .opens = options.away, .must_touch = !options.may_miss}});
    return program;
}

}  // namespace lockstep
