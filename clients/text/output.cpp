#include "clients/text/output.hpp"

#include <unistd.h>

#include <iostream>

#include "clients/text/format.hpp"
#include "idl/proto/report.pb.h"
#include "services/documents/report_json.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

constexpr double kRedrawPeriod_s = 0.1;  // on a terminal
constexpr double kProgressPeriod_s = 5;  // where there is no terminal

double now_s() { return static_cast<double>(monotonic_now().count()) * 1e-9; }

proto::ErrorReport error_report(const Failure& failure) {
    proto::ErrorReport report;
    for (const Diagnostic& error : failure.errors) {
        proto::ErrorMessage& message = *report.add_errors();
        message.set_message(error.message);
        if (!failure.file.empty()) { message.set_file(failure.file); }
        if (error.line > 0) { message.set_line(error.line); }
        if (error.line > 0) { message.set_column(error.column); }
    }
    return report;
}

}  // namespace

Output::Output(bool json) : json_(json), is_terminal_(isatty(STDOUT_FILENO) == 1), progress_time_s_(now_s()) {}

void Output::clear_progress() {
    if (progress_shown_) { std::cout << "\r\x1b[K"; }
    progress_shown_ = false;
}

void Output::progress(const std::string& line) {
    if (json_ || now_s() - progress_time_s_ < (is_terminal_ ? kRedrawPeriod_s : kProgressPeriod_s)) { return; }
    progress_time_s_ = now_s();
    clear_progress();
    std::cout << line;
    progress_shown_ = is_terminal_;
    if (!is_terminal_) { std::cout << '\n'; }
    std::cout << std::flush;
}

std::function<void(double)> Output::percent_on_terminal(const std::string& doing) {
    if (!is_terminal_) { return {}; }
    return [this, doing](double done) { progress(doing + " " + fixed(done * 100, 0) + " %"); };
}

void Output::print(const std::string& line) {
    if (json_) { return; }
    clear_progress();
    std::cout << line << '\n' << std::flush;
}

void Output::warn(const std::string& line) {
    clear_progress();
    std::cout << std::flush;
    std::cerr << "lockstep: " << line << '\n' << std::flush;
}

void Output::report(const google::protobuf::Message& message) {
    if (json_) { std::cout << report_json(message) << std::flush; }
}

void Output::report(const google::protobuf::Message& message, const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) { warn("warning: " + warning); }
    if (json_) { std::cout << report_json(message, warnings) << std::flush; }
}

ExitCode Output::fail(const Failure& failure) {
    clear_progress();
    if (json_) {
        report(error_report(failure));
    } else if (failure.file.empty()) {
        for (const Diagnostic& error : failure.errors) { warn(error.message); }
    } else {
        std::cerr << to_text(failure.file, failure.errors) << std::flush;
    }
    return failure.exit;
}

}  // namespace lockstep
