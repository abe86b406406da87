// Everything that a run did, observed from outside: steps, tracks, frames, orders.
#pragma once

#include <algorithm>
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

/// The body or the tail of a frame, or a move of the axis on its own (epoch 0), as the axis reported it.
struct Track {
    Epoch epoch = 0;
    FrameNumber frame = 0;
    bool tail = false;
    Tick start;
    Ticks ticks;
    Position from;
    Position to;
    std::int64_t net_steps = 0;  // the sum of its pieces
    bool cut = false;            // ended early: at a switch
    FrameNumber armed = 0;       // the highest frame that the axis had then armed in its device
    Tick commanded;              // machine time of its start; the other times are the device's
    Ticks commanded_ticks;
    Ticks clock_error;  // of its steps; at the end of a long tail it can exceed the published bound
};

/// The bound of the clock error that an axis has published.
struct PublishedBound {
    Tick at;
    Ticks error;
};

/// A process ended in the middle of a run, or lost its device: the device continued, but no process reports what it
/// ran.
struct LostRun {
    Tick at;
    std::size_t tracks = 0;  // recorded before
    Epoch epoch = 0;         // 0: a move of the axis on its own, or none
    FrameNumber recorded = 0;
    FrameNumber armed = 0;
};

/// From this time on an axis reports that it follows this owner. A restarted process follows no owner at first.
struct Followed {
    Tick at;
    Identity process = 0;
    Term term;
};

/// An order to an axis, at the time its owner first gave it.
struct GivenOrder {
    Tick at;
    AxisCommand order;
};

struct MotorRecord {
    Tick power_up;
    VirtualClock clock{};           // of the device: steps and tracks are in its time
    Ticks lateness{};               // until the device answers, at most
    MotorSet mates{};               // motors with which it shares an axis: where one is depends on the others
    std::int64_t play = 0;          // between the motor and its slide, in steps
    std::vector<StepEdge> steps{};  // from power-up on
    std::vector<Track> tracks{};
    std::vector<ChannelEvent> channels{};
    std::vector<LostRun> lost{};
    std::vector<PublishedBound> bounds{};
    std::vector<Followed> followed{};  // by time
    std::vector<GivenOrder> orders{};  // by time

    /// Converts to true time, which is machine time.
    Tick truth(const StepEdge& step) const;

    /// The last bound published before this instant; in a tail, the bound of its track if that is larger.
    Ticks bound_at(Tick truth) const;
    /// The last owner reported at or before this instant.
    Followed followed_at(Tick truth) const;
};

/// One axis's part of a sent frame: the begin and end of its body, and the end of its tail.
struct Share {
    Position from;
    Position to;
    Position rest;
    bool operator==(const Share&) const = default;
};

/// A frame at the time it was first sent.
struct SentFrame {
    Tick start;
    Ticks ticks;
    bool last = false;
    std::vector<Share> shares;
    bool operator==(const SentFrame&) const = default;
};

/// All frames of an epoch, and their sender.
struct SentEpoch {
    Term writer;
    Tick first_sent;
    std::map<FrameNumber, SentFrame> frames;
    MotorSet ceases;  // the motors whose pulses cease at a touch
};

/// A coordinator claims the machine.
struct Claim {
    Tick at;
    std::size_t process = 0;
};

/// A touch of an input of a probe.
struct TouchRecord {
    std::size_t input = 0;  // of the machine
    std::size_t motor = 0;  // whose device has it
    Tick pressed;
    Ticks debounce;
    Ticks bounce;
};

/// How a probing move ended.
struct ProbeRecord {
    ProbeResult result;
    std::vector<TouchRecord> touches;  // in order
    std::vector<std::int64_t> from;    // of each motor, where the move began
    std::vector<double> places;        // of each moving motor: where the result places it, in steps
    std::vector<double> within;        // of each moving motor: by how much that may differ from its count, in steps
    double went_on_mm = 0;             // behind the touch
    double most_mm = 0;                // announced
    bool is_undisturbed = false;
};

/// A job from its first frame to its end, and which steps of the axes belong to it.
struct JobRecord {
    bool homing = false;  // no program: a homing, or jogs without a common path
    JobOutcome outcome = JobOutcome::Done;
    Course course;  // of a program
    std::vector<std::size_t> first_step;
    std::vector<std::size_t> end_step;
    Tick began;
    Tick ended;
    std::optional<Tick> emergency;  // the time of an emergency stop
    bool may_have_touched = false;  // a probing move, also when its result was lost with the coordinator
    std::optional<ProbeRecord> probe;

    /// All of the program was run.
    bool is_whole() const { return outcome == JobOutcome::Done && !may_have_touched; }
};

/// An emergency stop, from the command, or from the pressing of an input, until the machine is at rest.
struct Emergency {
    Tick asked;
    Tick rests;
    std::optional<std::size_t> by_input = {};  // the motor whose device has the input
    Ticks debounce = {};                       // of that input, and for how long it bounces
};

/// Keys of a jog that a client released, or whose renewals ceased.
struct JogRecord {
    Tick released;
    Tick ends;  // the axes rest by then
    bool by_silence = false;
    std::size_t job = 0;  // in Recording::jobs
};

struct Recording {
    MachineConfig machine;
    NetworkBehaviour network;
    std::vector<MotorRecord> motors;
    std::vector<JobRecord> jobs;
    std::vector<JogRecord> jogs;
    std::map<Epoch, SentEpoch> epochs;
    std::vector<VirtualFault> faults;  // as they began
    std::vector<Emergency> emergencies;
    std::vector<Claim> claims;
    bool was_moved_by_hand = false;     // a slide, before a homing in place
    std::vector<Tick> epochs_begun;     // the coordinator began an epoch; it may not have sent a frame
    std::vector<Tick> interruptions;    // a motion was interrupted without a command
    std::vector<Tick> machine_faults;   // the coordinator enters Fault, or is about to
    std::vector<Violation> untrue;      // false reports of an axis about itself
    FaultCode fault = FaultCode::None;  // the last one
    std::vector<std::string> troubles;  // events that must never occur
    Tick began;
    Tick ended;

    /// An input that is an emergency stop was pressed.
    bool was_stop_pressed() const {
        return std::ranges::any_of(emergencies, [](const Emergency& e) { return e.by_input.has_value(); });
    }
    bool lossy() const { return network.lost > 0 || network.corrupted > 0; }
    std::span<const StepEdge> steps_of(const JobRecord& job, std::size_t axis) const {
        return std::span(motors[axis].steps).subspan(job.first_step[axis], job.end_step[axis] - job.first_step[axis]);
    }
    /// How far the slide went with each of these steps.
    std::vector<std::int64_t> slide_ways(const JobRecord& job, std::size_t motor) const;
    std::uint64_t steps() const;
    /// Over every step: axis, tick, direction.
    std::uint64_t hash() const;
};

/// Records the axes and frames of a machine in motion.
class Recorder : public VirtualObserver {
public:
    explicit Recorder(Recording& recording)
        : recording_(recording), epoch_(recording.motors.size(), 0), armed_(recording.motors.size(), 0) {}

    void on_step(MotorIndex axis, StepEdge step) override { recording_.motors[axis].steps.push_back(step); }
    void on_channel(MotorIndex axis, const ChannelEvent& event) override {
        recording_.motors[axis].channels.push_back(event);
    }
    void on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& node) override;
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
    std::vector<Epoch> epoch_;        // of each axis; 0: none
    std::vector<FrameNumber> armed_;  // in that epoch
    std::map<std::size_t, bool> lacks_device_;
};

}  // namespace lockstep::simtest
