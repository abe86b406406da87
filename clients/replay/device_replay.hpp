// Runs one axis's recorded runs on a simulated device. The driver writes them into the registers, frame by frame with
// their tails, and arms them; the device alone executes them. If pulses ceased early because of a switch or a stop, the
// host stops the device at that step, because the log does not contain the switches.
//
// A new device is powered up for each recorded process, at the process's first motion from rest.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "clients/verification/steps/axis_check.hpp"
#include "core/axis/device/device.hpp"

namespace lockstep::replay {

using analysis::Run;

/// A step of the simulated device.
struct MadeStep {
    StepEdge edge;
    Tick commanded;                // machine time
    Ticks clock_error;             // of the step's run
    std::int64_t count = 0;        // position after it, machine coordinates
    std::int64_t incarnation = 0;  // of the recorded process
};

class DeviceReplay final : public verification::RunFollower {
public:
    using OnStep = std::function<void(const MadeStep&)>;

    /// Counts steps and runs into `findings` and reports each difference from the record there.
    DeviceReplay(std::string axis, verification::Findings& findings, OnStep on_step);
    ~DeviceReplay() override;

    void on_run(const Run& run) override;
    void on_step(StepEdge step, Tick commanded, bool is_recorded) override;
    void on_run_over() override;
    void on_gap() override;
    void on_end() override;

private:
    struct Hardware;
    struct ExpectedStep {
        MadeStep step;
        bool is_recorded = false;
    };

    bool power_up(const Run& run);
    void note_skipped();
    void begin_motion();
    void load_frame(bool is_last);
    void play(Tick until);
    void take(StepEdge made);
    void end_motion();
    void look_for_refusal();
    void look_at_end();
    void order(const DeviceOrder& order);
    void differ(const std::string& text, std::optional<Tick> expected, std::optional<Tick> seen);

    std::string axis_;
    verification::Findings& findings_;
    OnStep on_step_;
    std::unique_ptr<Hardware> hardware_;  // null before the first motion from rest
    std::int64_t skipped_ = 0;            // runs since the last note about them
    std::string first_skipped_;
    std::int64_t incarnation_ = 0;
    std::int64_t count_at_power_up_ = 0;  // of the recorded device
    std::uint64_t motion_ = 0;            // its number in the device
    FrameNumber frame_ = 0;               // number of the frame that was loaded last
    std::optional<Run> held_;             // the frame to load when its successor is known
    std::optional<Run> tail_;             // the run after held_
    std::optional<Run> newest_;           // the run being replayed; nullopt if skipped
    std::int64_t count_ = 0;              // position in machine coordinates
    std::optional<Tick> newest_step_;     // the last step of that run
    std::deque<ExpectedStep> expected_;
};

}  // namespace lockstep::replay
