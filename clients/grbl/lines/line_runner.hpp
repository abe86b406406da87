// Passes a sender's lines to the machine as they come, and holds, resumes and drops them.
//
// Lines that follow each other without a pause are one program. They are planned together and joined at speed. When no
// line comes for a while and the machine cannot continue without more blocks or the end, the program is ended. The
// machine then runs all of it and comes to rest. The next line begins another program.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clients/grbl/lines/line_hold.hpp"
#include "clients/grbl/lines/line_program.hpp"
#include "clients/grbl/lines/line_queue.hpp"
#include "clients/grbl/lines/line_stop.hpp"
#include "clients/grbl/protocol/machine_view.hpp"
#include "clients/grbl/protocol/request.hpp"

namespace lockstep::grbl {

class LineRunner {
public:
    LineRunner(const MachineSetup& machine, MachinePort& port)
        : machine_(machine), port_(port), hold_(port), stop_(port) {}

    /// Takes a request to run a line. The next request must come after the answer to this one.
    void take(std::uint64_t request, LineToRun&& line);
    /// Call in each loop. `state`: the machine's newest. `rests`: every axis has reported that it is at rest.
    void pass(const MachineState& state, bool rests, std::chrono::nanoseconds now);

    /// Lets the machine come to rest on its path, or not begin.
    void hold();
    void resume();
    /// Drops all lines, and lets the machine come to rest on its path.
    void stop(std::chrono::nanoseconds now);

    /// Call when the sender has gone. The machine runs its program to the end; all other lines are dropped.
    void leave();
    /// After leave(): whether the machine has all of the program.
    bool has_left() const { return !program_ || program_->is_sent(); }

    /// Whether no line waits or runs.
    bool is_idle() const { return !program_ && !has_lines() && later_.empty(); }

    struct Answered {
        std::uint64_t request = 0;
        Answer answer;
    };
    std::vector<Answered> take_answers() { return std::exchange(answers_, {}); }
    /// Returns once why accepted lines were lost; nullopt if none were.
    std::optional<std::string> take_loss() { return std::exchange(loss_, std::nullopt); }
    /// Sets the fields of the view about the sender's lines.
    void report(const MachineState& state, MachineView& view) const;

    static constexpr std::chrono::milliseconds kIdle{40};       // minimum time without a line before a program ends
    static constexpr std::chrono::milliseconds kLongIdle{250};  // after this time without a line, no more are likely;
    static constexpr double kNearEnd_s = 1;                     // then a program ends when less motion is left

private:
    bool has_lines() const { return next_ || queue_.size() > 0; }
    void accept(std::chrono::nanoseconds now);
    void append_later();
    void pass_program(const MachineState& state, std::chrono::nanoseconds now);
    bool must_end(const MachineState& state, std::chrono::nanoseconds now) const;
    void end_program(const Answer& answer);
    void lose(const MachineState& state, std::chrono::nanoseconds now);
    void drop();
    void close();

    MachineSetup machine_;
    MachinePort& port_;
    struct Next {
        std::uint64_t request = 0;
        LineToRun line;
    };
    LineQueue queue_;
    std::optional<Next> next_;  // waits for room in the queue
    /// A line that was accepted and is not in a program yet.
    struct Later {
        std::vector<double> from_mm;
        std::vector<Block> blocks;
        std::int32_t number = 0;
        bool probes = false;  // it ends the program
    };
    std::deque<Later> later_;
    std::unique_ptr<LineProgram> program_;
    std::int32_t last_ = 0;                // the last line of the program
    std::chrono::nanoseconds appended_{};  // when the last line was appended
    LineHold hold_;
    LineStop stop_;
    std::vector<Answered> answers_;
    std::optional<std::string> loss_;
};

}  // namespace lockstep::grbl
