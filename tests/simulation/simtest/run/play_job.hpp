// One program on a machine at rest: given, run, interrupted, resumed, ended.
#pragma once

#include "tests/simulation/simtest/run/bench.hpp"

namespace lockstep::simtest {

class JobPlayer {
public:
    /// `at`: where the axes stand, and are left standing.
    JobPlayer(Bench& bench, const Task& task, Counts& at) : bench_(bench), task_(task), at_(at) {}

    /// Ends with the axes at rest, the job recorded: idle where nothing went wrong.
    void play();

private:
    bool start();
    void go_on();
    void interrupt(const Interrupt& interrupt);
    void hold(const Interrupt& interrupt);
    void turn(const Overrides& overrides);
    void stop();
    void stop_at_once();
    void give(const WrongCommand& wrong);
    void resume();
    void record();
    void refused(const char* what, const Reply& reply);
    bool disturbed() const { return bench_.disturbed_since(job_.began); }
    bool ended() const { return bench_.watch().outcome().has_value(); }
    bool goes_on() const { return !bench_.over() && begun_ && !bench_.faulted() && !ended(); }
    bool in(MachinePhase phase) const { return bench_.watch().phase() == phase; }

    Bench& bench_;
    const Task& task_;
    Counts& at_;
    JobRecord job_;
    std::size_t next_ = 0;  // of the interrupts
    bool begun_ = false;
    Tick moving_since_;
};

/// A command that an idle machine must refuse: it stays where it stands.
void play_refusal(Bench& bench, const WrongCommand& wrong, const Counts& at);

/// All axes homed together and in their order; `at` is where they stand then. Recorded as a job, well or badly ended.
void play_homing(Bench& bench, Counts& at, std::optional<double> emergency_s = {});

/// A person's work after a Fault or a restart: reset and homed, until the machine is idle and knows where it stands.
void make_ready(Bench& bench, Counts& at);

/// Pulses are to cease, whatever goes on. Returns when it was asked for.
Tick play_emergency(Bench& bench);

}  // namespace lockstep::simtest
