// Everything a run did, as seen from outside: steps, tracks, frames, orders.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "services/virtual/virtual_clock.hpp"
#include "services/virtual/virtual_machine.hpp"
#include "tests/simulation/simtest/record/course.hpp"
#include "tests/simulation/simtest/record/violation.hpp"

namespace lockstep::simtest {

/// The body or the tail of a frame, or a move of the axis on its own (epoch 0), as the axis says it was run.
struct Track {
    Epoch epoch = 0;
    FrameNumber frame = 0;
    bool tail = false;
    Tick start;
    Ticks ticks;
    Position from;
    Position to;
    std::int64_t net_steps = 0;  // what its pieces amount to
    bool cut = false;            // ended early: at a switch
    FrameNumber armed = 0;       // the highest frame the axis had then told its device it may run
    Tick commanded;              // machine time of its start; all else here is the device's
    Ticks commanded_ticks;
    Ticks clock_error;  // of its steps' times; a long tail's end may be further off than the bound published
};

/// How far its clock may be off, as an axis has published it.
struct PublishedBound {
    Tick at;
    Ticks error;
};

/// A process ended in the middle of a run, or lost its device: the device ran on, and nobody says what.
struct LostRun {
    Tick at;
    std::size_t tracks = 0;  // recorded before
    Epoch epoch = 0;         // 0: a move of the axis on its own, or none
    FrameNumber recorded = 0;
    FrameNumber armed = 0;
};

/// From then on an axis says that it follows this owner; a process made anew follows nobody at first.
struct Followed {
    Tick at;
    Identity process = 0;
    Term term;
};

/// An order to an axis, as its owner first gave it.
struct GivenOrder {
    Tick at;
    AxisCommand order;
};

struct AxisRecord {
    Tick power_up;
    VirtualClock clock{};           // the device's: steps and tracks are in its time
    std::vector<StepEdge> steps{};  // from power-up on
    std::vector<Track> tracks{};
    std::vector<LostRun> lost{};
    std::vector<PublishedBound> bounds{};
    std::vector<Followed> followed{};  // by time
    std::vector<GivenOrder> orders{};  // by time

    /// In true time, which is machine time.
    Tick truth(const StepEdge& step) const;

    /// Published last before that instant; in a tail, what its track says if that is more.
    Ticks bound_at(Tick truth) const;
    /// Said last at or before that instant.
    Followed followed_at(Tick truth) const;
};

/// One axis's share of a frame as sent: where its body begins and ends, and where its tail does.
struct Share {
    Position from;
    Position to;
    Position rest;
    bool operator==(const Share&) const = default;
};

/// A frame as first sent.
struct SentFrame {
    Tick start;
    Ticks ticks;
    bool last = false;
    std::vector<Share> shares;
    bool operator==(const SentFrame&) const = default;
};

/// All frames of an epoch, and who sent them.
struct SentEpoch {
    Term writer;
    Tick first_sent;
    std::map<FrameNumber, SentFrame> frames;
};

/// A coordinator takes the machine to be its own.
struct Claim {
    Tick at;
    std::size_t process = 0;
};

/// A job, from its first frame to its end: which of the axes' steps are its.
struct JobRecord {
    bool homing = false;
    JobOutcome outcome = JobOutcome::Done;
    Course course;  // of a program
    std::vector<std::size_t> first_step;
    std::vector<std::size_t> end_step;
    Tick began;
    Tick ended;
    std::optional<Tick> emergency;  // when a stop of all pulses was asked for
};

/// An emergency stop, from the command until the machine is at rest.
struct Emergency {
    Tick asked;
    Tick rests;
};

struct Recording {
    MachineConfig machine;
    NetworkBehaviour network;
    std::vector<AxisRecord> axes;
    std::vector<JobRecord> jobs;
    std::map<Epoch, SentEpoch> epochs;
    std::vector<VirtualFault> faults;  // as they began
    std::vector<Emergency> emergencies;
    std::vector<Claim> claims;
    std::vector<Tick> epochs_begun;     // the coordinator sets out, and may not come to send a frame
    std::vector<Tick> interruptions;    // the coordinator says that a motion was interrupted by nobody's wish
    std::vector<Tick> machine_faults;   // the coordinator enters Fault, or is about to
    std::vector<Violation> untrue;      // what an axis said of itself
    FaultCode fault = FaultCode::None;  // the last of them
    std::vector<std::string> troubles;  // what must not happen at all, as it happened
    Tick began;
    Tick ended;

    bool lossy() const { return network.lost > 0 || network.corrupted > 0; }
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
    void on_coordinator(std::size_t process, Tick now, const CoordinatorOutputs& out) override;
    void on_fault(Tick now, const VirtualFault& fault, bool begins) override;

private:
    void take_notice(std::size_t axis, const AxisNotice& notice, const AxisNode& node);
    void take_state(std::size_t axis, const AxisState& state, Tick now);
    void take_notice(std::size_t process, const CoordinatorNotice& notice, Tick now);
    void lose_run(std::size_t axis, Tick now);
    void keep(const Frame& frame, Tick now);
    void keep(const AxisCommand& order, Tick now);

    Recording& recording_;
    std::vector<Epoch> epoch_;        // the axes are in; 0: none
    std::vector<FrameNumber> armed_;  // in that epoch
    std::map<std::size_t, bool> lacks_device_;
};

}  // namespace lockstep::simtest
