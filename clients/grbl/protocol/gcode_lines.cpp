#include "clients/grbl/protocol/gcode_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <variant>

#include "core/arc_path.hpp"
#include "core/if_positive.hpp"
#include "services/documents/program_file.hpp"

namespace lockstep::grbl {
namespace {

constexpr int kFirstMotion = 0;  // grbl begins with G0

bool comes_to_rest(const Block& block) {
    const auto* move = std::get_if<ProgramMove>(&block.action);
    if (move != nullptr) { return move->mode == PathMode::ExactStop; }
    return !std::holds_alternative<ProgramEvent>(block.action);
}

/// The N word, after blanks and a slash; nullopt without one or if it does not fit 32 bits.
std::optional<std::int32_t> sender_line_of(std::string_view line) {
    const std::size_t begin = line.find_first_not_of(" \t/");
    if (begin == line.npos || (line[begin] != 'N' && line[begin] != 'n')) { return std::nullopt; }
    std::int32_t number = 0;
    const auto read = std::from_chars(line.data() + begin + 1, line.data() + line.size(), number);
    return read.ec == std::errc{} ? if_positive(number) : std::nullopt;
}

}  // namespace

GcodeLines::GcodeLines(const MachineSetup& machine)
    : machine_(machine), session_(session_setup(machine, "lines of a sender"), machine, kFirstMotion) {}

bool GcodeLines::switch_off() {
    const gcode::Modal& modal = session_.state().modal;
    const bool was_on = modal.spindle != SpindleDirection::Stopped || modal.mist || modal.flood;
    session_.set_devices({});
    return was_on;
}

std::expected<LineEffect, Refused> GcodeLines::read(std::string_view line, const std::vector<double>& place_mm,
                                                    const gcode::KeptValues& values) const {
    auto read = session_.read(line, {place_mm, values});
    if (!read) { return std::unexpected(Refused{error_of(read.error().message), read.error().message}); }
    if (read->changes_values && !read->blocks.empty()) {
        return std::unexpected(Refused{Error::TwoAxisCommands, "a line that sets offsets cannot also move axes"});
    }
    LineEffect effect{.line = *std::move(read)};
    effect.sender_line = sender_line_of(line);
    effect.seconds = seconds_of(effect.line);
    effect.rests_before = rests_before(effect.line);
    effect.rests_behind = std::ranges::any_of(effect.line.blocks, comes_to_rest);
    return effect;
}

bool GcodeLines::rests_before(const SessionLine& line) const {
    const gcode::State& before = session_.state();
    const gcode::State& after = line.after.state;
    return line.changes_values || line.ends_program || line.awaits_touch || before.modal.system != after.modal.system ||
           before.offsets.tool != after.offsets.tool;
}

/// The duration at the feed, or at the axes' maximum velocity if that is slower, without ramps.
double GcodeLines::seconds_of(const SessionLine& line) const {
    double seconds = 0;
    std::vector<double> at = line.head.start_mm;
    for (const Block& block : line.blocks) {
        if (const auto* dwell = std::get_if<Dwell>(&block.action)) { seconds += dwell->seconds; }
        const auto* move = std::get_if<ProgramMove>(&block.action);
        if (move == nullptr) { continue; }
        double least = 0;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const double way = std::abs(move->target_mm[i] - at[i]);
            least = std::max(least, way / machine_.axes[i].max_velocity_mm_s);
        }
        seconds += move->rapid ? least : std::max(least, length_mm(*move, at) / move->feed_mm_s);
        at = move->target_mm;
    }
    return seconds;
}

std::string GcodeLines::modes_text() const { return fmt::format("{}", fmt::join(active_words(session_.state()), " ")); }

std::vector<double> GcodeLines::offset_mm(const gcode::KeptValues& values) const {
    const gcode::Point zero = gcode::to_machine(session_.offsets(values), {});
    std::vector<double> offset;
    for (const AxisConfig& axis : machine_.axes) {
        const auto letter = gcode::axis_place(axis.name);
        offset.push_back(letter ? zero[*letter] : 0);
    }
    return offset;
}

}  // namespace lockstep::grbl
