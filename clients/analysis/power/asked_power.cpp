#include "clients/analysis/power/asked_power.hpp"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "core/arc_path.hpp"
#include "core/outputs/output_levels.hpp"
#include "core/program_devices.hpp"

namespace lockstep::analysis {
namespace {

constexpr double kPowerChord_mm = 0.01;  // maximum distance of a chord from its arc

PowerSums asked_of(const ProgramMove& move, const OutputConfig& output, const ProgramDevices& devices, double in_plane,
                   double length) {
    const bool is_off = move.rapid && follows_speed(output, devices);
    const double power = is_off ? 0 : share_of(output, devices);
    const double seconds = move.rapid || move.feed_mm_s <= 0 ? 0 : length / move.feed_mm_s;
    return {.path_mm = in_plane,
            .burned_mm = power > 0 ? in_plane : 0,
            .power_mm = power * in_plane,
            .energy_s = power * seconds};
}

double length_between(const std::vector<double>& a, const std::vector<double>& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) { squares += (a[i] - b[i]) * (a[i] - b[i]); }
    return std::sqrt(squares);
}

}  // namespace

void add_asked_power(const RecordedProgram& program, const OutputConfig& output, PowerGrid& grid) {
    const ProgramHead& head = program.head();
    const auto x = static_cast<std::size_t>(std::ranges::find(head.axes, "X") - head.axes.begin());
    const auto y = static_cast<std::size_t>(std::ranges::find(head.axes, "Y") - head.axes.begin());
    if (x == head.axes.size() || y == head.axes.size()) { return; }
    ProgramDevices devices;
    std::vector<double> at = head.start_mm;
    for (std::uint32_t number = 0; const Block* block = program.block(number); ++number) {
        if (const auto* event = std::get_if<ProgramEvent>(&block->action)) { devices.apply(*event); }
        const auto* move = std::get_if<ProgramMove>(&block->action);
        if (move == nullptr) { continue; }
        const std::vector<double> from = at;
        each_chord(*move, from, kPowerChord_mm, [&](const std::vector<double>& to) {
            const double in_plane = std::hypot(to[x] - at[x], to[y] - at[y]);
            const PowerSums sums = asked_of(*move, output, devices, in_plane, length_between(at, to));
            if (in_plane > 0) { grid.add({at[x], at[y]}, {to[x], to[y]}, sums); }
            at = to;
        });
        at = move->target_mm;
    }
}

}  // namespace lockstep::analysis
