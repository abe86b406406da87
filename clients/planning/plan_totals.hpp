// Sums up a planned motion frame by frame: its duration, and how far and how fast each axis goes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/kinematics/motors.hpp"
#include "core/machine.hpp"
#include "core/motion/path.hpp"
#include "core/path/frame_planner.hpp"

namespace lockstep {

struct AxisPlan {
    std::string axis;  // in whose block it stands
    std::string name;
    std::int64_t steps = 0;  // in both directions together
    double peak_velocity_mm_s = 0;
    double peak_acceleration_mm_s2 = 0;  // of its pieces, rising or falling
    double peak_jump_mm_s = 0;           // largest sudden change of its speed: in a corner, at the start or at the stop
    double min_mm = 0;                   // the range of its positions, its start included
    double max_mm = 0;
};

/// The sum of all legs.
struct PlannedTotals {
    Ticks duration;
    int pauses = 0;
    std::vector<AxisPlan> axes;
};

class PlanTotals {
public:
    PlanTotals(const MachineConfig& machine, const AxisCounts& start);

    /// `begins`: where moves begin in the frame.
    void take(const PathFrame& frame, const std::vector<MoveBegin>& begins);
    /// The leg is complete and the machine at rest.
    void end_leg();

    Ticks duration() const { return duration_; }
    const std::vector<AxisPlan>& axes() const { return axes_; }

private:
    struct Axis {
        std::int64_t count = 0;  // in steps, at the end of the last piece
        double speed = 0;        // steps per tick, there
    };

    void note_begins(const std::vector<MoveBegin>& begins);
    void note_pieces(const AxisTrack& track, MotorIndex motor);
    void note_way(const Piece& piece, Position from, MotorIndex motor);
    void note_place(MotorIndex motor, std::int64_t count);
    void note_jump(MotorIndex motor, double change, bool is_between_moves);

    const MachineConfig& machine_;
    std::vector<MotorConfig> motors_;
    std::vector<AxisPlan> axes_;  // of the motors
    std::vector<Axis> now_;
    Ticks duration_;
    std::vector<Ticks> corners_;  // where moves begin in the frame, ascending
    bool ends_move_ = true;       // a move begins with the next frame, or the leg does
};

}  // namespace lockstep
