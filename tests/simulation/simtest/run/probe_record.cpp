#include "tests/simulation/simtest/run/probe_record.hpp"

#include <algorithm>
#include <cmath>

#include "core/coordinator/program/probe_check.hpp"
#include "core/kinematics/motors.hpp"
#include "tests/simulation/simtest/draw/draw_bounces.hpp"

namespace lockstep::simtest {
namespace {

/// A count is a place rounded to steps. Motors of one axis follow its path each within a step of the coarsest of them.
double within_steps(const Bench& bench, std::size_t motor) {
    constexpr double kHalf = 0.5 + 1e-6;
    if (bench.map().is_direct()) { return kHalf; }
    double most = 0;
    for (const AxisIndex axis : axis_indices(bench.machine().axes.size())) {
        most = std::max(most, std::abs(bench.map().share(motor, axis)) * bench.map().step_of(axis));
    }
    return kHalf + most;
}

/// The motor's count where the job began.
std::int64_t count_before(const Recording& recording, const JobRecord& job, std::size_t motor, std::int64_t after) {
    for (const std::int64_t way : recording.slide_ways(job, motor)) { after -= way; }
    return after;
}

/// Of the probing move, which begins where the motors are at `from`.
Braking braking_of(const Bench& bench, const Program& program, const Counts& from) {
    const MachineConfig& machine = bench.machine();
    const Counts begin = bench.axes_at(from);
    std::vector<AxisIndex> axes;
    std::vector<double> from_mm;
    for (const std::string& name : program.axes) {
        const AxisIndex i = machine.axis_named(name).value();
        axes.push_back(i);
        from_mm.push_back(static_cast<double>(begin[i]) / machine.axes[i].steps_per_mm);
    }
    return Braking::of_move(machine, axes, from_mm, std::get<ProgramMove>(program.blocks.back().action).target_mm);
}

/// The way behind the touch, and what was announced of it. The axes rest within their steps of the path.
void measure(const Bench& bench, const Program& program, const Counts& at, ProbeRecord& record) {
    const double feed_mm_s = std::get<ProgramMove>(program.blocks.back().action).feed_mm_s;
    const Braking braking = braking_of(bench, program, record.from);
    const MachineConfig& machine = bench.machine();
    const Counts rest = bench.axes_at(at);
    double steps_mm = 0;
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        const double mm = static_cast<double>(rest[i]) / machine.axes[i].steps_per_mm - record.result.places_mm[i];
        record.went_on_mm = std::hypot(record.went_on_mm, mm);
        steps_mm += 2 * bench.kinematics().step_mm(i);
    }
    for (const std::size_t input : probe_inputs(machine)) {
        const double announced = overshoot_mm(machine, machine.inputs[input], feed_mm_s, braking);
        const double allowed = std::min(announced, machine.inputs[input].max_overshoot_mm);
        record.most_mm = std::max(record.most_mm, allowed + steps_mm);
    }
}

}  // namespace

bool is_probing(const Program& program) { return std::holds_alternative<Probe>(program.blocks.front().action); }

std::vector<std::size_t> probe_inputs(const MachineConfig& machine) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < machine.inputs.size(); ++i) {
        if (machine.inputs[i].use == InputUse::Probe) { found.push_back(i); }
    }
    return found;
}

TouchRecord touch_record(const MachineConfig& machine, std::size_t input, Tick pressed) {
    const InputConfig& config = machine.inputs[input];
    const double debounce = std::ceil(config.debounce_ms * 1e-3 * machine.ticks_per_second());
    const double bounce = std::ceil(bounce_seconds(config) * machine.ticks_per_second());
    return {.input = input,
            .motor = motor_named(machine, config.motor).value(),
            .pressed = pressed,
            .debounce = {std::llround(debounce)},
            .bounce = {std::llround(bounce)}};
}

ProbeRecord probe_record(Bench& bench, const Program& program, const JobRecord& job, const Counts& at) {
    const MachineConfig& machine = bench.machine();
    ProbeRecord record{.result = *bench.vm().state()->probe, .touches = {}, .from = {}, .places = {}, .within = {}};
    Places places;
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        places.push_back(record.result.places_mm[i] * machine.axes[i].steps_per_mm);
    }
    for (std::size_t m = 0; m < at.size(); ++m) {
        record.from.push_back(count_before(bench.recording(), job, m, at[m]));
        if (m >= moving_motor_count(machine)) { continue; }
        record.places.push_back(bench.map().place(m, places));
        record.within.push_back(within_steps(bench, m));
    }
    measure(bench, program, at, record);
    return record;
}

}  // namespace lockstep::simtest
