// Gives a sender's lines to the machine as they come, and holds, resumes and drops them.
//
// The lines that follow each other without a pause are one program: they are planned together and joined at speed. When
// no line comes for a moment and the machine needs its end, the program is ended: the machine runs all of it and rests.
// The next line begins another program.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clients/grbl/lines/asked_command.hpp"
#include "clients/grbl/lines/line_program.hpp"
#include "clients/grbl/lines/line_queue.hpp"
#include "clients/grbl/protocol/machine_view.hpp"
#include "clients/grbl/protocol/request.hpp"

namespace lockstep::grbl {

class LineRunner {
public:
    LineRunner(const MachineConfig& machine, MachinePort& port) : machine_(machine), port_(port) {}

    /// A request to run a line. One at a time: the next one comes behind the answer.
    void take(std::uint64_t request, LineToRun&& line);
    /// In each loop. `state`: the machine's newest. `rests`: every axis has reported that it does.
    void pass(const MachineState& state, bool rests, std::chrono::nanoseconds now);

    /// The machine comes to rest on its path, or does not begin.
    void hold(std::chrono::nanoseconds now);
    void resume(std::chrono::nanoseconds now);
    /// Lines are dropped, and the machine comes to rest on its path.
    void stop(std::chrono::nanoseconds now);

    /// The sender has gone: what the machine runs is run to its end, all else is dropped.
    void leave();
    /// And the machine has all of it.
    bool has_left() const { return !program_ || program_->is_sent(); }

    /// No line is to be run, or is running.
    bool is_idle() const { return !program_ && !has_lines() && later_.empty(); }

    struct Answered {
        std::uint64_t request = 0;
        Answer answer;
    };
    std::vector<Answered> take_answers() { return std::exchange(answers_, {}); }
    /// Lines that were accepted are lost: why.
    std::optional<std::string> take_loss() { return std::exchange(loss_, std::nullopt); }
    /// Messages for the sender about its lines.
    void report(const MachineState& state, MachineView& view) const;

    static constexpr std::chrono::milliseconds kIdle{40};       // no line has come for so long: no more may come
    static constexpr std::chrono::milliseconds kLongIdle{250};  // no more are likely to come,
    static constexpr double kNearEnd_s = 1;                     // and so much motion is left: time to plan the end
    static constexpr std::chrono::seconds kStopPatience{20};

private:
    bool has_lines() const { return next_ || queue_.size() > 0; }
    void accept(std::chrono::nanoseconds now);
    void append_later();
    void pass_program(const MachineState& state, std::chrono::nanoseconds now);
    void pass_hold(const MachineState& state, std::chrono::nanoseconds now);
    void pass_stop(const MachineState& state, bool rests, std::chrono::nanoseconds now);
    bool must_end(const MachineState& state, std::chrono::nanoseconds now) const;
    void answer_done(const std::vector<std::uint64_t>& requests);
    void lose(const MachineState& state, std::chrono::nanoseconds now);
    void drop();
    void close();

    MachineConfig machine_;
    MachinePort& port_;
    struct Next {
        std::uint64_t request = 0;
        LineToRun line;
    };
    LineQueue queue_;
    std::optional<Next> next_;  // waits for room
    /// A line that was accepted and is of no program yet.
    struct Later {
        std::vector<double> from_mm;
        std::vector<Block> blocks;
        std::int32_t number = 0;
    };
    std::deque<Later> later_;
    std::unique_ptr<LineProgram> program_;
    std::int32_t last_ = 0;                // the last line of the program
    std::chrono::nanoseconds appended_{};  // when a line was, last
    bool is_hold_wanted_ = false;          // and the machine does not show it yet
    std::optional<AskedCommand> hold_;
    std::optional<AskedCommand> resume_;
    std::optional<AskedCommand> stop_;
    std::optional<std::chrono::nanoseconds> stopping_since_;
    std::vector<Answered> answers_;
    std::optional<std::string> loss_;
};

}  // namespace lockstep::grbl
