#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/methods/suits.hpp"
#include "core/motion/step_source.hpp"
#include "core/number_text.hpp"
#include "core/program.hpp"
#include "core/protocol/frame_room.hpp"
#include "services/documents/machine_rules.hpp"
#include "services/documents/names.hpp"
#include "services/documents/problem_list.hpp"
#include "services/documents/rules/axis_ranges.hpp"
#include "services/documents/rules/following_error_rule.hpp"
#include "services/documents/rules/homing_rules.hpp"
#include "services/documents/rules/pin_rules.hpp"

namespace lockstep {
namespace {

using namespace axis_ranges;

constexpr double kMinTravelSteps = 4;    // for homing: off the switch and back
constexpr double kMaxRampSeconds = 600;  // slower is a mistake in the units

class AxisRules {
public:
    AxisRules(const MachineConfig& machine, std::size_t index)
        : machine_(machine), axis_(machine.axes[index]), index_(index), problems_(index, "axis " + axis_.name + ": ") {}

    std::vector<Problem> check() {
        check_name();
        check_ranges();
        check_speeds();
        check_ramp("max_accel_mm_s2", axis_.max_accel_mm_s2);
        check_ramp("max_decel_mm_s2", axis_.max_decel_mm_s2);
        check_travel();
        check_durations();
        if (has_own_motor()) { check_capture(); }
        check_homing(machine_, axis_, problems_);
        check_plant();
        check_pin_ranges(axis_.pins, "pins.", problems_);
        if (has_own_motor()) { check_method(); }
        if (has_own_motor()) {
            check_following_error("max_following_error_mm", axis_.max_following_error_mm, axis_.steps_per_mm,
                                  problems_);
        }
        check_place();
        check_motors();
        return problems_.take();
    }

private:
    /// Otherwise the steps are those of its motors, which have their own rules (motor_problems).
    bool has_own_motor() const { return axis_.motors.empty(); }

    void check_motors() {
        if (axis_.motors.size() < 2 || !axis_.max_skew_mm) { return; }
        length("max_skew_mm", *axis_.max_skew_mm);
        const double beside = axis_.homing.switch_position_mm +
                              (axis_.homing.toward_min ? axis_.homing.pulloff_mm : -axis_.homing.pulloff_mm);
        const double parked = row_of(axis_.homing.way).searches ? std::abs(axis_.homing.park_mm - beside) : 0;
        const double least = axis_.homing.pulloff_mm + parked;
        problems_.require_between(
            {"max_skew_mm", "homing.park_mm", "homing.pulloff_mm"}, *axis_.max_skew_mm >= least,
            fmt::format("max_skew_mm is {}, below {}: a motor that has found its switch pulls off by "
                        "homing.pulloff_mm {} and goes to homing.park_mm {} while the others still search; increase "
                        "it, or leave park_mm out",
                        number_text(*axis_.max_skew_mm), number_text(least), number_text(axis_.homing.pulloff_mm),
                        number_text(axis_.homing.park_mm)));
    }

    void check_name() {
        problems_.require(
            is_axis_name(axis_.name), "name",
            fmt::format("name is \"{}\"; it must be a letter, then letters, digits and _, at most {} characters",
                        axis_.name, kMaxAxisName));
        for (std::size_t other = 0; other < index_; ++other) {
            problems_.require(
                !same_name(axis_.name, machine_.axes[other].name), "name",
                fmt::format(
                    "the name is already that of axis {}, {}; names must differ in more than upper and lower case",
                    other + 1, machine_.axes[other].name));
        }
    }

    void speed(const std::string& key, double value) {
        problems_.require_range(key, value, kMinSpeed_mm_s, kMaxSpeed_mm_s);
    }
    void accel(const std::string& key, double value) {
        problems_.require_range(key, value, kMinAccel_mm_s2, kMaxAccel_mm_s2);
    }
    void place(const std::string& key, double value) {
        problems_.require_range(key, value, -kMaxPlace_mm, kMaxPlace_mm);
    }
    void length(const std::string& key, double value) {
        problems_.require(value > 0 && value <= kMaxPlace_mm, key,
                          fmt::format("{} is {}; it must be above 0 and at most {}", key, number_text(value),
                                      number_text(kMaxPlace_mm)));
    }

    void check_ranges() {
        if (has_own_motor()) {
            problems_.require_range("steps_per_mm", axis_.steps_per_mm, kMinStepsPerMm, kMaxStepsPerMm);
        }
        for (const MotorLimit& limit : kMotorLimits) {
            require_range(limit, std::string(limit.key), axis_.*limit.of_axis, problems_);
        }
        place("position_min_mm", axis_.position_min_mm);
        place("position_max_mm", axis_.position_max_mm);
        speed("homing.search_velocity_mm_s", axis_.homing.search_velocity_mm_s);
        speed("homing.latch_velocity_mm_s", axis_.homing.latch_velocity_mm_s);
        length("homing.pulloff_mm", axis_.homing.pulloff_mm);
        length("homing.touch_tolerance_mm", axis_.homing.touch_tolerance_mm);
        place("homing.switch_position_mm", axis_.homing.switch_position_mm);
        place("homing.park_mm", axis_.homing.park_mm);
        if (axis_.unhomed_jog_mm_s) { speed("unhomed_jog_mm_s", *axis_.unhomed_jog_mm_s); }
        if (axis_.safe_height_mm) { place("safe_height_mm", *axis_.safe_height_mm); }
        place("plant.start_position_mm", axis_.plant.start_position_mm);
        problems_.require_range("plant.travel_margin_mm", axis_.plant.travel_margin_mm, kMinMargin_mm, kMaxPlace_mm);
        accel("plant.max_torque_accel_mm_s2", axis_.plant.max_torque_accel_mm_s2);
        speed("plant.max_jump_mm_s", axis_.plant.max_jump_mm_s);
    }

    void check_speeds() {
        problems_.require_between(
            {"max_velocity_mm_s", "start_velocity_mm_s"}, axis_.max_velocity_mm_s >= axis_.start_velocity_mm_s,
            fmt::format("max_velocity_mm_s is {}, below start_velocity_mm_s {}; increase it",
                        number_text(axis_.max_velocity_mm_s), number_text(axis_.start_velocity_mm_s)));
        if (!has_own_motor()) { return; }
        const double fastest = kMaxPlannedStepsPerTick / (tick_s() * axis_.steps_per_mm);
        problems_.require_between(
            {"max_velocity_mm_s", "steps_per_mm"}, is_at_most(axis_.max_velocity_mm_s, fastest),
            fmt::format("max_velocity_mm_s is {}, more than {} steps per tick; it must be at most "
                        "{}, or decrease tick_ns or steps_per_mm",
                        number_text(axis_.max_velocity_mm_s), number_text(kMaxPlannedStepsPerTick),
                        number_text(fastest)));
    }

    /// The device keeps the times of steps until the process, which may stall, reads them.
    void check_capture() {
        const ProtocolTiming& t = machine_.timing;
        const double longest_s = 1e-6 * static_cast<double>(t.slot_us) * (t.stall_slots + 1);
        const double most = kDeviceCaptureEntries / longest_s / axis_.steps_per_mm;
        problems_.require_between(
            {"max_velocity_mm_s", "steps_per_mm"}, is_at_most(axis_.max_velocity_mm_s, most),
            fmt::format("max_velocity_mm_s is {}: in timing.stall_slots + 1 slots of {} s together, the axis would "
                        "make more than the {} steps that its device can record; it must be at most {}, or decrease "
                        "timing.slot_us or timing.stall_slots",
                        number_text(axis_.max_velocity_mm_s), number_text(longest_s),
                        number_text(kDeviceCaptureEntries), number_text(most)));
    }

    void check_ramp(std::string_view key, double value) {
        const std::string what = std::string(key) + " is " + number_text(value);
        const double most = kMaxStepsPerTick / (tick_s() * tick_s() * axis_.steps_per_mm);
        problems_.require_between(
            {key, "steps_per_mm"}, !has_own_motor() || is_at_most(value, most),
            fmt::format("{}, which reaches full speed within a tick; it must be at most {}; decrease it or tick_ns",
                        what, number_text(most)));
        const double least = axis_.max_velocity_mm_s / kMaxRampSeconds;
        problems_.require_between(
            {key, "max_velocity_mm_s"}, is_at_least(value, least),
            fmt::format("{}, so max_velocity_mm_s would take more than {} s; it must be at least {}", what,
                        number_text(kMaxRampSeconds), number_text(least)));
    }

    /// A motion that lasts longer cannot be planned exactly. A search goes twice over the travel at most.
    void check_durations() {
        const double travel_mm = axis_.position_max_mm - axis_.position_min_mm;
        const double least = 2 * travel_mm / kLongestMotion_s;
        const auto check = [&](std::string_view key, double speed_mm_s) {
            problems_.require_between(
                {key, "position_max_mm", "position_min_mm"}, speed_mm_s <= 0 || is_at_least(speed_mm_s, least),
                fmt::format("{} is {}, so twice the travel would take more than 30 days; it must be at least {}", key,
                            number_text(speed_mm_s), number_text(least)));
        };
        check("max_velocity_mm_s", axis_.max_velocity_mm_s);
        check("homing.search_velocity_mm_s", axis_.homing.search_velocity_mm_s);
    }

    void check_travel() {
        problems_.require_between({"position_max_mm", "position_min_mm"}, axis_.position_max_mm > axis_.position_min_mm,
                                  fmt::format("position_max_mm is {}, not above position_min_mm {}; increase it",
                                              number_text(axis_.position_max_mm), number_text(axis_.position_min_mm)));
        const double travel_steps = (axis_.position_max_mm - axis_.position_min_mm) * axis_.steps_per_mm;
        problems_.require_between(
            {"position_max_mm", "position_min_mm", "steps_per_mm"}, travel_steps >= kMinTravelSteps,
            fmt::format("position_max_mm is {}, {} steps above position_min_mm; it must be at least {} steps above it: "
                        "increase position_max_mm or steps_per_mm",
                        number_text(axis_.position_max_mm), number_text(travel_steps), number_text(kMinTravelSteps)));
        check_steps("position_min_mm", axis_.position_min_mm);
        check_steps("position_max_mm", axis_.position_max_mm);
    }

    void check_steps(std::string_view key, double mm) {
        problems_.require_between({key, "steps_per_mm"}, std::abs(mm) * axis_.steps_per_mm <= kMaxSteps,
                                  fmt::format("{} is {}, more than {} steps from 0; move it closer to 0", key,
                                              number_text(mm), number_text(kMaxSteps)));
    }

    void check_plant() {
        const double at = axis_.plant.start_position_mm;
        problems_.require_between(
            {"plant.start_position_mm", "position_min_mm", "position_max_mm", "plant.travel_margin_mm"},
            at > limit_min_mm(axis_) && at < limit_max_mm(axis_),
            fmt::format(
                "plant.start_position_mm is {}, not between the limit switches; it must be above {} and below {}",
                number_text(at), number_text(limit_min_mm(axis_)), number_text(limit_max_mm(axis_))));
        if (!axis_.plant.probe_at_mm) { return; }
        const double probe = *axis_.plant.probe_at_mm;
        problems_.require_between(
            {"plant.probe_at_mm", "plant.start_position_mm"},
            probe > limit_min_mm(axis_) && probe < limit_max_mm(axis_) && probe != at,
            fmt::format("plant.probe_at_mm is {}; it must be above {}, below {}, and not at plant.start_position_mm, "
                        "because a probe touches there and beyond it as seen from the start",
                        number_text(probe), number_text(limit_min_mm(axis_)), number_text(limit_max_mm(axis_))));
    }

    /// Plans a trial move, so it runs only if the limits are valid.
    void check_method() {
        const auto is_sound = [this](std::string_view key) { return problems_.is_sound(key); };
        constexpr std::array<std::string_view, 5> kLimits{"steps_per_mm", "start_velocity_mm_s", "max_velocity_mm_s",
                                                          "max_accel_mm_s2", "max_decel_mm_s2"};
        if (!std::ranges::all_of(kLimits, is_sound)) { return; }
        const auto suits = methods::suits(axis_.method, methods::speed_limits_of(axis_, machine_.tick_ns));
        problems_.require(suits.has_value(), "method",
                          fmt::format("method is {}; {}; change the limits, or choose another method",
                                      name_of(axis_.method), (suits ? "" : text_of(suits.error()))));
    }

    void check_place() {
        problems_.require(axis_.host.empty() || is_host_name(axis_.host), "host",
                          "host is \"" + axis_.host + "\"; it must be the name of a host: letters, digits, - and .");
    }

    double tick_s() const { return static_cast<double>(machine_.tick_ns) * 1e-9; }

    const MachineConfig& machine_;
    const AxisConfig& axis_;
    std::size_t index_;
    ProblemList problems_;
};

}  // namespace

std::vector<Problem> axis_problems(const MachineConfig& machine, std::size_t axis) {
    return AxisRules(machine, axis).check();
}

}  // namespace lockstep
