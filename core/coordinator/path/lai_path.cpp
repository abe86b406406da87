#include "core/coordinator/path/lai_path.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/methods/lai_planner.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

constexpr double kLeastPulses = 2;  // of start velocity per period, of acceleration per period and period

class LaiPlanner {
public:
    LaiPlanner(std::span<const AxisLimits> limits, std::span<const double> steps_per_mm, std::int64_t tick_ns,
               Ticks least, LaiFollowing following)
        : limits_(limits), steps_per_mm_(steps_per_mm), least_(least), periods_(limits, tick_ns, following) {}

    /// A dwell, or the rest of a period in which a hold came, as a move from rest to rest.
    void alone(const PathMove& move, Displacement along = {}) { append(plan_alone(move, along, least_)); }

    /// A straight move from rest to rest, period by period. Its parts are numbered from `part`.
    void straight(const PathMove& move, std::uint32_t part) {
        AxisCounts at = move.from;
        periods_.begin(move);
        while (periods_.next()) {
            AxisCounts to = at;
            for (std::size_t i = 0; i < limits_.size(); ++i) { to[i] += periods_.pulses()[i]; }
            append(period(move, part++, at, to));
            at = to;
        }
    }

    Path take() { return std::move(path_); }

private:
    void append(PathMove move) {
        move.start = path_.duration();
        path_.moves.push_back(move);
    }

    /// The pulses that the longest axis of the whole move makes in a period.
    static std::int64_t long_axis(const PathMove& whole_move, const PathMove& period) {
        std::size_t i = 0;
        while (std::abs(whole_move.to[i] - whole_move.from[i]) < whole_move.lead) { ++i; }
        return std::abs(period.to[i] - period.from[i]);
    }

    /// One period: a straight move at one speed. Its length is that of the whole move's line, since tails keep their
    /// speed along it from period to period. Along the period itself, a pulse more of an axis with few steps per mm
    /// would be a large change.
    PathMove period(const PathMove& whole_move, std::uint32_t part, const AxisCounts& from,
                    const AxisCounts& to) const {
        PathMove move = make_move(from, to, limits_, steps_per_mm_, whole_move.feed_mm_per_tick);
        move.line = whole_move.line;
        move.block = whole_move.block;
        move.part = part;
        move.limits = move.own;
        if (const std::int64_t covered = long_axis(whole_move, move); covered > 0) {
            move.length_mm = whole_move.mm_per_lead() * static_cast<double>(covered);
        }
        const auto ticks = static_cast<double>(periods_.period().value);
        for (std::size_t i = 0; i < limits_.size(); ++i) {  // what the changes between periods leave for stops
            const double share = std::abs(move.share(i));
            const double used = static_cast<double>(lai_change_of(limits_[i], periods_.period())) / (ticks * ticks);
            if (share == 0) { continue; }
            move.limits.max_deceleration =
                std::min(move.limits.max_deceleration, (limits_[i].max_deceleration - used) / share);
        }
        move.profile = plan_steady({}, Displacement::steps(move.lead), periods_.period());
        return move;
    }

    std::span<const AxisLimits> limits_;
    std::span<const double> steps_per_mm_;
    Ticks least_;
    LaiPeriods periods_;
    Path path_;
};

}  // namespace

std::string text_of(const LaiLack& lack) {
    const std::string value = short_number(lack.value);
    switch (lack.why) {
        case LaiLack::Why::Axes: return "coordination LAI needs two or more axes; the machine has one";
        case LaiLack::Why::Tick:
            return "coordination LAI needs a tick_ns that divides 6500000; it is " + number_text(lack.value);
        case LaiLack::Why::FrameRoom:
            return "coordination LAI makes a move every 6.5 ms, but frames of this length can carry one move every " +
                   value + " ms; lower timing.frame_slots or timing.slot_us";
        case LaiLack::Why::Limit: break;
    }
    return "axis " + lack.axis + ": coordination LAI changes speed by whole pulses per 6.5 ms, so " +
           std::string(lack.key) + " must be at least " + number_text(lack.least) + "; it is " + value +
           "; or increase steps_per_mm, or use coordination: RANADE";
}

std::expected<void, LaiLack> suits_lai_path(const MachineConfig& machine) {
    using Why = LaiLack::Why;
    if (machine.axes.size() < 2) { return std::unexpected(LaiLack{Why::Axes}); }
    if (kLaiPeriod_ns % machine.tick_ns != 0) {
        return std::unexpected(LaiLack{Why::Tick, static_cast<double>(machine.tick_ns)});
    }
    const std::int64_t least_ns = least_move(machine).value * machine.tick_ns;
    if (kLaiPeriod_ns < least_ns) {
        return std::unexpected(LaiLack{Why::FrameRoom, static_cast<double>(least_ns) * 1e-6});
    }
    const double period_s = static_cast<double>(kLaiPeriod_ns) * 1e-9;
    for (const AxisConfig& axis : machine.axes) {
        const double speed = kLeastPulses / axis.steps_per_mm / period_s;
        const double acceleration = speed / period_s;
        for (const auto& [key, value, least] : {std::tuple{"start_velocity_mm_s", axis.start_velocity_mm_s, speed},
                                                std::tuple{"max_velocity_mm_s", axis.max_velocity_mm_s, speed},
                                                std::tuple{"max_accel_mm_s2", axis.max_accel_mm_s2, acceleration},
                                                std::tuple{"max_decel_mm_s2", axis.max_decel_mm_s2, acceleration}}) {
            const bool is_enough = value >= least * (1 - kTextRounding);
            if (!is_enough) { return std::unexpected(LaiLack{Why::Limit, value, least, key, axis.name}); }
        }
    }
    return {};
}

std::expected<void, double> check_lai_move(const PathMove& move, std::int64_t tick_ns) {
    const std::int64_t period_ticks = kLaiPeriod_ns / tick_ns;
    const double pulses = move.asked_velocity() * static_cast<double>(period_ticks);
    if (move.lead == 0 || pulses >= 1 - methods::kPulseHair) { return {}; }
    return std::unexpected(move.mm_per_lead() / (static_cast<double>(kLaiPeriod_ns) * 1e-9));
}

Path plan_lai_path(const std::vector<PathMove>& moves, Displacement along, std::span<const AxisLimits> limits,
                   std::span<const double> steps_per_mm, std::int64_t tick_ns, Ticks least, LaiFollowing following) {
    LaiPlanner planner(limits, steps_per_mm, tick_ns, least, following);
    std::size_t next = 0;
    if (along > Displacement{}) { planner.alone(moves[next++], along); }
    while (next < moves.size()) {
        const PathMove& first = moves[next];
        std::size_t last = next;
        while (last + 1 < moves.size() && moves[last + 1].block == first.block) { ++last; }
        if (first.lead == 0) {
            planner.alone(first);
        } else {
            PathMove whole_move = make_move(first.from, moves[last].to, limits, steps_per_mm, first.feed_mm_per_tick);
            whole_move.line = first.line;
            whole_move.block = first.block;
            planner.straight(whole_move, first.part);
        }
        next = last + 1;
    }
    return planner.take();
}

}  // namespace lockstep
