// One axis's recorded runs on a simulated device: written into the registers by the driver, frame by frame with their
// tails, armed, and executed by the device alone. If pulses ceased early, by a switch or a stop, the host stops the
// device there: the log does not contain the switches.
//
// A device is powered up for each process on record, at its first motion from rest.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "clients/verification/axis_check.hpp"
#include "core/axis/device/device.hpp"

namespace lockstep::replay {

using analysis::Run;

/// A step that the device made.
struct MadeStep {
    StepEdge edge;
    Tick commanded;                // machine time
    Ticks clock_error;             // of its run
    std::int64_t count = 0;        // after it, machine coordinates
    std::int64_t incarnation = 0;  // of the process on record
};

class DeviceReplay final : public verification::RunFollower {
public:
    using OnStep = std::function<void(const MadeStep&)>;

    /// Counts the steps and runs into `findings`, and reports there each difference from the record.
    DeviceReplay(std::string axis, verification::Findings& findings, OnStep on_step);
    ~DeviceReplay() override;

    void on_run(const Run& run) override;
    void on_step(StepEdge step, Tick commanded, bool is_recorded) override;
    void on_run_over() override;
    void on_end() override;

private:
    struct Hardware;
    struct ExpectedStep {
        MadeStep step;
        bool is_recorded = false;
    };

    bool power_up(const Run& run);
    void begin_motion();
    void load_frame(bool is_last);
    void play(Tick until);
    void take(StepEdge made);
    void end_motion();
    void look_at_end();
    void order(const DeviceOrder& order);
    void differ(const std::string& text, std::optional<Tick> expected, std::optional<Tick> seen);

    std::string axis_;
    verification::Findings& findings_;
    OnStep on_step_;
    std::unique_ptr<Hardware> hardware_;  // none before the first motion from rest
    std::int64_t incarnation_ = 0;
    std::int64_t count_at_power_up_ = 0;  // of the device on record
    std::uint64_t motion_ = 0;            // the device's number for it
    FrameNumber frame_ = 0;               // of the motion, loaded last
    std::optional<Run> held_;             // to be loaded when its successor is known
    std::optional<Run> tail_;             // after the frame
    std::optional<Run> newest_;           // the run being played; none: skipped
    std::int64_t count_ = 0;              // machine coordinates, by its steps
    std::optional<Tick> newest_step_;     // of that run
    std::deque<ExpectedStep> expected_;
};

}  // namespace lockstep::replay
