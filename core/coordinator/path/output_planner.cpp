#include "core/coordinator/path/output_planner.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/kinematics/kinematics.hpp"
#include "core/outputs/output_levels.hpp"

namespace lockstep {
namespace {

/// An output that follows the speed differs from it by at most so much of full scale, unless a frame has too many
/// changes for it.
constexpr double kTolerance = 0x1p-12;
/// It changes evenly from one event that concerns it to the next.
constexpr double kRoughest = 1;

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

/// The changes of an analog output in a body or tail. It changes where its value would otherwise leave the wanted one
/// by more than a tolerance.
class OutputPlanner::AnalogChanges {
public:
    /// `ramp` begins as it is at the begin of the part, and becomes that at its end.
    AnalogChanges(const Part& part, const OutputConfig& output, Ramp& ramp, std::vector<OutputChange>& changes)
        : part_(part), output_(output), ramp_(ramp), changes_(changes), is_stated_(!part.states_all) {}

    /// `tolerance`: where the output follows the speed. At events it is kTolerance.
    void list(double tolerance) {
        ProgramDevices last;
        std::optional<Wanted> wanted;
        part_.each_time([&](double from, double to, const ProgramDevices& devices) {
            last = devices;
            const Wanted next{from, to, share_of(output_, devices), follows_speed(output_, devices)};
            if (tolerance >= kRoughest && wanted && wanted->is_like(next)) { return void(wanted->to = to); }
            if (wanted) { list(*wanted, tolerance); }
            wanted = next;
        });
        list(*wanted, tolerance);
        const auto end = static_cast<double>(part_.ticks.value);
        const bool is_on = ramp_.slope != 0 || ramp_.at(end) != 0;
        if (part_.ends_at_rest && follows_speed(output_, last) && is_on) { change(part_.ticks, {}); }
        ramp_ = {.value = ramp_.at(end), .slope = ramp_.slope};
    }

private:
    /// The time between two events. If it is listed as roughly as possible, only those count that concern the output.
    struct Wanted {
        double from = 0;
        double to = 0;
        double share = 0;
        bool follows = false;  // the speed
        bool is_like(const Wanted& next) const { return share == next.share && follows == next.follows; }
    };
    void list(const Wanted& wanted, double tolerance) {
        const auto [from, to, share, follows] = wanted;
        is_event_ = true;
        if (!follows) { return want({from, to, share, share}, kTolerance); }
        if (tolerance < kRoughest) {
            each_speed(from, to, share, [&](const EvenTime& time) { want(time, tolerance); });
        } else if (const auto whole = even(from, to, share)) {
            want(*whole, tolerance);
        }
    }

    /// Some time in which the wanted value changes evenly.
    struct EvenTime {
        double from = 0;
        double to = 0;
        double first = 0;
        double last = 0;
        double slope() const { return to > from ? (last - first) / (to - from) : 0; }
    };

    /// Calls visit(time) for each time of even acceleration.
    template <typename Visit>
    void each_speed(double from, double to, double share, Visit visit) const {
        for (const PathSpeed& speed : part_.speeds) {
            const double begin = std::max(from, speed.begin);
            const double end = std::min(to, speed.end());
            if (end <= begin) { continue; }
            const double factor = speed.feed > 0 ? share / speed.feed : 0;
            visit(EvenTime{begin, end, factor * speed.at(begin), factor * speed.at(end)});
        }
    }
    /// From the first value straight to the last one.
    std::optional<EvenTime> even(double from, double to, double share) const {
        std::optional<EvenTime> whole;
        each_speed(from, to, share, [&](const EvenTime& time) {
            if (!whole) { whole = EvenTime{from, to, time.first, time.last}; }
            whole->last = time.last;
        });
        return whole;
    }
    void want(const EvenTime& time, double tolerance) {
        const double tick = std::max(1.0, std::ceil(time.from));
        if (tick >= time.to && time.to < static_cast<double>(part_.ticks.value)) {
            return;  // the next one begins by then
        }
        const double there = time.first + time.slope() * (tick - time.from);
        const double at_begin = std::exchange(is_event_, false) ? kTolerance : tolerance;
        const bool holds = is_stated_ && std::abs(ramp_.at(tick) - there) <= at_begin &&
                           std::abs(ramp_.at(time.to) - time.last) <= tolerance;
        if (holds) { return; }
        change({static_cast<std::int64_t>(tick)}, {.value = there - time.slope() * tick, .slope = time.slope()});
        is_stated_ = true;
    }
    void change(Ticks at, const Ramp& ramp) {
        changes_.push_back({at, ramp_of(output_, ramp.at(static_cast<double>(at.value)), ramp.slope)});
        ramp_ = ramp;
    }

    const Part& part_;
    const OutputConfig& output_;
    Ramp& ramp_;
    std::vector<OutputChange>& changes_;
    bool is_stated_;
    bool is_event_ = false;  // no time since the last event
};

OutputPlanner::OutputPlanner(const MachineConfig& machine) : room_(output_room(machine.timing)) {
    if (machine.outputs.empty()) { return; }
    const Kinematics kinematics(machine);
    for (const MotorIndex m : motor_indices(kinematics.motors().size())) {
        const MotorConfig& config = kinematics.motors()[m];
        Motor motor{.number = static_cast<std::uint32_t>(m),
                    .steps_per_mm = config.moves_one_axis ? 1 / kinematics.axis_mm(*config.axis, m) : 0,
                    .outputs = outputs_of(machine.outputs, config.name),
                    .ramps = {}};
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
    ProgramDevices at_rest = devices_;
    for (const FrameEvent& event : events.tail) { at_rest.apply(event.event.event); }
    has_pulses_ = at_rest.pulses.left > 0;
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

/// Outputs follow the speed less closely until there is room. Events have room, because the path is slowed for them.
template <typename Changes>
void OutputPlanner::plan_part(const Part& part, Motor& motor, std::size_t room, Changes& changes) const {
    std::vector<OutputChange> listed;
    std::vector<Ramp> ramps;
    for (double tolerance = kTolerance; tolerance <= kRoughest; tolerance *= 2) {
        listed.clear();
        ramps = motor.ramps;
        list_digital(part, motor, listed);
        for (std::size_t k = 0; k < motor.outputs.size(); ++k) {
            const OutputConfig& output = motor.outputs[k];
            if (output.makes_pulses()) { list_pulses(part, motor, output, listed); }
            if (output.is_analog()) { AnalogChanges(part, output, ramps[k], listed).list(tolerance); }
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
    for (const OutputConfig& output : motor.outputs) { all |= output.has_level() ? output.bit() : std::uint16_t{0}; }
    const auto levels_of = [&](const ProgramDevices& devices) {
        std::uint16_t levels = 0;
        for (const OutputConfig& output : motor.outputs) {
            if (output.has_level() && is_on(output, devices)) { levels |= output.bit(); }
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

/// A word that gives the same places again begins them again.
void OutputPlanner::list_pulses(const Part& part, const Motor& motor, const OutputConfig& output,
                                std::vector<OutputChange>& changes) const {
    ProgramDevices now = part.devices;
    bool is_due = part.states_all && is_active(output, now);
    Ticks at{1};
    const auto list = [&] {
        if (is_due) { changes.push_back({at, pulses_of(output, now, motor.steps_per_mm).value_or(ComparePosition{})}); }
        is_due = false;
    };
    for (const FrameEvent& event : part.events) {
        if (Part::tick_of(event) > at) { list(); }
        at = Part::tick_of(event);
        const bool was_active = is_active(output, now);
        now.apply(event.event.event);
        is_due = is_due || was_active != is_active(output, now) ||
                 (is_active(output, now) && is_switched_by(output, event.event.event));
    }
    list();
}

}  // namespace lockstep
