// lockstep send
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <memory>

#include "clients/channel/open_port.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/send/file_lines.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/sender/grbl_sender.hpp"
#include "clients/text/format.hpp"
#include "clients/text/output.hpp"
#include "core/if_positive.hpp"
#include "idl/proto/report.pb.h"
#include "services/runtime/clock.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

struct SendOptions {
    std::string file;
    std::string port;
    int baud = 115200;
    bool one_by_one = false;
    bool json = false;
};

class Sending {
public:
    Sending(const SendOptions& options, const Descriptor& port, FileLines& lines, Output& output)
        : port_(port), lines_(lines), output_(output), sender_(options.one_by_one, monotonic_now()) {
        has_keys_ = options.file != "-" && isatty(STDIN_FILENO) != 0;
    }

    /// Returns when all lines were run, or when sending ended early.
    void run() {
        const StopSignal stop;
        while (sender_.outcome() == sender::Outcome::Goes) {
            if (stop.requested()) { sender_.stop(monotonic_now()); }
            feed();
            const auto bytes = read_from(port_, 5ms);
            sender_.receive(bytes.value_or(""), monotonic_now());
            sender_.pass(monotonic_now());
            if (!bytes || !write_to(port_, sender_.take_output())) {
                sender_.lose("the connection to the controller is closed");
            }
            show();
        }
    }
    const sender::GrblSender& sender() const { return sender_; }

private:
    void feed() {
        while (sender_.wants_line()) {
            auto line = lines_.next();
            if (!line) {
                sender_.end();
                return sender_.stop({.line = if_positive(line.error().line), .text = line.error().message},
                                    monotonic_now());
            }
            if (*line) { sender_.add((*line)->number, std::move((*line)->text)); }
            if (lines_.is_at_end()) { return sender_.end(); }
            if (!*line) { return; }
        }
    }
    bool is_held() const { return sender_.status().starts_with("Hold") || sender_.status().starts_with("Door"); }
    void show() {
        for (const std::string& message : sender_.take_messages()) { output_.print("the controller: " + message); }
        if (sender_.status().empty()) { return; }
        const bool may_resume = has_keys_ && is_held();
        const double share = lines_.share_read();
        output_.progress(fmt::format("{} lines accepted, {}{}{}", sender_.answered(),
                                     share > 0 ? fixed(share * 100, 0) + " % read, " : "", sender_.status(),
                                     may_resume ? ": Enter resumes" : ""));
        char key = 0;
        if (may_resume && wait_for(STDIN_FILENO, POLLIN, 0) != 0 && read(STDIN_FILENO, &key, 1) == 1 && key == '\n') {
            sender_.resume();
        }
    }

    const Descriptor& port_;
    FileLines& lines_;
    Output& output_;
    sender::GrblSender sender_;
    bool has_keys_ = false;
};

proto::SendReport report_of(const SendOptions& options, const sender::GrblSender& sender, double seconds) {
    proto::SendReport report;
    report.set_port(options.port);
    report.set_accepted_lines(sender.answered());
    report.set_seconds(seconds);
    report.set_buffer_bytes(static_cast<std::int32_t>(sender.room()));
    report.set_done(sender.outcome() == sender::Outcome::Done);
    report.set_stopped(sender.outcome() == sender::Outcome::Stopped);
    if (const auto& trouble = sender.trouble()) {
        if (trouble->line) { report.set_line(*trouble->line); }
        if (trouble->error) { report.set_error(*trouble->error); }
        if (trouble->alarm) { report.set_alarm(*trouble->alarm); }
        report.set_text(trouble->text);
    }
    return report;
}

ExitCode finish(const SendOptions& options, const sender::GrblSender& sender, double seconds, Output& output) {
    const proto::SendReport report = report_of(options, sender, seconds);
    const std::string lines = fmt::format("{} lines accepted", sender.answered());
    output.report(report);
    switch (sender.outcome()) {
        case sender::Outcome::Done: output.print(lines + " and run in " + fixed(seconds, 1) + " s"); return kExitDone;
        case sender::Outcome::Stopped: output.print("stopped: held, and reset at rest; " + lines); return kExitFailed;
        default: break;
    }
    const std::string place = report.has_line() ? fmt::format("{}:{}", options.file, report.line()) : options.file;
    output.warn(place + ": " + report.text() + " (" + lines + ")");
    return sender.outcome() == sender::Outcome::Silent ? kExitUnreachable : kExitFailed;
}

ExitCode send(const SendOptions& options) {
    Output output(options.json);
    if (options.file != "-") {
        if (const auto wrong = FileLines::check(options.file)) { return output.fail(bad_file(options.file, {*wrong})); }
    }
    auto lines = FileLines::open(options.file);
    if (!lines) { return output.fail(bad_file(options.file, {lines.error()})); }
    const auto port = open_port(options.port, options.baud);
    if (!port) { return output.fail(unreachable(port.error())); }
    std::signal(SIGPIPE, SIG_IGN);
    const auto begin = monotonic_now();
    Sending sending(options, *port, *lines, output);
    sending.run();
    return finish(options, sending.sender(), std::chrono::duration<double>(monotonic_now() - begin).count(), output);
}

}  // namespace

void add_send(Verb command) {
    const Verb verb = command.add_verb("send",
                                       "send a file to a controller with grbl's protocol\n"
                                       "The controller is lockstep-grbl, or any grbl 1.1 at a serial line.");
    const auto options = std::make_shared<SendOptions>();
    verb.add_option("file", options->file, "a file of G-code and $ commands; - for standard input").required();
    verb.add_option("--port", options->port, "the path of a serial line or pseudo-terminal, or HOST:PORT").required();
    verb.add_option("--baud", options->baud, "the speed of a serial line")
        .checked_by([](const std::string& text) {
            return is_baud(std::atoi(text.c_str()))
                       ? ""
                       : "it is not a usual speed of a serial line; use for example 115200";
        })
        .with_default();
    verb.add_flag("--lines", options->one_by_one,
                  "send each line after the answer to the line before; default: as many lines as fit into the "
                  "controller's buffer, whose size it reports");
    add_json(verb, options->json);
    verb.footer(
        "Comments are not sent. Of a file, every line is checked before the first is sent. A line that the controller\n"
        "refuses, and Ctrl-C, stop the machine: a hold, and at rest a reset. On a terminal, Enter resumes after M0.\n"
        "Examples:\n  lockstep send job.gcode --port 127.0.0.1:2301\n"
        "  lockstep send job.gcode --port /dev/ttyACM0 --lines --json\n"
        "Exit codes: 0 all lines were run, 1 a line was refused, an alarm, or stopped, 2 bad usage or input (nothing\n"
        "was sent), 3 the port cannot be opened, or no controller answers");
    verb.action([options] { return send(*options); });
}

}  // namespace lockstep
