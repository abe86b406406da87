// How a verb speaks: text for a person, or one JSON report on standard output for a script. Warnings go to standard
// error either way, so that standard output holds the report alone.
#pragma once

#include <google/protobuf/message.h>

#include <string>

#include "clients/text/failure.hpp"

namespace lockstep {

class Voice {
public:
    explicit Voice(bool json);

    bool json() const { return json_; }
    bool is_terminal() const { return is_terminal_; }
    /// A line that passes: redrawn in place on a terminal, printed once every few seconds elsewhere. Not with JSON.
    void progress(const std::string& line);
    /// A line that stays. Not with JSON.
    void say(const std::string& line);
    void warn(const std::string& line);
    /// The JSON report; nothing in text, where the verb says its own.
    void report(const google::protobuf::Message& message);
    /// Says it in either form; returns its exit code.
    ExitCode fail(const Failure& failure);

private:
    void clear_progress();

    bool json_;
    bool is_terminal_;
    bool progress_shown_ = false;
    double progress_time_s_;  // of the last line; at first, of the start
};

}  // namespace lockstep
