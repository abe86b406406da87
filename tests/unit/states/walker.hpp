// A machine in virtual time that is brought into a state, asked something, and brought back by the remedies it offers.
#pragma once

#include <optional>
#include <string>

#include "services/coordinator/program_inbox.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {

/// What a client may ask; the column of the table.
struct Question {
    std::string name;
    CommandKind kind = CommandKind::Stop;
    enum class Program : std::uint8_t { None, Known, Unknown } program = Program::None;
    int feed_percent = 0;  // Override
};

/// What came of it: the cell of the table.
struct Answer {
    std::string text;
    std::optional<FaultCode> refusal;
};

class Walker : public Rig {
public:
    explicit Walker(const VirtualOptions& options) : Rig(options) {}

    // For states to bring the machine into them.
    using Rig::ask;
    using Rig::home;
    using Rig::reaches;
    using Rig::vm;
    using Rig::wait;
    /// A job of one straight line from where the axes stand; it pauses before, if so asked.
    Reply go(CommandKind kind, double x_mm, double y_mm, double feed_mm_s, bool pauses = false);
    void befall(VirtualFault fault, double seconds);
    /// Of the program that Question::Program::Unknown names.
    void send_all_but_the_last_chunk();

    /// Asks, and sees what comes of it. Fails where no answer comes in time, a refusal offers no remedy, or what was
    /// accepted has no effect in time.
    Answer answer_to(const Question& question);

    /// How many ways to follow its remedies a refusal or fault offers.
    static std::size_t choices(FaultCode code);
    /// Does what the code's remedies say; each command of them must be accepted.
    void follow(FaultCode code, std::size_t choice = 0);
    /// Goes on by the remedies offered until a job has run to its end.
    bool recovers();

    std::string state_text() const;

private:
    void TestBody() override {}

    void deliver(const ProgramChunk& chunk);
    bool settles(double seconds);
    bool is_settled() const;
    void mend();
    void carry_out(Remedy remedy);
    Reply put(const Question& question);
    void expect_effect(const Question& question, const Reply& reply, std::uint64_t jobs_before);

    std::uint64_t programs_ = 0;
    ProgramInbox inbox_;
    std::optional<ProgramChunk> unsent_;
};

}  // namespace lockstep
