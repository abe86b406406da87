// The output of a verb: text for a person, or one JSON report on standard output for a script. Warnings always go to
// standard error, so that standard output holds only the report.
#pragma once

#include <google/protobuf/message.h>

#include <functional>
#include <string>
#include <vector>

#include "clients/text/failure.hpp"

namespace lockstep {

class Output {
public:
    explicit Output(bool json);

    bool json() const { return json_; }
    bool is_terminal() const { return is_terminal_; }
    /// A progress line: redrawn in place on a terminal, printed once every few seconds elsewhere. Not with JSON.
    void progress(const std::string& line);
    /// Returns a function that shows "verifying 12 %" on a terminal; empty elsewhere. `doing` is the first word.
    std::function<void(double)> percent_on_terminal(const std::string& doing);
    /// A permanent line. Not with JSON.
    void print(const std::string& line);
    void warn(const std::string& line);
    /// Prints the JSON report. Does nothing in text mode, where the verb prints its own text.
    void report(const google::protobuf::Message& message);
    /// The same with warnings, in either form: the JSON report lists them in `warnings`.
    void report(const google::protobuf::Message& message, const std::vector<std::string>& warnings);
    /// Reports the failure in either form; returns its exit code.
    ExitCode fail(const Failure& failure);

private:
    void clear_progress();

    bool json_;
    bool is_terminal_;
    bool progress_shown_ = false;
    double progress_time_s_;  // time of the last line; at first, of the start
};

}  // namespace lockstep
