// A small machine with a probe, and the steps that it makes in its probing moves.
#pragma once

#include "tests/unit/virtual/rig.hpp"

namespace lockstep {

class ProbingRig : public Rig {
protected:
    static constexpr std::size_t kProbe = 0;  // an input

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
    /// Changes all inputs of the machine, which are the probe's.
    void touch(bool closed = true) {
        for (std::size_t i = 0; i < vm.machine().inputs.size(); ++i) { vm.set_input(i, closed); }
    }
    /// Begins, and touches while the machine comes to a hold.
    void touch_before_a_hold(const Program& program) {
        begin(program);
        wait(1);
        ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
        touch();
        wait(2);
        EXPECT_EQ(vm.state()->phase, MachinePhase::Idle) << describe();
        ASSERT_TRUE(result().touched());
    }
    /// Begins, holds, resumes, and touches.
    void touch_after_a_hold(const Program& program) {
        begin(program);
        wait(1);
        ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Holding, 3)) << describe();
        ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
        wait(1);
        touch();
        ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
        ASSERT_TRUE(result().touched());
    }
    /// A program that begins where the axes rest ends at its place.
    void go_on_from_here() {
        const std::vector<std::int64_t> at = counts();
        const std::vector<double> here{static_cast<double>(at[kX]) / 100, static_cast<double>(at[kY]) / 100};
        ASSERT_EQ(run(program_of({{6, 6}}, 20, here)).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 9)) << describe();
        EXPECT_EQ(counts(), (std::vector<std::int64_t>{600, 600}));
    }
    const ProbeResult& result() const { return *vm.state()->probe; }

    StepLog log;
};

}  // namespace lockstep
