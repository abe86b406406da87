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

/// The most that a carriage moves for 1 mm of each axis. It does so at the corner of the travel that is furthest from
/// its tower.
std::vector<double> steepest(const Carriages& carriages, std::size_t tower, std::size_t axes) {
    std::vector<double> shares(axes, 0.0);
    for (std::size_t i = 0; i < axes; ++i) {
        Carriages::Tool by{};
        const auto coordinate = carriages.coordinate_of(i);
        if (!coordinate) { continue; }
        by[*coordinate] = 1;
        shares[i] = static_cast<double>(std::abs(carriages.change(tower, carriages.furthest_corner(tower), by)));
    }
    return shares;
}

/// The acceleration of a carriage while the tool goes straight ahead at full speed, in the worst direction.
double bend_of(const MachineConfig& machine, const Carriages& carriages, std::size_t tower) {
    const Carriages::Tool at = carriages.furthest_corner(tower);
    Carriages::Tool speed{};
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        const auto coordinate = carriages.coordinate_of(i);
        if (coordinate) { speed[*coordinate] = machine.axes[i].max_velocity_mm_s; }
    }
    const Carriages::Tool opposite{speed[0], -speed[1], 0};
    return static_cast<double>(
        std::max(std::abs(carriages.bend(tower, at, speed)), std::abs(carriages.bend(tower, at, opposite))));
}

/// The measured errors of a motor's screw, by its own way, with this many units for each mm. Those of a motor that
/// moves one axis only are given by the places of the axis.
ScrewByBezier screw_of(const AxisConfig& axis, std::size_t number, const MotorBlock* block,
                       const std::vector<double>& shares, double units) {
    const std::vector<ScrewPoint>& points = block == nullptr || block->screw.empty() ? axis.screw : block->screw;
    const auto moved = std::ranges::count_if(shares, [](double share) { return share != 0; });
    const double share = moved == 1 && shares[number] != 0 ? shares[number] : 1;
    std::vector<ScrewByBezier::Point> errors;
    for (const ScrewPoint& point : points) {
        errors.push_back({share * units * point.position_mm, share * units * point.error_mm});
    }
    std::ranges::sort(errors, {}, &ScrewByBezier::Point::place);
    return ScrewByBezier(errors);
}

/// Whole steps. The play of a motor that moves one axis only is given in mm of the axis.
std::int64_t play_of(const AxisConfig& axis, std::size_t number, const MotorBlock* block,
                     const std::vector<double>& shares, double steps_per_mm) {
    const auto& backlash = block != nullptr && block->backlash ? block->backlash : axis.backlash;
    if (!backlash) { return 0; }
    const auto moved = std::ranges::count_if(shares, [](double share) { return share != 0; });
    const double share = moved == 1 && shares[number] != 0 ? std::abs(shares[number]) : 1;
    return std::llround(backlash->mm * share * steps_per_mm);
}

}  // namespace

MotorShares::MotorShares(const MachineConfig& machine)
    : carriages_(machine),
      is_direct_(machine.kinematics == KinematicsConfig{} &&
                 std::ranges::all_of(
                     machine.axes, [](const AxisConfig& axis) { return axis.motors.empty() && axis.screw.empty(); })) {
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        axis_steps_per_mm_.push_back(machine.axes[i].steps_per_mm);
        if (machine.axes[i].motors.empty()) { add(machine, i, nullptr); }
        for (const MotorBlock& block : machine.axes[i].motors) { add(machine, i, &block); }
    }
    for (std::size_t k = 0; k < machine.boards.size(); ++k) { add_board(); }
}

/// No axis moves it. Its limits have no effect.
void MotorShares::add_board() {
    towers_.emplace_back();
    shares_.emplace_back(axis_steps_per_mm_.size(), 0.0);
    steps_per_mm_.push_back(1);
    plays_.push_back(0);
    screws_.emplace_back();
    limits_.push_back({1, 1, 1, 1});
}

void MotorShares::add(const MachineConfig& machine, std::size_t axis, const MotorBlock* block) {
    const std::string& name = block == nullptr ? machine.axes[axis].name : block->name;
    const auto tower = carriages_.tower_of(name);
    std::vector<double> shares =
        tower ? steepest(carriages_, *tower, machine.axes.size()) : shares_of(machine, axis, name);
    add_skew(machine, shares);
    towers_.push_back(tower);
    const auto demand = [&](double AxisConfig::*value) {
        double sum = 0;
        for (std::size_t i = 0; i < shares.size(); ++i) { sum += std::abs(shares[i]) * machine.axes[i].*value; }
        return sum;
    };
    const ScrewByBezier screw = screw_of(machine.axes[axis], axis, block, shares, 1);
    const auto speed = [&](double most) { return block == nullptr ? most : block->max_velocity_mm_s.value_or(most); };
    const double top = speed(demand(&AxisConfig::max_velocity_mm_s));
    const double bend = tower ? bend_of(machine, carriages_, *tower) : -screw.most_bend() * top * top;
    const auto limit = [&](double AxisConfig::*of_axis, std::optional<double> MotorBlock::*own, double more = 0) {
        const double all = demand(of_axis);
        const double most = all * (1 - screw.most_slope()) + more;
        const double its = block == nullptr ? most : (block->*own).value_or(most);
        slower_ = std::max(slower_, std::max(all, most) / its);
        return its;
    };
    limits_.push_back({limit(&AxisConfig::start_velocity_mm_s, &MotorBlock::start_velocity_mm_s),
                       limit(&AxisConfig::max_velocity_mm_s, &MotorBlock::max_velocity_mm_s),
                       limit(&AxisConfig::max_accel_mm_s2, &MotorBlock::max_accel_mm_s2, bend),
                       limit(&AxisConfig::max_decel_mm_s2, &MotorBlock::max_decel_mm_s2, bend)});
    const double of_axis = machine.axes[axis].steps_per_mm;
    steps_per_mm_.push_back(block == nullptr ? of_axis : block->steps_per_mm.value_or(of_axis));
    screws_.push_back(screw_of(machine.axes[axis], axis, block, shares, steps_per_mm_.back()));
    plays_.push_back(play_of(machine.axes[axis], axis, block, shares, steps_per_mm_.back()));
    for (std::size_t i = 0; i < shares.size(); ++i) {
        shares[i] *= steps_per_mm_.back() / machine.axes[i].steps_per_mm;
    }
    shares_.push_back(std::move(shares));
}

/// By Cramer's rule: the rise of each carriage by each coordinate, solved for the coordinate.
double MotorShares::steps_of_carriages(std::size_t coordinate, const Carriages::Tool& at) const {
    constexpr std::size_t kTowers = 3;
    std::array<std::array<long double, 3>, kTowers> rises{};
    std::array<long double, kTowers> step_mm{};
    for (std::size_t m = 0; m < motors(); ++m) {
        if (!towers_[m]) { continue; }
        step_mm[*towers_[m]] = 1 / static_cast<long double>(steps_per_mm_[m]);
        for (std::size_t c = 0; c < 3; ++c) {
            Carriages::Tool by{};
            by[c] = 1;
            rises[*towers_[m]][c] = carriages_.change(*towers_[m], at, by);
        }
    }
    const std::size_t c1 = (coordinate + 1) % 3;
    const std::size_t c2 = (coordinate + 2) % 3;
    long double determinant = 0;
    long double most = 0;
    for (std::size_t k = 0; k < kTowers; ++k) {
        const auto& a = rises[(k + 1) % kTowers];
        const auto& b = rises[(k + 2) % kTowers];
        const long double minor = a[c1] * b[c2] - a[c2] * b[c1];
        determinant += rises[k][coordinate] * minor;
        most += std::abs(minor) * step_mm[k];
    }
    return static_cast<double>(most / std::abs(determinant));
}

double MotorShares::step_of(std::size_t axis) const {
    double most = 0;
    if (const auto coordinate = carriages_.coordinate_of(axis)) {
        for (const Carriages::Tool& at : carriages_.samples()) {
            most = std::max(most, steps_of_carriages(*coordinate, at) * axis_steps_per_mm_[axis]);
        }
        return most;
    }
    for (const std::vector<double>& shares : shares_) {
        if (shares[axis] != 0) { most = std::max(most, 1 / std::abs(shares[axis])); }
    }
    return most;
}

bool MotorShares::moves_only(std::size_t motor, std::size_t axis) const {
    const auto axes = std::ranges::count_if(shares_[motor], [](double share) { return share != 0; });
    return axes == 1 && shares_[motor][axis] != 0;
}

MotorSet MotorShares::mates(std::size_t motor) const {
    MotorSet mates;
    for (std::size_t m = 0; m < shares_.size(); ++m) {
        for (std::size_t i = 0; i < shares_[m].size(); ++i) {
            if (shares_[motor][i] != 0 && shares_[m][i] != 0) { mates.insert(MotorIndex{m}); }
        }
    }
    return mates;
}

bool MotorShares::is_own(std::size_t axis) const {
    std::size_t movers = 0;
    for (std::size_t m = 0; m < shares_.size(); ++m) {
        if (shares_[m][axis] == 0) { continue; }
        const double share_mm = shares_[m][axis] * axis_steps_per_mm_[axis] / steps_per_mm_[m];
        const bool follows = shares_[m][axis] == 1 || (!screws_[m].is_exact() && std::abs(share_mm - 1) < 1e-9);
        if (!moves_only(m, axis) || !follows || plays_[m] > 0) { return false; }
        ++movers;
    }
    return movers == 1;
}

double MotorShares::finest(std::size_t axis) const {
    double most = 0;
    for (const std::vector<double>& shares : shares_) {
        double sum = 0;
        for (const double share : shares) { sum += std::abs(share); }
        if (shares[axis] != 0) { most = std::max(most, sum); }
    }
    return most;
}

Carriages::Tool MotorShares::tool(const Places& axes) const {
    Places mm = axes;
    for (std::size_t i = 0; i < mm.size(); ++i) { mm[i] /= axis_steps_per_mm_[i]; }
    return carriages_.tool(mm);
}

double MotorShares::share_at(std::size_t motor, std::size_t axis, const Places& axes) const {
    const auto coordinate = carriages_.coordinate_of(axis);
    if (!towers_[motor] || !coordinate) {
        return shares_[motor][axis] * (1 - screws_[motor].slope(exact_place(motor, axes)));
    }
    Carriages::Tool by{};
    by[*coordinate] = 1 / static_cast<long double>(axis_steps_per_mm_[axis]);
    return static_cast<double>(carriages_.change(*towers_[motor], tool(axes), by) * steps_per_mm_[motor]);
}

/// The curve of a carriage is bent most at one of its ends, where its rod lies flatter. A parabola of this bend is an
/// eighth of it above its chord. So is a screw where it bends most.
double MotorShares::bulge(std::size_t motor, const Places& from, const Places& to) const {
    if (!towers_[motor]) {
        const double way = exact_place(motor, to) - exact_place(motor, from);
        return screws_[motor].most_bend() / 8 * way * way;
    }
    const Carriages::Tool begin = tool(from);
    const Carriages::Tool end = tool(to);
    const Carriages::Tool by{end[0] - begin[0], end[1] - begin[1], end[2] - begin[2]};
    const long double bend = std::max(std::abs(carriages_.bend(*towers_[motor], begin, by)),
                                      std::abs(carriages_.bend(*towers_[motor], end, by)));
    return static_cast<double>(bend / 8 * steps_per_mm_[motor]);
}

double MotorShares::place(std::size_t motor, const Places& axes) const {
    const double exact = exact_place(motor, axes);
    return exact - screws_[motor].error(exact);
}

/// Each round is nearer by the slope of the error, at most 0.05.
double MotorShares::without_screw(std::size_t motor, double steps) const {
    constexpr int kRounds = 20;
    double place = steps;
    for (int round = 0; round < kRounds; ++round) { place = steps + screws_[motor].error(place); }
    return place;
}

double MotorShares::exact_place(std::size_t motor, const Places& axes) const {
    if (const auto tower = towers_[motor]) {
        return static_cast<double>(carriages_.height(*tower, tool(axes)) * steps_per_mm_[motor]);
    }
    double place = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) { place += shares_[motor][i] * axes[i]; }
    return place;
}

}  // namespace lockstep::simtest
