// Clocks of separate boards, for machines in virtual time, and a check of their steps in true time.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "core/step/engine.hpp"
#include "services/virtual/virtual_machine.hpp"

namespace lockstep::test {

/// Offsets of seconds and rates up to 100 ppm fast and slow, different for devices and processes.
inline std::vector<AxisClocks> clocks_apart() {
    return {{.process = {.offset = {3'000'000}, .ppm = 100}, .device = {.offset = {77'000'000}, .ppm = -80}},
            {.process = {.offset = {-1'500'000}, .ppm = -100}, .device = {.offset = {-400}, .ppm = 100}}};
}

/// A machine of boards with such clocks, whose processes hear each other after 20 to 300 us.
inline VirtualOptions by_clocks_apart(const MachineConfig& machine) {
    VirtualOptions options{.machine = MachineSetup{machine}};
    options.machine.timing.time_source = TimeSource::Network;
    options.machine.timing.clock_error_limit_us = 250;
    options.network = {.delay_min{20}, .delay_max{300}};
    options.start = Tick{10'000'000};
    options.clocks = clocks_apart();
    return options;
}

/// The commanded motion in machine time, the devices' motion in true time, and the axes' published bounds.
class TrueTime : public VirtualObserver {
public:
    TrueTime(const VirtualOptions& options, VirtualMachine& vm) : options_(options) { vm.observe(*this); }

    void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& out) override {
        for (const Frame& frame : out.frames) { sent_.emplace(std::pair{frame.epoch, frame.number}, frame); }
    }
    void on_step(MotorIndex axis, StepEdge step) override {
        if (recording_) { made_[axis].push_back(truth_of(axis, step.tick)); }
    }
    void on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& /*node*/) override {
        for (const ExecutedTrack& track : out.tracks) { run_[axis].push_back({track.epoch, track.frame, track.tail}); }
        if (out.state) { bounds_[axis][static_cast<double>(now.value)] = out.state->clock_error.value; }
    }
    void record() { recording_ = true; }

    /// Expects every step within the last bound that its axis published before the step, plus two ticks.
    void expect_within_bounds() {
        for (std::size_t axis = 0; axis < options_.clocks.size(); ++axis) {
            const std::vector<Tick> commanded = commanded_of(axis);
            ASSERT_EQ(made_[axis].size(), commanded.size()) << "axis " << axis;
            for (std::size_t i = 0; i < commanded.size(); ++i) {
                const double off = made_[axis][i] - static_cast<double>(commanded[i].value);
                const auto bound = std::prev(bounds_[axis].upper_bound(made_[axis][i]));
                ASSERT_LE(std::abs(off), static_cast<double>(bound->second) + 2) << "axis " << axis << ", step " << i;
                worst_ = std::max(worst_, std::abs(off));
                widest_ = std::max(widest_, bound->second);
            }
        }
    }
    /// The greatest error of all compared steps, in ticks.
    double worst() const { return worst_; }
    std::int64_t widest() const { return widest_; }
    std::size_t steps() const { return made_.at(0).size(); }

private:
    double truth_of(std::size_t axis, Tick device) const {
        return options_.clocks[axis].device.truth(device, options_.start);
    }
    std::vector<Tick> commanded_of(std::size_t axis) const {
        std::vector<Tick> steps;
        for (const Run& run : run_.at(axis)) {
            const auto frame = sent_.find({run.epoch, run.frame});
            if (frame != sent_.end()) { append_steps(frame->second, frame->second.axes[axis], run.tail, steps); }
        }
        return steps;
    }

    static void append_steps(const Frame& frame, const AxisTrack& track, bool tail, std::vector<Tick>& steps) {
        StepEngine engine(frame.start, track.from);
        const auto execute = [&](const auto& pieces, bool counts) {
            for (const Piece& piece : pieces) {
                engine.begin(piece);
                engine.run(engine.now() + piece.ticks, [&](StepEdge edge) {
                    if (counts) { steps.push_back(edge.tick); }
                });
            }
        };
        execute(track.body, !tail);
        if (tail) { execute(track.tail, true); }
    }

    struct Run {
        Epoch epoch = 0;
        FrameNumber frame = 0;
        bool tail = false;
    };

    VirtualOptions options_;
    bool recording_ = false;
    std::map<std::pair<Epoch, FrameNumber>, Frame> sent_;
    std::map<std::size_t, std::vector<Run>> run_;
    std::map<std::size_t, std::vector<double>> made_;
    std::map<std::size_t, std::map<double, std::int64_t>> bounds_;
    double worst_ = 0;
    std::int64_t widest_ = 0;
};

}  // namespace lockstep::test
