// A small machine with a probe, and the steps that it makes in its probing moves.
#pragma once

#include "tests/unit/virtual/rig.hpp"

namespace lockstep {

class ProbingRig : public Rig {
protected:
    static constexpr std::size_t kProbe = 0;  // the input

    explicit ProbingRig(const VirtualOptions& options) : Rig(options) { vm.observe(log); }

    /// A program with one probing move, from where the axes park.
    static Program probing(const ProgramMove& move, const Probe& probe = {}) {
        Program program = program_of({}, 0);
        program.blocks.push_back({1, probe});
        program.blocks.push_back({1, move});
        return program;
    }
    /// Homes and begins.
    void begin(const Program& program) {
        home();
        log.steps.clear();
        const Reply reply = run(program);
        ASSERT_EQ(reply.status, ReplyStatus::Accepted) << reply.text;
    }
    void touch(bool closed = true) { vm.set_input(kProbe, closed); }
    const ProbeResult& result() const { return *vm.state()->probe; }

    StepLog log;
};

}  // namespace lockstep
