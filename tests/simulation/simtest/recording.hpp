// Everything a run did, as seen from outside: steps, tracks, frames, orders.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "services/virtual/virtual_machine.hpp"
#include "tests/simulation/simtest/course.hpp"

namespace lockstep::simtest {

/// The body or the tail of a frame, or a move of the axis on its own (epoch 0), as the axis says it was run.
struct Track {
    Epoch epoch = 0;
    FrameNumber frame = 0;
    bool tail = false;
    Tick start;
    Ticks ticks;
    std::int64_t net_steps = 0;  // what its pieces amount to
    bool cut = false;            // ended early: at a switch
    FrameNumber armed = 0;       // the highest frame the axis had then told its device it may run
};

struct AxisRecord {
    std::vector<StepEdge> steps;  // from power-up on
    std::vector<Track> tracks;
};

/// A frame as first sent.
struct SentFrame {
    Tick start;
    Ticks ticks;
    bool last = false;
    std::vector<Displacement> shares;  // what each axis's body amounts to
    bool operator==(const SentFrame&) const = default;
};

/// A job, from its first frame to its end: which of the axes' steps are its.
struct JobRecord {
    bool homing = false;
    JobOutcome outcome = JobOutcome::Done;
    Course course;  // of a program
    std::vector<std::size_t> first_step;
    std::vector<std::size_t> end_step;
};

struct Recording {
    MachineConfig machine;
    std::vector<AxisRecord> axes;
    std::vector<JobRecord> jobs;
    std::map<Epoch, std::map<FrameNumber, SentFrame>> frames;
    std::vector<Identity> writers;      // of frames, each once
    std::vector<std::string> troubles;  // what must not happen at all, as it happened
    Tick began;
    Tick ended;

    std::span<const StepEdge> steps_of(const JobRecord& job, std::size_t axis) const {
        return std::span(axes[axis].steps).subspan(job.first_step[axis], job.end_step[axis] - job.first_step[axis]);
    }
    std::uint64_t steps() const;
    /// Of every step: axis, tick, direction.
    std::uint64_t hash() const;
};

/// Fills a recording's axes and frames from a machine in motion.
class Recorder : public VirtualObserver {
public:
    explicit Recorder(Recording& recording)
        : recording_(recording), epoch_(recording.axes.size(), 0), armed_(recording.axes.size(), 0) {}

    void on_step(std::size_t axis, StepEdge step) override { recording_.axes[axis].steps.push_back(step); }
    void on_axis(std::size_t axis, Tick now, const AxisOutputs& out, AxisNode& node) override;
    void on_coordinator(Tick now, const CoordinatorOutputs& out) override;

private:
    void keep(const Frame& frame);

    Recording& recording_;
    std::vector<Epoch> epoch_;        // the axes are in; 0: none
    std::vector<FrameNumber> armed_;  // in that epoch
};

}  // namespace lockstep::simtest
