#include "tests/simulation/simtest/record/motor_shares.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::simtest {
namespace {

/// mm of a motor's way for each mm of each axis, without the skew of the guides.
std::vector<double> shares_of(const MachineConfig& machine, std::size_t axis, const std::string& motor) {
    std::vector<double> shares(machine.axes.size(), 0.0);
    const auto axis_named = [&](const std::string& name) {
        return static_cast<std::size_t>(std::ranges::find(machine.axes, name, &AxisConfig::name) -
                                        machine.axes.begin());
    };
    for (const MotorRow& row : machine.kinematics.matrix) {
        if (row.motor != motor) { continue; }
        for (const AxisShare& share : row.of) { shares[axis_named(share.axis)] = share.factor; }
        return shares;
    }
    shares[axis] = 1;
    if (!machine.kinematics.core_xy) { return shares; }
    const std::size_t first = axis_named(machine.kinematics.core_xy->first);
    const std::size_t second = axis_named(machine.kinematics.core_xy->second);
    if (axis != first && axis != second) { return shares; }
    shares[first] = 1;
    shares[second] = axis == first ? 1 : -1;
    return shares;
}

/// An axis that is skewed goes further by mm_per_m for each metre of the other one.
void add_skew(const MachineConfig& machine, std::vector<double>& shares) {
    for (const Skew& skew : machine.kinematics.skews) {
        double* of_x = nullptr;
        double* of_y = nullptr;
        for (std::size_t i = 0; i < shares.size(); ++i) {
            if (machine.axes[i].name == skew.x) { of_x = &shares[i]; }
            if (machine.axes[i].name == skew.y) { of_y = &shares[i]; }
        }
        *of_y += *of_x * skew.mm_per_m / 1000;
    }
}

}  // namespace

MotorShares::MotorShares(const MachineConfig& machine)
    : is_direct_(machine.kinematics == KinematicsConfig{} &&
                 std::ranges::all_of(machine.axes, [](const AxisConfig& axis) { return axis.motors.empty(); })) {
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        if (machine.axes[i].motors.empty()) { add(machine, i, nullptr); }
        for (const MotorBlock& block : machine.axes[i].motors) { add(machine, i, &block); }
    }
}

void MotorShares::add(const MachineConfig& machine, std::size_t axis, const MotorBlock* block) {
    std::vector<double> shares = shares_of(machine, axis, block == nullptr ? machine.axes[axis].name : block->name);
    add_skew(machine, shares);
    const auto demand = [&](double AxisConfig::*value) {
        double sum = 0;
        for (std::size_t i = 0; i < shares.size(); ++i) { sum += std::abs(shares[i]) * machine.axes[i].*value; }
        return sum;
    };
    const auto limit = [&](double AxisConfig::*of_axis, std::optional<double> MotorBlock::*own) {
        const double most = demand(of_axis);
        const double its = block == nullptr ? most : (block->*own).value_or(most);
        slower_ = std::max(slower_, most / its);
        return its;
    };
    limits_.push_back({limit(&AxisConfig::start_velocity_mm_s, &MotorBlock::start_velocity_mm_s),
                       limit(&AxisConfig::max_velocity_mm_s, &MotorBlock::max_velocity_mm_s),
                       limit(&AxisConfig::max_accel_mm_s2, &MotorBlock::max_accel_mm_s2),
                       limit(&AxisConfig::max_decel_mm_s2, &MotorBlock::max_decel_mm_s2)});
    const double of_axis = machine.axes[axis].steps_per_mm;
    steps_per_mm_.push_back(block == nullptr ? of_axis : block->steps_per_mm.value_or(of_axis));
    for (std::size_t i = 0; i < shares.size(); ++i) {
        shares[i] *= steps_per_mm_.back() / machine.axes[i].steps_per_mm;
    }
    shares_.push_back(std::move(shares));
}

double MotorShares::step_of(std::size_t axis) const {
    double most = 0;
    for (const std::vector<double>& shares : shares_) {
        if (shares[axis] != 0) { most = std::max(most, 1 / std::abs(shares[axis])); }
    }
    return most;
}

double MotorShares::place(std::size_t motor, const Places& axes) const {
    double place = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) { place += shares_[motor][i] * axes[i]; }
    return place;
}

}  // namespace lockstep::simtest
