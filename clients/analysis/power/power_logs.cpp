#include "clients/analysis/power/power_logs.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "clients/analysis/power/asked_power.hpp"
#include "core/outputs/output_levels.hpp"

namespace lockstep::analysis {
namespace {

std::optional<double> place_mm(const HappenedEvent& event, const char* axis) {
    const auto found = std::ranges::find(event.place, axis, &ProgramPlace::value_type::first);
    return found == event.place.end() ? std::nullopt : std::optional(found->second);
}

/// The places at which words of programs switch the output in motion.
std::vector<PlacedWord> words_for(const OutputConfig& output, const std::vector<HappenedEvent>& events) {
    std::vector<PlacedWord> words;
    for (const HappenedEvent& event : events) {
        if (event.at_rest || !is_switched_by(output, event.event)) { continue; }
        const auto x = place_mm(event, "X");
        const auto y = place_mm(event, "Y");
        if (x && y) { words.push_back({event.at, {*x, *y}}); }
    }
    return words;
}

}  // namespace

bool PowerLogs::begin(const MachineConfig& machine, const Kinematics& kinematics) {
    if (!powers_.empty()) { return false; }
    const auto x = machine.axis_named("X");
    const auto y = machine.axis_named("Y");
    if (!x || !y) { return false; }
    const double step_mm = std::max(kinematics.step_mm(*x), kinematics.step_mm(*y));
    for (const OutputConfig& output : machine.outputs) {
        if (!output.is_analog()) { continue; }
        PowerMeter meter(PowerTrack(output.motor, output.channel), step_mm, machine.tick_ns);
        PowerGrid asked(meter.made().cell_mm());
        powers_.emplace_back(output, std::move(meter), std::move(asked));
    }
    return !powers_.empty();
}

void PowerLogs::ask(const RecordedProgram& program) {
    for (PowerLog& power : powers_) { add_asked_power(program, power.output, power.asked); }
}

void PowerLogs::take(const channel_event_t& message) {
    for (PowerLog& power : powers_) { power.meter.take(message); }
}

void PowerLogs::at(Tick tick, drawing::Point place_mm) {
    for (PowerLog& power : powers_) { power.meter.at(tick, place_mm); }
}

std::vector<PowerMap> PowerLogs::finish(const std::vector<HappenedEvent>& events) {
    std::vector<PowerMap> maps;
    for (PowerLog& power : powers_) {
        power.meter.finish();
        PowerMap map = power_map(power.output.name, std::move(power.asked), power.meter.made(),
                                 words_for(power.output, events), power.meter.changes());
        if (!map.asked.is_empty()) { maps.push_back(std::move(map)); }
    }
    return maps;
}

}  // namespace lockstep::analysis
