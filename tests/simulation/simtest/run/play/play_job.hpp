// One program on a machine at rest: it is sent, run, interrupted, resumed and ended.
#pragma once

#include "tests/simulation/simtest/run/bench.hpp"

namespace lockstep::simtest {

class JobPlayer {
public:
    /// `at`: the positions of the motors, updated after the job.
    JobPlayer(Bench& bench, const Task& task, Counts& at) : bench_(bench), task_(task), at_(at) {}

    /// Ends with the axes at rest and the job recorded; the machine is Idle if no fault occurred.
    void play();

private:
    bool start();
    bool is_at(const Counts& axes) const;
    double ample_seconds() const;
    double streamed_seconds() const;
    void go_on();
    void interrupt(const Interrupt& interrupt);
    void hold(const Interrupt& interrupt);
    void set_overrides(const Overrides& overrides);
    void stop();
    void stop_at_once();
    void press_stop();
    void open_door(const Interrupt& interrupt);
    void give(const WrongCommand& wrong);
    void touch(const Interrupt& interrupt);
    void resume();
    void record();
    void record_probe();
    void refused(const char* what, const Reply& reply);
    bool disturbed() const { return bench_.disturbed_since(job_.began); }
    bool ended() const { return bench_.watch().outcome().has_value(); }
    bool goes_on() const { return !bench_.over() && begun_ && !bench_.faulted() && !ended(); }
    bool in(MachinePhase phase) const { return bench_.watch().phase() == phase; }

    Bench& bench_;
    const Task& task_;
    Counts& at_;
    JobRecord job_;
    std::size_t next_ = 0;  // index of the next interrupt
    bool begun_ = false;
    Tick moving_since_;
    std::vector<TouchRecord> touches_;
    std::uint64_t probed_before_ = 0;  // the job of the last result of a probe
};

/// A command that an idle machine must refuse: its position stays the same.
void play_refusal(Bench& bench, const WrongCommand& wrong, const Counts& at);

/// Homes all axes together and in their order; `at` is their position then. Recorded as a job with any outcome.
void play_homing(Bench& bench, Counts& at, const std::optional<HomingStop>& stop = {});

/// The operator's work after a Fault or a restart: resets and homes until the machine is Idle with known positions.
void make_ready(Bench& bench, Counts& at);

/// Commands an emergency stop during any motion. Returns the time of the command.
Tick play_emergency(Bench& bench);

}  // namespace lockstep::simtest
