// A machine in virtual time that is brought into a state, given a command, and brought back by the offered remedies.
#pragma once

#include <optional>
#include <string>

#include "tests/unit/virtual/rig.hpp"

namespace lockstep {

/// A client's command: a column of the table.
struct Question {
    std::string name;
    CommandKind kind = CommandKind::Stop;
    enum class Program : std::uint8_t { None, Known, Unknown } program = Program::None;
    int feed_percent = 0;  // Override
};

/// The result of a command: a cell of the table.
struct Answer {
    std::string text;
    std::optional<FaultCode> refusal;
};

class Walker : public Rig {
public:
    explicit Walker(const VirtualOptions& options) : Rig(options) {}

    // The states use these to bring the machine into them.
    using Rig::ask;
    using Rig::home;
    using Rig::reaches;
    using Rig::vm;
    using Rig::wait;
    /// A job of one straight line from the axes' positions; if `pauses`, it pauses before the line.
    Reply go(CommandKind kind, double x_mm, double y_mm, double feed_mm_s, bool pauses = false);
    /// Continues a job; axes that were jogged in its pause first return.
    Reply resume_and_return();
    void inject(VirtualFault fault, double seconds);
    /// Jogs X by a client that renews the jog for `seconds` or until it ends.
    Reply jog(Identity client, std::optional<double> distance_mm, double seconds);
    /// The program that Question::Program::Unknown names arrives with the next repair.
    void delay_program() { is_program_delayed_ = true; }
    /// Sends the command and waits for its effect. Fails if no answer comes in time, a refusal offers no remedy, or an
    /// accepted command has no effect in time.
    Answer answer_to(const Question& question);

    /// How many alternative remedies a refusal or fault offers.
    static std::size_t choices(FaultCode code);
    /// Follows the code's remedies. The machine must accept each of their commands.
    void follow(FaultCode code, std::size_t choice = 0);
    /// Continues by the offered remedies until a job has run to its end.
    bool recovers();

    std::string state_text() const;

private:
    void TestBody() override {}

    bool settles(double seconds);
    bool is_settled() const;
    void repair();
    void carry_out(Remedy remedy);
    Reply put(const Question& question);
    void expect_effect(const Question& question, const Reply& reply, std::uint64_t jobs_before);

    std::uint64_t programs_ = 0;
    std::uint64_t resumes_ = 0;
    bool jogged_in_pause_ = false;  // when the last command was sent
    bool is_program_delayed_ = false;
};

}  // namespace lockstep
