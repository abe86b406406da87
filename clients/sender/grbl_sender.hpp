// Sends lines to a controller of grbl's protocol. It is a state machine: inputs are the controller's bytes and the
// time, outputs are bytes for the controller. It does no I/O and reads no clock.
//
// It asks the controller for the size of its buffer. If the controller refuses a line, the sender stops the machine,
// because later lines assume another place. A stop is a hold, followed at rest by a reset, which drops the controller's
// lines.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clients/sender/line_flow.hpp"

namespace lockstep::sender {

enum class Outcome : std::uint8_t { Goes, Done, Stopped, Failed, Silent };

/// Why not all lines were run.
struct Trouble {
    std::optional<std::int64_t> line;  // of the file; nullopt: no line in particular
    std::optional<int> error;          // the controller's number
    std::optional<int> alarm;
    std::string text;  // with the remedy
};

class GrblSender {
public:
    using Time = std::chrono::nanoseconds;
    GrblSender(bool one_by_one, Time now) : flow_(one_by_one), since_(now), received_(now) {}

    bool wants_line() const { return phase_ == Phase::Streaming && flow_.wants_line(); }
    /// `text` comes from line_to_send() and is not empty.
    void add(std::int64_t number, std::string text) { flow_.add({number, std::move(text)}); }
    void end() { flow_.end(); }

    void receive(std::string_view bytes, Time now);
    /// Call it in each loop.
    void pass(Time now);
    std::string take_output() { return std::exchange(output_, {}); }

    /// Brings the machine to rest and makes the controller drop its lines.
    void stop(Time now);
    /// Stops in the same way, because of `trouble` such as a line that cannot be read.
    void stop(Trouble trouble, Time now);
    /// Continues after a hold or a pause (M0).
    void resume() { output_ += '~'; }
    /// The connection is lost.
    void lose(const std::string& why);

    Outcome outcome() const { return outcome_; }
    const std::optional<Trouble>& trouble() const { return trouble_; }
    std::int64_t answered() const { return flow_.answered(); }
    std::size_t room() const { return flow_.room(); }
    /// The newest status report, such as "Run|MPos:1.000,2.000,3.000"; empty if none came.
    const std::string& status() const { return status_; }
    /// The texts of [MSG:] lines since the last call.
    std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

    static constexpr std::chrono::milliseconds kGreetingPatience{2000};  // for controllers that do not greet
    static constexpr std::chrono::seconds kPatience{10};
    static constexpr std::chrono::minutes kHomingPatience{10};  // many do not answer while they home
    static constexpr std::chrono::milliseconds kStatusEvery{200};
    static constexpr std::chrono::seconds kStopPatience{5};

private:
    enum class Phase : std::uint8_t { Greeting, Asking, Streaming, Finishing, Holding, Resetting, Over };

    void enter(Phase phase, Time now);
    void end_as(Outcome outcome);
    void ask(Time now);
    void do_line(const std::string& line, Time now);
    void do_greeting(Time now);
    void do_ok(Time now);
    void do_error(const std::string& line, Time now);
    void do_alarm(const std::string& line);
    void do_status(const std::string& line, Time now);
    void read_options(const std::string& line);
    void pass_streaming(Time now);
    void pass_status(Time now);
    bool is_silent(Time now) const;
    bool is_moving() const;

    LineFlow flow_;
    Phase phase_ = Phase::Greeting;
    Time since_;     // when the phase began
    Time received_;  // when bytes last came
    Time asked_{};   // when a status was last requested
    int rests_ = 0;  // consecutive status reports at rest
    std::string line_;
    std::string output_;
    std::string status_;
    std::string message_;  // the newest [MSG:] text
    std::vector<std::string> messages_;
    std::optional<Trouble> trouble_;
    Outcome outcome_ = Outcome::Goes;
};

}  // namespace lockstep::sender
