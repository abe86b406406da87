#include "core/kinematics/motors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.hpp"
#include "core/kinematics/motor_limits.hpp"

namespace lockstep {
namespace {

/// Where a motor stands in the configuration: in an axis, with a block of its own or without, or as a board.
struct MotorPlace {
    const AxisConfig* axis = nullptr;
    const MotorBlock* block = nullptr;
    const BoardConfig* board = nullptr;

    const std::string& name() const {
        return board != nullptr ? board->name : block != nullptr ? block->name : axis->name;
    }
    const DeviceName& device() const {
        return board != nullptr ? board->device : block != nullptr ? block->device : axis->device;
    }
};

MotorPlace place_of(const MachineConfig& machine, MotorIndex motor) {
    std::size_t left = motor;
    for (const AxisConfig& axis : machine.axes) {
        const std::size_t count = std::max<std::size_t>(axis.motors.size(), 1);
        if (left < count) { return {&axis, axis.motors.empty() ? nullptr : &axis.motors[left], nullptr}; }
        left -= count;
    }
    check(left < machine.boards.size(), "the machine has the motor");
    return {nullptr, nullptr, &machine.boards[left]};
}

/// A moving motor in the configuration.
struct MotorAt {
    MotorIndex motor;
    AxisIndex axis;
    const AxisConfig& config;  // of the axis
    const MotorBlock* block;   // null: the motor has none
};

/// Calls visit(MotorAt) for each moving motor, in order.
template <typename Visit>
void each_motor(const MachineConfig& machine, Visit visit) {
    MotorIndex motor;
    for (const AxisIndex a : axis_indices(machine.axes.size())) {
        const AxisConfig& axis = machine.axes[a];
        if (axis.motors.empty()) {
            visit(MotorAt{motor, a, axis, nullptr});
            ++motor;
        }
        for (const MotorBlock& block : axis.motors) {
            visit(MotorAt{motor, a, axis, &block});
            ++motor;
        }
    }
}

MotorConfig motor_of_axis(const AxisConfig& axis, AxisIndex place) {
    return {.name = axis.name,
            .axis = place,
            .host = axis.host,
            .device = axis.device,
            .steps_per_mm = axis.steps_per_mm,
            .method = axis.method,
            .unhomed_jog_mm_s = axis.unhomed_jog_mm_s,
            .max_following_error_mm = axis.max_following_error_mm,
            .correct_following_error_mm = axis.correct_following_error_mm,
            .homing = axis.homing,
            .plant = axis.plant,
            .pins = axis.pins};
}

MotorConfig motor_of_block(const AxisConfig& axis, AxisIndex place, const MotorBlock& block) {
    MotorConfig motor = motor_of_axis(axis, place);
    motor.name = block.name;
    motor.host = block.host;
    motor.device = block.device;
    motor.steps_per_mm = block.steps_per_mm.value_or(axis.steps_per_mm);
    motor.homing.switch_position_mm += block.switch_offset_mm;
    motor.plant = block.plant.value_or(axis.plant);
    motor.pins = block.pins.value_or(axis.pins);
    if (block.max_following_error_mm) { motor.max_following_error_mm = block.max_following_error_mm; }
    if (block.correct_following_error_mm) { motor.correct_following_error_mm = block.correct_following_error_mm; }
    return motor;
}

/// It has no travel, so its process refuses a frame with a step. The other limits only have to be above 0. The
/// simulated switches stay open.
MotorConfig motor_of_board(const BoardConfig& board) {
    MotorConfig motor{.name = board.name,
                      .axis = std::nullopt,
                      .moves_one_axis = false,
                      .host = board.host,
                      .device = board.device,
                      .steps_per_mm = 1,
                      .start_velocity_mm_s = 1,
                      .max_velocity_mm_s = 1,
                      .max_accel_mm_s2 = 10,
                      .max_decel_mm_s2 = 10};
    motor.homing.way = HomingWay::InPlace;
    motor.homing.switch_position_mm = -1;
    motor.plant = {.travel_margin_mm = 2, .max_torque_accel_mm_s2 = 10, .max_jump_mm_s = 1};
    return motor;
}

/// The motor's limit by its axes: the sum of the shares of their limits.
template <typename Limit>
double demand(const MachineConfig& machine, std::span<const double> shares, Limit limit) {
    double sum = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (shares[i] != 0) { sum += std::abs(shares[i]) * (machine.axes[i].*limit); }
    }
    return sum;
}

void set_limits(MotorConfig& motor, const MachineConfig& machine, const MotorBlock* block,
                std::span<const double> shares) {
    for (const MotorLimit& one : kMotorLimits) {
        const bool has_own = block != nullptr && block->*one.of_block;
        motor.*one.of_motor = has_own ? *(block->*one.of_block) : demand(machine, shares, one.of_axis);
    }
    bool follows_steps = true;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const AxisConfig& axis = machine.axes[i];
        if (shares[i] == 0) { continue; }
        const double a = shares[i] * axis.position_min_mm;
        const double b = shares[i] * axis.position_max_mm;
        motor.position_min_mm += std::min(a, b);
        motor.position_max_mm += std::max(a, b);
        follows_steps = follows_steps && std::abs(shares[i]) == 1 && motor.steps_per_mm == axis.steps_per_mm;
    }
    if (follows_steps) { return; }
    // The ends of the axes' travels are not on its steps: it rests on those beside them.
    motor.position_min_mm -= 1 / motor.steps_per_mm;
    motor.position_max_mm += 1 / motor.steps_per_mm;
}

/// Converts what the axis gives from mm of the axis to mm of the motor's way. A motor that moves several axes has no
/// switch, and its park is where the park of each axis places it.
void scale(MotorConfig& motor, bool has_own_plant, const MachineConfig& machine, std::span<const double> shares) {
    if (motor.moves_one_axis) {
        const double share = shares[*motor.axis];
        const double size = std::abs(share);
        HomingConfig& homing = motor.homing;
        homing.toward_min = homing.toward_min == (share > 0);
        for (double* mm :
             {&homing.search_velocity_mm_s, &homing.latch_velocity_mm_s, &homing.pulloff_mm, &homing.touch_tolerance_mm,
              &motor.plant.travel_margin_mm, &motor.plant.max_torque_accel_mm_s2, &motor.plant.max_jump_mm_s}) {
            *mm *= size;
        }
        for (double* mm : {&homing.switch_position_mm, &homing.park_mm, &motor.plant.start_position_mm}) {
            *mm *= share;
        }
        if (motor.unhomed_jog_mm_s) { *motor.unhomed_jog_mm_s *= size; }
        return;
    }
    motor.unhomed_jog_mm_s.reset();
    motor.homing.way = HomingWay::InPlace;
    motor.homing.park_mm = 0;
    if (!has_own_plant) { motor.plant = {}; }
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const AxisConfig& axis = machine.axes[i];
        const double size = std::abs(shares[i]);
        motor.homing.park_mm += shares[i] * axis.homing.park_mm;
        if (has_own_plant) { continue; }
        motor.plant.start_position_mm += shares[i] * axis.plant.start_position_mm;
        motor.plant.travel_margin_mm += size * axis.plant.travel_margin_mm;
        motor.plant.max_torque_accel_mm_s2 += size * axis.plant.max_torque_accel_mm_s2;
        motor.plant.max_jump_mm_s += size * axis.plant.max_jump_mm_s;
    }
}

/// A place of the tool that each of the delta's axes has in its configuration.
template <typename Coordinate>
DeltaMap::Point tool_at(const MachineConfig& machine, const MachineDelta& delta, Coordinate coordinate) {
    const auto of = [&](std::size_t k) { return coordinate(machine.axes[delta.axes[k]]); };
    return {of(0), of(1), of(2)};
}

/// The carriage of a tower homes as Z does. With all carriages at their switches the tool is at Z's switch, and over
/// the place where X and Y park. While the tool goes straight ahead at full speed, the carriage accelerates.
void set_carriage(MotorConfig& motor, const MotorBlock* block, const MachineConfig& machine, const MachineDelta& delta,
                  std::size_t tower) {
    const AxisConfig& z = machine.axes[delta.axes[2]];
    const DeltaMap::Reach reach = reach_of(machine, delta, tower);
    const double step_mm = 1 / motor.steps_per_mm;
    motor.position_min_mm = reach.lowest_mm - step_mm;  // a path may leave its line by less than a step
    motor.position_max_mm = reach.highest_mm + step_mm;
    const DeltaMap::Point speed = tool_at(machine, delta, [](const AxisConfig& a) { return a.max_velocity_mm_s; });
    const double across = reach.steepest.x * speed.x + reach.steepest.y * speed.y;
    const double bend_mm_s2 = (speed.x * speed.x + speed.y * speed.y + across * across) / reach.least_root_mm;
    if (block == nullptr || !block->max_accel_mm_s2) { motor.max_accel_mm_s2 += bend_mm_s2; }
    if (block == nullptr || !block->max_decel_mm_s2) { motor.max_decel_mm_s2 += bend_mm_s2; }

    DeltaMap::Point park = tool_at(machine, delta, [](const AxisConfig& a) { return a.homing.park_mm; });
    motor.homing = z.homing;
    motor.homing.park_mm = delta.map.height_mm(tower, park);
    park.z = z.homing.switch_position_mm;
    motor.homing.switch_position_mm =
        delta.map.height_mm(tower, park) + (block == nullptr ? 0 : block->switch_offset_mm);
    if (block != nullptr && block->plant) { return; }
    const DeltaMap::Point start =
        tool_at(machine, delta, [](const AxisConfig& a) { return a.plant.start_position_mm; });
    motor.plant.start_position_mm = delta.map.height_mm(tower, start);
    motor.plant.travel_margin_mm = z.plant.travel_margin_mm;
    motor.plant.max_torque_accel_mm_s2 += bend_mm_s2;
}

/// The configured points of a motor's screw: its own, or its axis's.
const std::vector<ScrewPoint>& screw_of(const AxisConfig& axis, const MotorBlock* block) {
    return block == nullptr || block->screw.empty() ? axis.screw : block->screw;
}

/// `unit`: of the motor's way, for each mm. `share`: mm of the motor's way for each mm of the points.
Screw screw_of(const std::vector<ScrewPoint>& points, double share, double unit) {
    std::vector<ScrewError> errors;
    for (const ScrewPoint& point : points) {
        errors.push_back({share * point.position_mm * unit, share * point.error_mm * unit});
    }
    if (share < 0) { std::ranges::reverse(errors); }
    return Screw(errors);
}

/// The configured backlash of a motor: its own, or its axis's.
const std::optional<BacklashConfig>& backlash_of(const AxisConfig& axis, const MotorBlock* block) {
    return block == nullptr || !block->backlash ? axis.backlash : block->backlash;
}

/// `share`: mm of the motor's way for each mm of the configuration. Places beyond the travel by the play are within the
/// travel of the slide.
void take_up_backlash(MotorConfig& motor, const std::optional<BacklashConfig>& config, double share) {
    if (!config) { return; }
    motor.backlash = {.steps = to_steps(motor, std::abs(share) * config->mm),
                      .speed_mm_s = std::min(config->speed_mm_s.value_or(motor.max_velocity_mm_s) * std::abs(share),
                                             motor.max_velocity_mm_s),
                      .toward_min = motor.homing.toward_min};
    motor.position_min_mm += to_mm(motor, static_cast<double>(motor.backlash.low()));
    motor.position_max_mm += to_mm(motor, static_cast<double>(motor.backlash.high()));
}

/// The points are those of the axis that the motor moves alone; otherwise of the motor's own way.
double share_of_points(const LinearMap& map, MotorIndex motor, AxisIndex axis) {
    return map.only_axis_of(motor) == axis ? map.factor(motor, axis) : 1;
}

/// Converts places of the slide to places of the motor. Limits that the motor has not of its own are so much lower that
/// the axis keeps its limits wherever the motor does.
void correct_screw(MotorConfig& motor, const MotorBlock* block) {
    if (motor.screw.is_exact()) { return; }
    for (double* mm : {&motor.position_min_mm, &motor.position_max_mm, &motor.homing.switch_position_mm,
                       &motor.homing.park_mm, &motor.plant.start_position_mm}) {
        *mm = motor.screw.motor(*mm);
    }
    const double slower = 1 - motor.screw.most_slope();
    const double bend_mm_s2 = motor.screw.most_bend() * motor.max_velocity_mm_s * motor.max_velocity_mm_s;
    motor.homing.search_velocity_mm_s *= slower;
    motor.homing.latch_velocity_mm_s *= slower;
    if (motor.unhomed_jog_mm_s) { *motor.unhomed_jog_mm_s *= slower; }
    if (block == nullptr || !block->start_velocity_mm_s) { motor.start_velocity_mm_s *= slower; }
    if (block == nullptr || !block->max_velocity_mm_s) { motor.max_velocity_mm_s *= slower; }
    if (block == nullptr || !block->max_accel_mm_s2) {
        motor.max_accel_mm_s2 = motor.max_accel_mm_s2 * slower - bend_mm_s2;
    }
    if (block == nullptr || !block->max_decel_mm_s2) {
        motor.max_decel_mm_s2 = motor.max_decel_mm_s2 * slower - bend_mm_s2;
    }
}

/// After homing, the motors have to be where a place of the axes in whole steps puts them. Motors with different steps
/// or screws may otherwise round to steps to which no such place belongs. Axes without steps: nothing changes.
void park_on_steps_of_axes(std::vector<MotorConfig>& motors, const MachineConfig& machine) {
    std::vector<std::int64_t> parks;
    for (const AxisConfig& axis : machine.axes) {
        if (!(axis.steps_per_mm > 0)) { return; }
        parks.push_back(to_steps(axis, axis.homing.park_mm));
    }
    const MotorMap map = step_map_of(machine);
    for (const MotorIndex m : motor_indices(motors.size())) {
        motors[m].homing.park_mm = to_mm(motors[m], std::round(map.place(m, parks)));
    }
}

void set_share(LinearMap& map, std::size_t row, const MachineConfig& machine, const std::string& axis, double share) {
    if (const auto place = machine.axis_named(axis)) { map.factor(row, *place) = share; }
}

}  // namespace

std::size_t moving_motor_count(const MachineConfig& machine) {
    std::size_t count = 0;
    for (const AxisConfig& axis : machine.axes) { count += std::max<std::size_t>(axis.motors.size(), 1); }
    return count;
}

std::size_t motor_count(const MachineConfig& machine) { return moving_motor_count(machine) + machine.boards.size(); }

std::vector<std::string> motor_names(const MachineConfig& machine) {
    std::vector<std::string> names;
    for (const MotorIndex m : motor_indices(motor_count(machine))) { names.push_back(motor_name(machine, m)); }
    return names;
}

std::vector<std::string> moving_motor_names(const MachineConfig& machine) {
    std::vector<std::string> names = motor_names(machine);
    names.resize(moving_motor_count(machine));
    return names;
}

const std::string& motor_name(const MachineConfig& machine, MotorIndex motor) {
    return place_of(machine, motor).name();
}

bool estimates_clock(const MachineConfig& machine, MotorIndex motor) {
    return machine.timing.time_source == TimeSource::Network || place_of(machine, motor).device().has_own_clock();
}

double motor_steps_per_mm(const MachineConfig& machine, MotorIndex motor) {
    const MotorPlace place = place_of(machine, motor);
    if (place.board != nullptr) { return motor_of_board(*place.board).steps_per_mm; }
    return place.block == nullptr ? place.axis->steps_per_mm
                                  : place.block->steps_per_mm.value_or(place.axis->steps_per_mm);
}

std::optional<MotorIndex> motor_named(const MachineConfig& machine, std::string_view name) {
    for (const MotorIndex m : motor_indices(motor_count(machine))) {
        if (motor_name(machine, m) == name) { return m; }
    }
    return std::nullopt;
}

LinearMap motor_map_of(const MachineConfig& machine) {
    const KinematicsConfig& kinematics = machine.kinematics;
    LinearMap map(moving_motor_count(machine), machine.axes.size());
    each_motor(machine, [&](const MotorAt& at) {
        map.factor(at.motor, at.axis) = 1;
        if (kinematics.core_xy && at.config.name == kinematics.core_xy->first) {
            set_share(map, at.motor, machine, kinematics.core_xy->second, 1);
        }
        if (kinematics.core_xy && at.config.name == kinematics.core_xy->second) {
            set_share(map, at.motor, machine, kinematics.core_xy->first, 1);
            map.factor(at.motor, at.axis) = -1;
        }
    });
    for (const MotorRow& row : kinematics.matrix) {
        const auto found = motor_named(machine, row.motor);
        if (!found || *found >= map.motors()) { continue; }
        for (std::size_t i = 0; i < map.axes(); ++i) { map.factor(*found, i) = 0; }
        for (const AxisShare& share : row.of) { set_share(map, *found, machine, share.axis, share.factor); }
    }
    for (const Skew& skew : kinematics.skews) {
        LinearMap shear = LinearMap::identity(machine.axes.size());
        constexpr double kMetre_mm = 1000;
        if (const auto x = machine.axis_named(skew.x)) {
            set_share(shear, *x, machine, skew.y, skew.mm_per_m / kMetre_mm);
        }
        map = map.after(shear);
    }
    if (const auto delta = delta_of(machine)) {
        for (std::size_t k = 0; k < DeltaMap::kTowers; ++k) {
            const DeltaMap::Point steepest = reach_of(machine, *delta, k).steepest;
            map.factor(delta->motors[k], delta->axes[0]) = steepest.x;
            map.factor(delta->motors[k], delta->axes[1]) = steepest.y;
            map.factor(delta->motors[k], delta->axes[2]) = steepest.z;
        }
    }
    return map;
}

std::optional<MachineDelta> delta_of(const MachineConfig& machine) {
    const std::optional<DeltaConfig>& config = machine.kinematics.delta;
    if (!config || config->towers.size() != DeltaMap::kTowers) { return std::nullopt; }
    std::array<DeltaMap::Tower, DeltaMap::kTowers> towers;
    for (std::size_t k = 0; k < towers.size(); ++k) {
        const DeltaTower& tower = config->towers[k];
        towers[k] = {tower.x_mm, tower.y_mm, tower.rod_mm};
    }
    MachineDelta delta{.map = DeltaMap(towers)};
    const std::array names{config->x, config->y, config->z};
    for (std::size_t k = 0; k < towers.size(); ++k) {
        const auto motor = motor_named(machine, config->towers[k].motor);
        const auto axis = machine.axis_named(names[k]);
        if (!motor || *motor >= moving_motor_count(machine) || !axis || !(towers[k].rod_mm > 0)) {
            return std::nullopt;
        }
        delta.axes[k] = *axis;
        delta.motors[k] = *motor;
        delta.motor_steps_per_mm[k] = motor_steps_per_mm(machine, *motor);
        delta.axis_steps_per_mm[k] = machine.axes[delta.axes[k]].steps_per_mm;
    }
    return delta;
}

DeltaMap::Reach reach_of(const MachineConfig& machine, const MachineDelta& delta, std::size_t tower) {
    return delta.map.reach(tower, tool_at(machine, delta, [](const AxisConfig& a) { return a.position_min_mm; }),
                           tool_at(machine, delta, [](const AxisConfig& a) { return a.position_max_mm; }));
}

std::vector<MotorConfig> moving_motors_of(const MachineConfig& machine) {
    const LinearMap map = motor_map_of(machine);
    const auto delta = delta_of(machine);
    std::vector<MotorConfig> motors;
    each_motor(machine, [&](const MotorAt& at) {
        const auto& [m, a, axis, block] = at;
        MotorConfig motor = block == nullptr ? motor_of_axis(axis, a) : motor_of_block(axis, a, *block);
        const auto shares = map.row(m);
        set_limits(motor, machine, block, shares);
        motor.moves_one_axis = map.only_axis_of(m) == a;
        scale(motor, block != nullptr && block->plant.has_value(), machine, shares);
        const auto tower = delta ? delta->tower_of(m) : std::nullopt;
        if (tower) { set_carriage(motor, block, machine, *delta, *tower); }
        motor.screw = screw_of(screw_of(axis, block), share_of_points(map, m, a), 1);
        correct_screw(motor, block);
        take_up_backlash(motor, backlash_of(axis, block), share_of_points(map, m, a));
        motors.push_back(std::move(motor));
    });
    park_on_steps_of_axes(motors, machine);
    return motors;
}

bool has_backlash(const MachineConfig& machine) {
    bool has_any = false;
    each_motor(machine, [&](const MotorAt& at) { has_any = has_any || backlash_of(at.config, at.block).has_value(); });
    return has_any;
}

std::vector<MotorConfig> motors_of(const MachineConfig& machine) {
    std::vector<MotorConfig> motors = moving_motors_of(machine);
    for (const BoardConfig& board : machine.boards) { motors.push_back(motor_of_board(board)); }
    return motors;
}

MotorMap step_map_of(const MachineConfig& machine) {
    LinearMap map = motor_map_of(machine);
    std::vector<Screw> screws;
    bool has_screws = false;
    each_motor(machine, [&](const MotorAt& at) {
        screws.push_back(screw_of(screw_of(at.config, at.block), share_of_points(map, at.motor, at.axis),
                                  motor_steps_per_mm(machine, at.motor)));
        has_screws = has_screws || !screws.back().is_exact();
    });
    if (!has_screws) { screws.clear(); }
    for (const MotorIndex m : motor_indices(map.motors())) {
        for (std::size_t i = 0; i < map.axes(); ++i) {
            map.factor(m, i) *= motor_steps_per_mm(machine, m) / machine.axes[i].steps_per_mm;
        }
    }
    return {std::move(map), delta_of(machine), std::move(screws)};
}

bool corrects_screw(const MachineConfig& machine, AxisIndex axis) {
    const MotorMap map = step_map_of(machine);
    for (const MotorIndex m : motor_indices(map.motors())) {
        if (map.screw(m) != nullptr && map.shares().factor(m, axis) != 0) { return true; }
    }
    return false;
}

}  // namespace lockstep
