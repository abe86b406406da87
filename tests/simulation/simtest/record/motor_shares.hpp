// Which motors move which axes, by the machine's configuration. It shares no code with core/kinematics.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/indices.hpp"
#include "core/machine.hpp"
#include "tests/screw_by_bezier.hpp"
#include "tests/simulation/simtest/record/carriages.hpp"

namespace lockstep::simtest {

using Places = std::vector<double>;  // steps, of each axis or motor

/// In mm/s of the motor's way: its own limits, or what the limits of the axes demand of it.
struct MotorLimits {
    double start = 0;
    double top = 0;
    double accel = 0;  // mm/s^2
    double decel = 0;
};

class MotorShares {
public:
    explicit MotorShares(const MachineConfig& machine);

    /// With the boards.
    std::size_t motors() const { return shares_.size(); }
    /// Each axis is a motor. Boards follow.
    bool is_direct() const { return is_direct_; }
    /// A motor follows curves while the axes move in lines.
    bool is_curved(std::size_t motor) const { return towers_[motor] || !screws_[motor].is_exact(); }
    /// An axis is moved by one motor without play, which moves no other axis and has the axis's steps, or corrects its
    /// screw.
    bool is_own(std::size_t axis) const;
    bool any_is_curved() const {
        return !carriages_.none() ||
               std::ranges::any_of(screws_, [](const ScrewByBezier& screw) { return !screw.is_exact(); });
    }
    /// A motor moves this axis and no other one.
    bool moves_only(std::size_t motor, std::size_t axis) const;
    /// The motors with which it shares an axis, and it itself.
    MotorSet mates(std::size_t motor) const;
    /// Steps of a motor for each step of an axis; of a motor that is curved, the most within the travel.
    double share(std::size_t motor, std::size_t axis) const { return shares_[motor][axis]; }
    /// The same at a place of the axes, in steps.
    double share_at(std::size_t motor, std::size_t axis, const Places& axes) const;
    /// The place of a motor in steps.
    double place(std::size_t motor, const Places& axes) const;
    /// The place that a motor with this one would have with an exact screw, in steps.
    double without_screw(std::size_t motor, double steps) const;
    /// Steps of an axis that are a step of its coarsest motor; of a delta, that are a step of all carriages at most.
    double step_of(std::size_t axis) const;
    /// Steps of the finest motor that an axis moves, if all axes go one step the way that moves this motor most.
    double finest(std::size_t axis) const;
    /// For a motor that is curved, by how many steps its way differs from a line at most, while the axes move in one
    /// between these places.
    double bulge(std::size_t motor, const Places& from, const Places& to) const;
    /// The steps that the motor needs to turn back, because of its backlash.
    std::int64_t play(std::size_t motor) const { return plays_[motor]; }
    bool any_has_play() const {
        return std::ranges::any_of(plays_, [](std::int64_t play) { return play > 0; });
    }
    double steps_per_mm(std::size_t motor) const { return steps_per_mm_[motor]; }
    const MotorLimits& limits(std::size_t motor) const { return limits_[motor]; }
    /// How much longer a motion may last than the axes' limits need, because motors have lower ones.
    double slower() const { return slower_; }

private:
    void add(const MachineConfig& machine, std::size_t axis, const MotorBlock* block);
    void add_board();
    Carriages::Tool tool(const Places& axes) const;
    /// The place of a motor with an exact screw.
    double exact_place(std::size_t motor, const Places& axes) const;
    double steps_of_carriages(std::size_t coordinate, const Carriages::Tool& at) const;

    Carriages carriages_;
    std::vector<double> axis_steps_per_mm_;
    std::vector<std::optional<std::size_t>> towers_;  // of each motor
    std::vector<std::vector<double>> shares_;
    std::vector<double> steps_per_mm_;
    std::vector<ScrewByBezier> screws_;  // in steps
    std::vector<std::int64_t> plays_;
    std::vector<MotorLimits> limits_;
    double slower_ = 1;
    bool is_direct_;
};

}  // namespace lockstep::simtest
