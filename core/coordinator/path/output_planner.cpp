#include "core/coordinator/path/output_planner.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/kinematics/motors.hpp"
#include "core/outputs/output_levels.hpp"

namespace lockstep {
namespace {

/// An output that follows the speed differs from it by at most so much of full scale, unless a frame has too many
/// changes for it.
constexpr double kTolerance = 0x1p-12;

std::uint16_t bit_of(const OutputConfig& output) { return static_cast<std::uint16_t>(1U << output.channel); }

RampAnalog ramp_of(const OutputConfig& output, double value, double slope) {
    const double steepest = static_cast<double>(kFullScale);
    return {.channel = static_cast<std::uint8_t>(output.channel),
            .value = analog_value(value),
            .slope = std::llround(std::clamp(slope * steepest, -steepest, steepest))};
}

}  // namespace

/// A body or a tail.
struct OutputPlanner::Part {
    Ticks ticks;
    std::span<const FrameEvent> events;
    std::span<const PathSpeed> speeds;
    ProgramDevices devices;  // at its begin
    bool states_all = false;
    bool ends_at_rest = false;

    /// Changes happen from the first tick on.
    static Ticks tick_of(const FrameEvent& event) { return std::max(event.at, Ticks{1}); }
    /// Calls visit(from, to, devices) for each time between two events. The first begins at 0.
    template <typename Visit>
    void each_time(Visit visit) const {
        ProgramDevices now = devices;
        double from = 0;
        for (std::size_t k = 0; k < events.size(); ++k) {
            const auto at = static_cast<double>(tick_of(events[k]).value);
            if (at > from) { visit(from, at, now); }
            from = std::max(from, at);
            now.apply(events[k].event.event);
        }
        visit(from, static_cast<double>(ticks.value), now);
    }
};

OutputPlanner::OutputPlanner(const MachineConfig& machine) : room_(output_room(machine.timing)) {
    const std::vector<std::string> names = motor_names(machine);
    for (std::size_t m = 0; m < names.size(); ++m) {
        Motor motor{.number = static_cast<std::uint32_t>(m), .outputs = {}, .ramps = {}};
        std::ranges::copy_if(machine.outputs, std::back_inserter(motor.outputs),
                             [&](const OutputConfig& output) { return output.motor == names[m]; });
        motor.ramps.resize(motor.outputs.size());
        if (!motor.outputs.empty()) { motors_.push_back(std::move(motor)); }
    }
}

void OutputPlanner::begin(const ProgramDevices& devices) {
    devices_ = devices;
    is_first_ = true;
}

void OutputPlanner::plan(const PathFrame& frame, const Events& events, std::vector<MotorOutputs>& outputs) {
    outputs.resize(motors_.size());
    if (motors_.empty()) { return; }
    const Part body{.ticks = frame.ticks,
                    .events = events.body,
                    .speeds = frame.speeds,
                    .devices = devices_,
                    .states_all = is_first_,
                    .ends_at_rest = frame.last};
    for (const FrameEvent& event : events.body) { devices_.apply(event.event.event); }
    Part tail{.ticks = {},
              .events = events.tail,
              .speeds = frame.tail_speeds,
              .devices = devices_,
              .states_all = false,
              .ends_at_rest = true};
    for (const AxisTrack& track : frame.axes) { tail.ticks = std::max(tail.ticks, total_ticks(track.tail)); }
    for (std::size_t k = 0; k < motors_.size(); ++k) {
        Motor& motor = motors_[k];
        OutputTrack& track = outputs[k].track;
        outputs[k].motor = motor.number;
        plan_part(body, motor, room_.body, track.body);
        track.tail.clear();
        Motor behind = motor;
        if (tail.ticks > Ticks{}) { plan_part(tail, behind, room_.tail, track.tail); }
    }
    is_first_ = false;
}

/// Ramps are approximated more roughly until there is room. Events have room, because the path is slowed for them.
template <typename Changes>
void OutputPlanner::plan_part(const Part& part, Motor& motor, std::size_t room, Changes& changes) const {
    std::vector<OutputChange> listed;
    std::vector<Ramp> ramps;
    for (double tolerance = kTolerance; tolerance < 2; tolerance *= 2) {
        listed.clear();
        ramps = motor.ramps;
        list_digital(part, motor, listed);
        for (std::size_t k = 0; k < motor.outputs.size(); ++k) {
            if (motor.outputs[k].pwm) { list_analog(part, motor.outputs[k], ramps[k], tolerance, listed); }
        }
        if (listed.size() <= room) { break; }
    }
    motor.ramps = ramps;
    std::vector<std::pair<Ticks, std::size_t>> order;  // those of one tick stay in order
    for (std::size_t k = 0; k < listed.size(); ++k) { order.emplace_back(listed[k].at, k); }
    std::ranges::sort(order);
    changes.clear();
    for (const auto& [at, k] : order) { changes.append(listed[k]); }
}

void OutputPlanner::list_digital(const Part& part, const Motor& motor, std::vector<OutputChange>& changes) const {
    std::uint16_t all = 0;
    for (const OutputConfig& output : motor.outputs) { all |= output.pwm ? std::uint16_t{0} : bit_of(output); }
    const auto levels_of = [&](const ProgramDevices& devices) {
        std::uint16_t levels = 0;
        for (const OutputConfig& output : motor.outputs) {
            if (!output.pwm && is_on(output, devices)) { levels |= bit_of(output); }
        }
        return levels;
    };
    std::uint16_t levels = levels_of(part.devices);
    const bool begins_with_event = !part.events.empty() && Part::tick_of(part.events[0]) <= Ticks{1};
    if (part.states_all && all != 0 && !begins_with_event) { changes.push_back({{1}, SetDigital{levels, all}}); }
    bool is_stated = !part.states_all || !begins_with_event;
    part.each_time([&](double from, double, const ProgramDevices& devices) {
        const std::uint16_t next = levels_of(devices);
        const auto mask = is_stated ? static_cast<std::uint16_t>(next ^ levels) : all;
        if (from < 1 || mask == 0) { return; }
        changes.push_back(
            {{static_cast<std::int64_t>(from)}, SetDigital{static_cast<std::uint16_t>(next & mask), mask}});
        levels = next;
        is_stated = true;
    });
}

/// Lists a change where the value would otherwise leave the wanted one by more than the tolerance. `ramp` begins as it
/// is at the begin of the part, and becomes that at its end.
void OutputPlanner::list_analog(const Part& part, const OutputConfig& output, Ramp& ramp, double tolerance,
                                std::vector<OutputChange>& changes) const {
    bool is_stated = !part.states_all;
    const auto want = [&](double from, double to, double value, double slope) {
        const auto tick = static_cast<double>(std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(from))));
        if (tick >= to && to < static_cast<double>(part.ticks.value)) { return; }  // the next one begins by then
        const double there = value + slope * (tick - from);
        const double ends = value + slope * (to - from);
        const bool holds =
            is_stated && std::abs(ramp.at(tick) - there) <= tolerance && std::abs(ramp.at(to) - ends) <= tolerance;
        if (holds) { return; }
        changes.push_back({{static_cast<std::int64_t>(tick)}, ramp_of(output, there, slope)});
        ramp = {.value = there - slope * tick, .slope = slope};
        is_stated = true;
    };
    part.each_time([&](double from, double to, const ProgramDevices& devices) {
        const double share = share_of(output, devices);
        if (!follows_speed(output, devices)) { return want(from, to, share, 0); }
        for (const PathSpeed& speed : part.speeds) {
            const double begin = std::max(from, speed.begin);
            const double end = std::min(to, speed.end());
            if (end <= begin) { continue; }
            const double factor = speed.feed > 0 ? share / speed.feed : 0;
            want(begin, end, factor * speed.at(begin), factor * speed.a);
        }
    });
    const auto end = static_cast<double>(part.ticks.value);
    ProgramDevices last = part.devices;
    for (const FrameEvent& event : part.events) { last.apply(event.event.event); }
    const bool must_end = part.ends_at_rest && follows_speed(output, last) && (ramp.slope != 0 || ramp.at(end) != 0);
    if (must_end) {
        changes.push_back({part.ticks, ramp_of(output, 0, 0)});
        ramp = {};
    }
    ramp = {.value = ramp.at(end), .slope = ramp.slope};
}

}  // namespace lockstep
