// One program of a sender's lines. It begins with its first line, runs while it grows, and ends when no more lines
// come.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "clients/grbl/lines/machine_port.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep::grbl {

class LineProgram {
public:
    /// `from_mm`: the position of each axis at the beginning of the first line.
    LineProgram(const MachineConfig& machine, std::vector<double> from_mm, MachinePort& port);

    void append(const Block& block) { blocks_.push_back(block); }
    /// Whether more blocks may be appended.
    bool is_open() const { return !is_ended_; }
    void end() { is_ended_ = true; }
    /// Whether the coordinator has all of it or has refused it.
    bool is_sent() const { return sender_.is_done() || sender_.refusal(); }
    /// Whether the machine was commanded to run it.
    bool is_begun() const { return run_.has_value(); }

    /// Probed: it ended with a probing move, which touched or not.
    enum class Outcome : std::uint8_t { Goes, Done, Probed, Lost };
    /// Sends the blocks that are due, and commands the machine to run the program unless it is held. `state`: the
    /// machine's newest.
    Outcome pass(const MachineState& state, bool is_held, std::chrono::nanoseconds now);
    /// Why the program was lost.
    const std::string& why() const { return why_; }
    /// Whether it is the machine's current job and has not ended.
    bool is_job_of(const MachineState& state) const { return job_ != 0 && state.job == job_ && !state.outcome; }
    /// Whether it is the machine's job or may become it.
    bool may_run(const MachineState& state) const;
    /// Whether the coordinator has had all appended blocks for at least `age`.
    bool is_sent_since(std::chrono::nanoseconds age, std::chrono::nanoseconds now) const;

private:
    void send(std::chrono::nanoseconds now);
    Outcome begin(bool is_held);
    Outcome follow(const MachineState& state);
    Outcome lose(std::string why);

    static constexpr std::chrono::milliseconds kFlushAfter{10};

    MachinePort& port_;
    ProgramSender& sender_;
    bool is_run_whole_;  // LAI runs only whole programs
    std::deque<Block> blocks_;
    bool is_ended_ = false;
    std::optional<CommandTracker> run_;
    bool is_refused_ = false;
    std::uint64_t job_ = 0;
    std::chrono::nanoseconds flushed_{};
    std::optional<std::chrono::nanoseconds> sent_;  // when all appended blocks had been sent
    std::string why_;
};

}  // namespace lockstep::grbl
