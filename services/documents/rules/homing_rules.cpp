#include "services/documents/rules/homing_rules.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "core/number_text.hpp"
#include "services/documents/rules/axis_ranges.hpp"
#include "services/documents/rules/homing_input_rules.hpp"

namespace lockstep {
namespace {

using namespace axis_ranges;

void check_speeds(const AxisConfig& axis, ProblemList& problems) {
    problems.require_range("homing.sequence", axis.homing.sequence, 0, 99);
    const double search = axis.homing.search_velocity_mm_s;
    const double latch = axis.homing.latch_velocity_mm_s;
    problems.require_between({"homing.search_velocity_mm_s", "start_velocity_mm_s"}, search <= axis.start_velocity_mm_s,
                             fmt::format("homing.search_velocity_mm_s is {}, above start_velocity_mm_s {}: the "
                                         "switch stops the pulses at once; decrease it",
                                         number_text(search), number_text(axis.start_velocity_mm_s)));
    problems.require_between(
        {"homing.latch_velocity_mm_s", "homing.search_velocity_mm_s"}, latch <= search,
        fmt::format("homing.latch_velocity_mm_s is {}, above homing.search_velocity_mm_s {}; decrease it",
                    number_text(latch), number_text(search)));
}

void check_unhomed_jog(const AxisConfig& axis, ProblemList& problems) {
    if (!axis.unhomed_jog_mm_s) { return; }
    problems.require_between(
        {"unhomed_jog_mm_s", "start_velocity_mm_s"}, *axis.unhomed_jog_mm_s <= axis.start_velocity_mm_s,
        fmt::format("unhomed_jog_mm_s is {}, above start_velocity_mm_s {}: a limit switch stops the pulses at "
                    "once; decrease it",
                    number_text(*axis.unhomed_jog_mm_s), number_text(axis.start_velocity_mm_s)));
}

void check_within_travel(std::string_view key, double mm, const AxisConfig& axis, ProblemList& problems) {
    problems.require_between({key, "position_min_mm", "position_max_mm"},
                             mm >= axis.position_min_mm && mm <= axis.position_max_mm,
                             fmt::format("{} is {}, outside the travel; it must be from {} to {}", key, number_text(mm),
                                         number_text(axis.position_min_mm), number_text(axis.position_max_mm)));
}

/// The switch must lie on the side homed to, and the axis must reach it before the limit switch.
void check_switch(const AxisConfig& axis, ProblemList& problems) {
    const double at = axis.homing.switch_position_mm;
    const double middle = (axis.position_min_mm + axis.position_max_mm) / 2;
    const bool at_min = axis.homing.toward_min;
    const bool holds = at_min ? at > limit_min_mm(axis) && at <= middle : at < limit_max_mm(axis) && at >= middle;
    problems.require_between(
        {"homing.switch_position_mm", "position_min_mm", "position_max_mm", "plant.travel_margin_mm"}, holds,
        fmt::format("homing.switch_position_mm is {}; it must be on the side that the axis homes to, {} to {}, and "
                    "not on the limit switch",
                    number_text(at), number_text(at_min ? limit_min_mm(axis) : middle),
                    number_text(at_min ? middle : limit_max_mm(axis))));
}

void check_pulloff(const AxisConfig& axis, ProblemList& problems) {
    const double room = axis.homing.toward_min ? axis.position_max_mm - axis.homing.switch_position_mm
                                               : axis.homing.switch_position_mm - axis.position_min_mm;
    const double pulloff = axis.homing.pulloff_mm;
    const std::string what = "homing.pulloff_mm is " + number_text(pulloff);
    problems.require_between({"homing.pulloff_mm", "steps_per_mm"}, is_at_least(pulloff * axis.steps_per_mm, 1),
                             what + ", less than a step; it must be at least " + number_text(1 / axis.steps_per_mm));
    problems.require_between(
        {"homing.pulloff_mm", "homing.switch_position_mm", "position_min_mm", "position_max_mm"}, pulloff < room,
        fmt::format("{}, not less than the travel from the switch, {}; decrease it", what, number_text(room)));
    const double tolerance = axis.homing.touch_tolerance_mm;
    problems.require_between(
        {"homing.touch_tolerance_mm", "homing.pulloff_mm"}, tolerance < pulloff,
        fmt::format("homing.touch_tolerance_mm is {}, not less than homing.pulloff_mm {}: two touches in a row "
                    "never differ by more than the pull-off, so homing would accept every touch; decrease it",
                    number_text(tolerance), number_text(pulloff)));
}

}  // namespace

void check_homing(const MachineConfig& machine, const AxisConfig& axis, ProblemList& problems) {
    check_speeds(axis, problems);
    check_unhomed_jog(axis, problems);
    check_switch(axis, problems);
    check_pulloff(axis, problems);
    check_within_travel("homing.park_mm", axis.homing.park_mm, axis, problems);
    if (axis.safe_height_mm) { check_within_travel("safe_height_mm", *axis.safe_height_mm, axis, problems); }
    check_homing_input(machine, axis, problems);
}

}  // namespace lockstep
