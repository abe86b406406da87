// One program of a sender's lines: begun when its first line comes, run while it grows, ended when no more lines come.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "clients/grbl/lines/asked_command.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep::grbl {

class LineProgram {
public:
    /// `from_mm`: of each axis, where its first line begins.
    LineProgram(const MachineConfig& machine, std::vector<double> from_mm, MachinePort& port);

    void append(const Block& block) { blocks_.push_back(block); }
    /// More may be appended.
    bool is_open() const { return !is_ended_; }
    void end() { is_ended_ = true; }
    /// The coordinator has all of it, or wants no more.
    bool is_sent() const { return sender_.is_done() || sender_.refusal(); }
    /// The machine has been asked to run it.
    bool is_begun() const { return run_.has_value(); }

    enum class Outcome : std::uint8_t { Goes, Done, Lost };
    /// Sends what is due, and asks the machine to run it, unless it is held. `state`: the machine's newest.
    Outcome pass(const MachineState& state, bool is_held, std::chrono::nanoseconds now);
    /// Why it was lost.
    const std::string& why() const { return why_; }
    /// It is the machine's job, which has not ended.
    bool is_job_of(const MachineState& state) const { return job_ != 0 && state.job == job_ && !state.outcome; }
    /// As is_job_of(), or it may become so.
    bool may_run(const MachineState& state) const;
    /// The coordinator has all that was appended, since at least so long.
    bool is_sent_since(std::chrono::nanoseconds age, std::chrono::nanoseconds now) const;

private:
    void send(std::chrono::nanoseconds now);
    Outcome begin(bool is_held, std::chrono::nanoseconds now);
    Outcome follow(const MachineState& state);
    Outcome lose(std::string why);

    static constexpr std::chrono::milliseconds kFlushAfter{10};

    MachinePort& port_;
    ProgramSender& sender_;
    bool is_run_whole_;  // as LAI needs it
    std::deque<Block> blocks_;
    bool is_ended_ = false;
    std::optional<AskedCommand> run_;
    bool is_refused_ = false;
    std::uint64_t job_ = 0;
    std::chrono::nanoseconds flushed_{};
    std::optional<std::chrono::nanoseconds> sent_;  // all of it
    std::string why_;
};

}  // namespace lockstep::grbl
