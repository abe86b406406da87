#include "core/coordinator/jogs/path_jog.hpp"

#include <algorithm>
#include <cmath>

#include "core/coordinator/jogs/jogs.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

struct Way {
    AxisIndex axis;
    double speed_mm_s = 0;  // with its sign
    double seconds = 0;     // until its end
};

/// Whether a way of so many steps is in the direction of the jog, and not shorter than `least`.
bool leads_ahead(const JogAxis& jog, std::int64_t way, std::int64_t least) {
    return std::abs(way) >= least && (way < 0) == (jog.speed_mm_s < 0);
}

std::expected<Way, Refusal> way_of(const JogAxis& asked, const AxisCounts& here, const LoopView& loop) {
    if (asked.axis >= here.size()) { return refuse(FaultCode::BadProgram, "the machine does not have this axis"); }
    const AxisConfig& axis = loop.machine.axes[asked.axis];
    if (!is_jog_speed(axis, std::abs(asked.speed_mm_s))) {
        return refuse(FaultCode::BadProgram, jog_speed_text(axis, std::abs(asked.speed_mm_s)));
    }
    const std::int64_t way = jog_target(asked, axis, here[asked.axis], true) - here[asked.axis];
    // Its motors may rest beside the end of the travel, and a shorter way may move none of them.
    const std::int64_t least = asked.distance_mm ? 1 : loop.kinematics.rest_steps(asked.axis) + 1;
    const double mm = leads_ahead(asked, way, least) ? std::abs(to_mm(axis, static_cast<double>(way))) : 0;
    return Way{asked.axis, asked.speed_mm_s, mm / std::abs(asked.speed_mm_s)};
}

std::string ends_of(const Command& jog, const LoopView& loop) {
    std::string names;
    for (const JogAxis& axis : jog.jogs) { names += (names.empty() ? "" : ", ") + loop.machine.axes[axis.axis].name; }
    return "axis " + names + (jog.jogs.size() > 1 ? ": each is" : " is") + " at the end of its travel";
}

}  // namespace

bool needs_path(const Command& jog, const Kinematics& kinematics) {
    return std::ranges::any_of(jog.jogs, [&](const JogAxis& asked) {
        return asked.axis < kinematics.axes() && !kinematics.own_motor(asked.axis);
    });
}

std::expected<Program, Refusal> jog_program(const Command& jog, const LoopView& loop) {
    const AxisCounts here = loop.counts();
    std::vector<Way> ways;
    for (const JogAxis& asked : jog.jogs) {
        const auto way = way_of(asked, here, loop);
        if (!way) { return std::unexpected(way.error()); }
        if (way->seconds > 0) { ways.push_back(*way); }
    }
    if (ways.empty()) { return refuse(FaultCode::OutsideTravel, ends_of(jog, loop)); }
    const double seconds = std::ranges::min_element(ways, {}, &Way::seconds)->seconds;
    Program program{.name = "jog", .axes = {}, .start_mm = {}, .blocks = {}};
    ProgramMove move{.is_feed_fixed = true};
    double square = 0;
    for (const Way& way : ways) {
        const AxisConfig& axis = loop.machine.axes[way.axis];
        const double from_mm = to_mm(axis, static_cast<double>(here[way.axis]));
        const double to = std::clamp(from_mm + way.speed_mm_s * seconds, axis.position_min_mm, axis.position_max_mm);
        program.axes.push_back(axis.name);
        program.start_mm.push_back(from_mm);
        move.target_mm.push_back(to);
        square += way.speed_mm_s * way.speed_mm_s;
    }
    move.feed_mm_s = std::sqrt(square);
    program.blocks = {{{}, move}};
    return program;
}

bool PathJog::renew(const Command& command, const LoopView& loop) {
    const std::uint64_t sequence = replacement_ ? replacement_->sequence : asked_.sequence;
    if (is_over_ || command.client != asked_.client || command.sequence != sequence) { return false; }
    if (!loop.is_late) { renewed_ = loop.now; }
    return true;
}

void PathJog::continue_by(Command next, const LoopView& loop) {
    asked_ = std::move(next);
    renewed_ = loop.now;
}

void PathJog::replace(Command next, const LoopView& loop) {
    replacement_ = std::move(next);
    renewed_ = loop.now;
}

std::optional<Command> PathJog::next(const LoopView& loop) const {
    if (is_over_ || is_released(loop.now)) { return std::nullopt; }
    if (replacement_) { return replacement_->jogs.empty() ? std::nullopt : replacement_; }
    return has_distance() ? rest_of_distance(loop) : std::optional(asked_);
}

/// Without the axes that have gone their distances, as nearly as their motors allow.
std::optional<Command> PathJog::rest_of_distance(const LoopView& loop) const {
    const AxisCounts here = loop.counts();
    Command rest = asked_;
    rest.jogs.clear();
    for (JogAxis jog : asked_.jogs) {
        const AxisConfig& axis = loop.machine.axes[jog.axis];
        const std::int64_t left = jog_target(jog, axis, from_[jog.axis], true) - here[jog.axis];
        const bool is_ahead = leads_ahead(jog, left, loop.kinematics.rest_steps(jog.axis) + 1);
        if (jog.distance_mm && !is_ahead) { continue; }
        if (jog.distance_mm) { jog.distance_mm = std::abs(to_mm(axis, static_cast<double>(left))); }
        rest.jogs.push_back(jog);
    }
    return rest.jogs.empty() ? std::nullopt : std::optional(std::move(rest));
}

bool PathJog::has_distance() const {
    return std::ranges::any_of(asked_.jogs, [](const JogAxis& axis) { return axis.distance_mm.has_value(); });
}

}  // namespace lockstep
