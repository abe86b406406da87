#include "clients/scenario/model/final_place.hpp"

#include <algorithm>
#include <cmath>

#include "clients/text/format.hpp"

namespace lockstep::scenario {
namespace {

/// Null if the motor's last place is not on record.
const proto::AxisAnalysis* analysis_of(const proto::AnalysisReport& analysis, const std::string& motor) {
    const auto& all = analysis.axes();
    const auto found = std::ranges::find_if(all, [&](const auto& one) { return one.name() == motor; });
    return found == all.end() || !found->has_position_end_mm() ? nullptr : &*found;
}

}  // namespace

std::expected<FinalPlace, std::string> final_place(const proto::AnalysisReport& analysis, const MachineConfig& machine,
                                                   AxisIndex axis) {
    const Kinematics kinematics(machine);
    if (const auto own = kinematics.own_motor(axis); own && !kinematics.corrects_screw(*own)) {
        const proto::AxisAnalysis* const found = analysis_of(analysis, kinematics.motors()[*own].name);
        if (found == nullptr) { return std::unexpected("not recorded"); }
        return FinalPlace{found->position_end_mm(), Tick{found->last_tick()}, 0};
    }
    MotorCounts counts;
    Tick last;
    double most_play_mm = 0;
    for (const MotorConfig& motor : kinematics.moving_motors()) {
        const proto::AxisAnalysis* const found = analysis_of(analysis, motor.name);
        if (found == nullptr) { return std::unexpected("motor " + motor.name + " is not recorded"); }
        counts.steps.append(to_steps(motor, found->position_end_mm()));
        last = std::max(last, Tick{found->last_tick()});
        most_play_mm = std::max(most_play_mm, to_mm(motor, static_cast<double>(motor.backlash.steps)));
    }
    if (const auto astray = kinematics.astray(counts); astray && most_play_mm == 0) {
        return std::unexpected(kinematics.label(astray->motor) + " is " + fixed(std::abs(astray->off_mm), 4) +
                               " mm from where the other motors place it");
    }
    const auto steps = static_cast<double>(kinematics.axes_at(counts)[axis]);
    const std::int64_t off_rest = kinematics.rest_steps(axis) + to_steps(machine.axes[axis], most_play_mm);
    return FinalPlace{to_mm(machine.axes[axis], steps), last, off_rest};
}

}  // namespace lockstep::scenario
