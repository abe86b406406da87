// How far apart the motors of one axis were, such as the two sides of a gantry, from their steps.
//
// While motors home, their places are not known, so their ways since the begin are compared, as the coordinator does
// (core/coordinator/homing/skew_watch.hpp). In other jobs their places are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "clients/analysis/measure/merged_steps.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"

namespace lockstep::analysis {

/// The greatest differences, in mm of the axis; nullopt if its motors made no steps then.
struct MotorSkew {
    AxisIndex axis;
    std::optional<double> in_homing_mm;
    std::optional<double> in_motion_mm;  // in other jobs, behind all steps of a tick
    std::optional<double> at_rest_mm;    // in other jobs, and at their ends

    /// Keeps the larger ones.
    void add(const MotorSkew& more);
    std::optional<double> largest_mm() const;
};

/// The axes of a machine that have several motors, without figures.
std::vector<MotorSkew> axes_with_skew(const Kinematics& kinematics);

/// Of one job.
class MotorSkewMeter {
public:
    /// After this time without a step the motors are at rest.
    static constexpr Ticks kRest{100'000};

    /// `starts`: where the motors are; empty if that is not known.
    MotorSkewMeter(const Kinematics& kinematics, bool is_homing, std::span<const std::int64_t> starts);

    /// Takes the steps before `until`, and does not pass them. `motor_of_lane`: nullopt for motors of other machines.
    void take(const MergedSteps& steps, std::span<const std::optional<MotorIndex>> motor_of_lane, Tick until);
    /// Call once, at the end of the job.
    const std::vector<MotorSkew>& finish();
    /// Ends it, and adds its figures to those of the same axes.
    void add_to(std::vector<MotorSkew>& all);

private:
    struct Motor {
        std::optional<std::size_t> of;  // in skews_; nullopt: it is the only one of its axis
        double axis_mm_per_step = 0;
        std::optional<std::int64_t> count;  // homing: since the begin
    };
    void follow(const MergedSteps& steps, std::span<const std::optional<MotorIndex>> motor_of_lane, Tick until);
    void note(std::optional<double> MotorSkew::*figure);
    std::optional<double> now_mm(std::size_t skew) const;

    bool is_homing_;
    std::vector<Motor> motors_;
    std::vector<MotorSkew> skews_;
    std::optional<Tick> newest_;  // of their steps
};

}  // namespace lockstep::analysis
