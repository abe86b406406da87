// Sends a program in parts while it runs, as a client does: repeats each part until it is taken, and asks meanwhile.
#pragma once

#include <optional>

#include "services/virtual/virtual_machine.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

class StreamSender {
public:
    StreamSender(VirtualMachine& vm, std::uint64_t id, Program program, const std::vector<SentPart>& parts);

    /// Sends what is due now, and takes the replies.
    void tend();
    /// The first part is taken: the program can be run.
    bool may_run() const { return taken_ > 0; }
    /// The reply by which the coordinator refused the program.
    const std::optional<Reply>& refusal() const { return refusal_; }

private:
    bool is_done() const { return refusal_ || taken_ == parts_.size(); }
    ProgramPart part(std::size_t index) const;
    void take(const Reply& reply);
    void send(ProgramPart part);
    Ticks ticks(double seconds) const;

    static constexpr double kRepeatAfter_s = 0.3;  // as clients/session/upload/program_sender.hpp
    static constexpr double kAskAfter_s = 1;

    VirtualMachine& vm_;
    std::uint64_t id_;
    Program program_;
    std::vector<SentPart> parts_;
    std::uint32_t taken_ = 0;               // parts that were taken
    Tick moved_on_;                         // when the last part was taken
    Tick sent_;                             // when the last message was sent
    std::optional<std::uint64_t> awaited_;  // the reply to that message
    std::optional<Reply> refusal_;
};

}  // namespace lockstep::simtest
