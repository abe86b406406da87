// How far the axes of a job are from its commanded path, at the steps of its motors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "clients/analysis/asked/asked_path.hpp"
#include "clients/analysis/measure/merged_steps.hpp"
#include "clients/analysis/moves/distance_bound.hpp"

namespace lockstep::analysis {

/// By lane; nullopt for a motor that the job does not have.
using MotorsOfLanes = std::span<const std::optional<MotorIndex>>;

/// All functions that take the path need the one that was given to the constructor.
class PathDistance {
public:
    PathDistance() = default;
    /// The axes are at the begin of its first move. The path must have moves.
    explicit PathDistance(const AskedPath& asked);

    /// The machine's motors are its axes.
    bool is_direct() const { return axes_.is_direct(); }
    /// Of a motor, after its newest step.
    std::int64_t count(MotorIndex motor) const { return counts_[motor]; }
    /// From here on the distance is that from this move.
    void begin(const AskedPath& asked, std::size_t move);
    /// A motor is at a count now. Returns false if that is not a step in `direction` from where it was.
    bool step(MotorIndex motor, std::int64_t count, int direction);
    /// A motor has made steps of which no distance is wanted.
    void pass(MotorIndex motor, std::int64_t change) { counts_[motor] += change; }
    /// The distance of the current place, if it is larger than `largest_square_mm2`.
    void measure(const AskedPath& asked, float& largest_square_mm2);
    /// Takes the steps of motors of the job, and measures the distance at each. If the motors are not the axes, only
    /// the place after all steps of a tick counts.
    void measure(const AskedPath& asked, std::span<const MergedStep> steps, MotorsOfLanes motor_of_lane,
                 float& largest_square_mm2);

private:
    std::size_t note_places(std::span<const MergedStep> steps, MotorsOfLanes motor_of_lane);
    void note_block(std::span<const MergedStep, Places::kMost> steps, MotorsOfLanes motor_of_lane);
    void note_place(std::size_t number);
    void measure_places(const AskedPath& asked, float& largest);
    double square_of_distance_mm2(const AskedPath& asked);

    std::size_t move_ = 0;
    std::vector<std::int64_t> counts_;  // of each motor, after its newest step
    AxisPlaces axes_;
    std::vector<double> at_mm_;  // of each axis, after these steps
    AskedShape shape_;           // of the current move
    DistanceBound bound_;        // of the distance from it
    Places places_;              // after the steps that are being measured
    double near_mm2_ = 0;        // the square of what a step of each motor moves the axes
};

}  // namespace lockstep::analysis
