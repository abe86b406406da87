// A client that jogs the axes of a machine at rest: it presses keys, renews its command, and releases them or ends.
#pragma once

#include "tests/simulation/simtest/run/bench.hpp"

namespace lockstep::simtest {

class JogPlayer {
public:
    /// `at`: the positions of the motors, updated after the jogs.
    JogPlayer(Bench& bench, const JogSession& session, Counts& at) : bench_(bench), session_(session), at_(at) {}

    /// Ends with the axes at rest and the jogs recorded.
    void play();

private:
    void press(const JogPress& press);
    void hold_keys(const JogPress& press);
    void check_answer(const JogPress& press);
    void release(const JogPress& press);
    void come_to_rest();
    void record();
    void check_place();
    const Reply* answer() const;
    bool needs_path(const JogPress& press) const;
    bool is_at_end(const JogAxis& jog) const;
    bool has_astray_motors() const;
    bool has_course() const { return session_.presses.size() == 1 && needs_path(session_.presses.front()); }
    double stop_seconds() const;
    double reaction_seconds() const;
    bool disturbed() const { return bench_.lossy() || bench_.disturbed_since(job_.began); }

    Bench& bench_;
    const JogSession& session_;
    Counts& at_;
    JobRecord job_;
    Command command_;
    Tick renewed_;
    bool is_first_ = true;
};

}  // namespace lockstep::simtest
