// Measures the motion of the axes of a machine whose motors are not its axes, from the frames on record.
//
// An axis has no steps of its own. Its place follows from the places of all its motors at the same time, which only the
// frames give between two steps. The steps are compared with the frames elsewhere.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "clients/analysis/measure/course.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::analysis {

/// In mm (or degrees) and ticks. Courses have a sample at the begin and at the end of each piece, signed.
struct AxisFigures {
    std::string name;
    double start_mm = 0;
    double end_mm = 0;
    double peak_mm_per_tick = 0;
    double peak_mm_per_tick2 =
        0;  // of its pieces. Jumps of speed between them, up to the start velocity, are not in it
    std::vector<Sample> position;
    std::vector<Sample> speed;
    std::vector<Sample> acceleration;
};

class AxisMeter {
public:
    /// The maximum number of frames that wait for the motors whose record is late.
    static constexpr std::size_t kFramesWaiting = 64;

    AxisMeter(const MachineConfig& machine, std::shared_ptr<const Kinematics> kinematics, bool keeps_curves);

    /// Leaves out own moves, which motors do not make together, and frames of which the log lacks a motor's.
    void take(MotorIndex motor, Run run);
    /// Call once, at the end of the log. Leaves out axes without any frame.
    std::vector<AxisFigures> finish();

private:
    using Frame = std::vector<std::shared_ptr<const Run>>;  // by motor
    struct FrameKey {
        Tick start;
        Epoch epoch = 0;
        auto operator<=>(const FrameKey&) const = default;
    };
    struct Axis {
        AxisFigures figures;
        double mm_per_step = 0;
        bool is_known = false;
        Course position;
        Course speed;
        Course acceleration;
    };
    /// Where an axis is at the begin, in the middle and at the end of a piece, in mm.
    struct PieceOfAxis {
        Tick begin;
        Ticks ticks;
        double first = 0;
        double middle = 0;
        double last = 0;
    };

    void measure(const Frame& frame);
    void note(Axis& axis, const PieceOfAxis& piece) const;
    static double rounded(double mm);

    std::shared_ptr<const Kinematics> kinematics_;
    bool keeps_curves_;
    std::vector<Axis> axes_;
    std::map<FrameKey, Frame> frames_;
};

}  // namespace lockstep::analysis
