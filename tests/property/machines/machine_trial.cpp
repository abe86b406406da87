#include "tests/property/machines/machine_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "clients/session/move_program.hpp"
#include "tests/records/machine_run.hpp"
#include "tests/records/verdicts.hpp"

namespace lockstep {
namespace {

/// The time of a move of the axis alone.
double seconds(const AxisConfig& axis, double mm, double top_mm_s) {
    const double accel = std::min(axis.max_accel_mm_s2, axis.max_decel_mm_s2);
    const double start = std::min(axis.start_velocity_mm_s, top_mm_s);
    const double ramp = std::min(2 * std::sqrt(mm / accel), mm / start);
    return ramp + mm / top_mm_s;
}

/// How far an axis moves in a job: at least a few steps where the travel has them, and for at most about a second.
double reach_mm(const AxisConfig& axis) {
    const double step = 1 / axis.steps_per_mm;
    const double travel = axis.position_max_mm - axis.position_min_mm;
    const double a = std::min(axis.max_accel_mm_s2, axis.max_decel_mm_s2);
    const double fast = std::min(axis.max_velocity_mm_s, std::max(axis.start_velocity_mm_s, a * 0.5));
    return std::min({travel, std::max(4 * step, fast * 0.5), 8000 * step});
}

/// A place at most reach_mm from where the axis parks.
double place_near_park(const AxisConfig& axis, double share) {
    const double park = axis.homing.park_mm;
    const double room_above = axis.position_max_mm - park;
    const double reach = reach_mm(axis);
    const double mm = room_above >= reach / 2 ? park + std::min(reach, room_above) * share
                                              : park - std::min(reach, park - axis.position_min_mm) * share;
    const double steps = mm * axis.steps_per_mm;  // a whole step within travel
    const double whole = std::clamp(std::round(steps), std::ceil(axis.position_min_mm * axis.steps_per_mm),
                                    std::max(std::ceil(axis.position_min_mm * axis.steps_per_mm),
                                             std::floor(axis.position_max_mm * axis.steps_per_mm)));
    return std::clamp(whole / axis.steps_per_mm, axis.position_min_mm, axis.position_max_mm);
}

/// How much longer an own move takes by a method that begins at rest whatever the start velocity.
double seconds_from_rest(const AxisConfig& axis, double mm) {
    if (axis.method == StepMethod::Ranade || axis.method == StepMethod::Carrica) { return 0; }
    return 2 * std::sqrt(mm / std::min(axis.max_accel_mm_s2, axis.max_decel_mm_s2));
}

double homing_seconds(const AxisConfig& axis) {
    const HomingConfig& homing = axis.homing;
    const double search = std::abs(axis.plant.start_position_mm - homing.switch_position_mm) + 3 * homing.pulloff_mm;
    const double park = std::abs(homing.park_mm - homing.switch_position_mm);
    return search / homing.search_velocity_mm_s + 2 * homing.pulloff_mm / homing.latch_velocity_mm_s +
           seconds(axis, park, axis.max_velocity_mm_s) + seconds_from_rest(axis, search) +
           2 * seconds_from_rest(axis, homing.pulloff_mm) + seconds_from_rest(axis, park);
}

/// Places for all axes, each a share of its reach from park.
std::vector<std::string> targets(const MachineSetup& machine, std::mt19937_64& random) {
    std::vector<std::string> words;
    for (const AxisConfig& axis : machine.axes) {
        const double share = static_cast<double>(random() % 1001) * 1e-3;
        words.push_back(fmt::format("{}={}", axis.name, place_near_park(axis, share)));
    }
    return words;
}

std::string fixed(double value) { return fmt::format("{:.9f}", value); }

/// Two straight moves of all axes and a return, at a random feed.
std::string gcode_job(const MachineSetup& machine, std::mt19937_64& random) {
    double path = 0;
    double longest_s = 0;
    for (const AxisConfig& axis : machine.axes) {
        path = std::hypot(path, reach_mm(axis));
        longest_s = std::max(longest_s, seconds(axis, reach_mm(axis), axis.max_velocity_mm_s));
    }
    const bool is_lai = machine.coordination == StepMethod::Lai;  // it refuses slow feeds
    const double feed_mm_min = is_lai ? 6e7 : std::clamp(60 * path / longest_s, 1e-2, 5e7);
    std::string text = fmt::format("G21 G90 G94\n{}\nG0", random() % 2 == 0 ? "G64" : "G61");
    for (int line = 0; line < 5; ++line) {
        if (line == 1) { text += fmt::format("\nG1 F{}", fixed(feed_mm_min)); }
        if (line > 1) { text += "\n"; }
        for (const AxisConfig& axis : machine.axes) {
            if (random() % 4 == 0 && line < 4) { continue; }
            const double share = static_cast<double>(random() % 1001) * 1e-3;
            text +=
                fmt::format(" {}{}", axis.name, fixed(line == 4 ? axis.homing.park_mm : place_near_park(axis, share)));
        }
    }
    return text + "\n";
}

VirtualOptions options_of(const MachineSetup& machine, std::uint64_t seed) {
    VirtualOptions options = records::options_of(machine);
    options.seed = seed;
    options.network.delay_min = options.network.delay_max =
        Ticks{std::max<std::int64_t>(1, machine.slot_ticks().value / 40)};
    return options;
}

}  // namespace

TrialCost cost_of_trial(const MachineSetup& machine) {
    double homing_s = 0;
    double jobs_s = 0;
    TrialCost cost;
    for (const AxisConfig& axis : machine.axes) {
        homing_s += homing_seconds(axis);
        jobs_s = std::max(jobs_s, 14 * seconds(axis, reach_mm(axis), axis.max_velocity_mm_s));
        const double mm = std::abs(axis.plant.start_position_mm - axis.homing.switch_position_mm) +
                          4 * axis.homing.pulloff_mm + std::abs(axis.homing.park_mm - axis.homing.switch_position_mm) +
                          14 * reach_mm(axis);
        cost.steps += mm * axis.steps_per_mm;
    }
    const double slots = (homing_s + jobs_s) * 1e6 / static_cast<double>(machine.timing.slot_us);
    cost.loops = (slots + 20.0 * machine.timing.send_ahead_slots) * 2 * static_cast<double>(machine.axes.size() + 1);
    return cost;
}

std::string trouble_of(const MachineSetup& machine, std::uint64_t seed) {
    using records::Tool;
    std::mt19937_64 random(seed);
    try {
        records::MachineRun run(options_of(machine, seed));
        run.home();
        run.run(gcode_job(machine, random));
        run.require_success("a program");
        run.move({.targets = targets(machine, random)});
        run.move({.targets = targets(machine, random), .own = true});
        run.wait_ms(200 + machine.timing.slot_us * 20 / 1000);
        const records::Judgement judgement = records::judge(run.finish());
        for (const Tool tool : {Tool::Verify, Tool::Analyze}) {
            if (judgement.of(tool) != records::kSaysGood) {
                return fmt::format("{}: {}", records::name_of(tool), judgement.text_of(tool));
            }
        }
    } catch (const std::exception& error) { return error.what(); }
    return {};
}

}  // namespace lockstep
