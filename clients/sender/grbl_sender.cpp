#include "clients/sender/grbl_sender.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "clients/grbl/protocol/code_table.hpp"

namespace lockstep::sender {
namespace {

constexpr std::size_t kMostLine = 1024;  // of a controller's answers
constexpr std::size_t kLeastRoom = 32;   // a smaller number cannot be a buffer's size

int number_in(std::string_view text) {
    int number = 0;
    (void)std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

/// "error:20 Unsupported command. The line has ... (what the controller said)".
std::string text_of(const std::string& answer, std::span<const grbl::Code> codes, int number,
                    const std::string& message) {
    std::string text = answer;
    if (const grbl::Code* code = grbl::find_code(codes, number)) {
        text += " " + std::string(code->name) + ". " + std::string(code->text);
    }
    return text + (message.empty() ? "" : " The controller: " + message);
}

std::optional<std::int64_t> number_of(const Line* line) {
    return line == nullptr ? std::nullopt : std::optional(line->number);
}

std::string remedy_of(int error) {
    constexpr int kLocked = 9;
    return error == kLocked ? " Home ($H) or unlock ($X) the machine first." : "";
}

}  // namespace

void GrblSender::receive(std::string_view bytes, Time now) {
    if (!bytes.empty()) { received_ = now; }
    for (const char c : bytes) {
        if (c == '\n') {
            do_line(std::exchange(line_, {}), now);
        } else if (c != '\r' && line_.size() < kMostLine) {
            line_ += c;
        }
    }
}

void GrblSender::do_line(const std::string& line, Time now) {
    if (line.starts_with("Grbl")) { return do_greeting(now); }
    if (line == "ok") { return do_ok(now); }
    if (line.starts_with("error:")) { return do_error(line, now); }
    if (line.starts_with("ALARM:")) { return do_alarm(line); }
    if (line.starts_with("<")) { return do_status(line, now); }
    if (line.starts_with("[OPT:")) { return read_options(line); }
    if (line.starts_with("[MSG:") && line.ends_with("]")) {
        message_ = line.substr(5, line.size() - 6);
        messages_.push_back(message_);
    }
}

/// Many controllers reset themselves when their port is opened.
void GrblSender::do_greeting(Time now) {
    if (phase_ == Phase::Greeting || phase_ == Phase::Asking) { return ask(now); }
    if (phase_ == Phase::Resetting) { return end_as(trouble_ ? Outcome::Failed : Outcome::Stopped); }
    if (phase_ == Phase::Over) { return; }
    lose("the controller was reset");
}

void GrblSender::ask(Time now) {
    output_ += "$I\n";
    enter(Phase::Asking, now);
}

/// "[OPT:VNM,35,1024]": the last number is the size of the receive buffer; grbl cannot use one byte of it.
void GrblSender::read_options(const std::string& line) {
    const std::size_t comma = line.find(',', std::min(line.find(',') + 1, line.size()));
    if (comma == std::string::npos) { return; }
    const int bytes = number_in(std::string_view(line).substr(comma + 1));
    if (bytes > static_cast<int>(kLeastRoom)) { flow_.set_room(static_cast<std::size_t>(bytes - 1)); }
}

void GrblSender::do_ok(Time now) {
    if (phase_ == Phase::Asking) {
        enter(Phase::Streaming, now);
    } else if (phase_ == Phase::Streaming) {
        (void)flow_.answer();
    }
    message_.clear();
}

void GrblSender::do_error(const std::string& line, Time now) {
    if (phase_ == Phase::Asking) { return enter(Phase::Streaming, now); }  // an old controller without $I
    const auto refused = phase_ == Phase::Streaming ? flow_.answer() : std::nullopt;
    if (!refused) { return; }
    const int number = number_in(std::string_view(line).substr(6));
    stop({.line = refused->number,
          .error = number,
          .text = refused->text + ": " + text_of(line, grbl::error_codes(), number, message_) + remedy_of(number)},
         now);
}

/// The controller has stopped the machine by itself.
void GrblSender::do_alarm(const std::string& line) {
    if (phase_ == Phase::Over || phase_ == Phase::Resetting) { return; }
    const int number = number_in(std::string_view(line).substr(6));
    if (!trouble_) {
        trouble_ = {.line = number_of(flow_.oldest()),
                    .alarm = number,
                    .text = text_of(line, grbl::alarm_codes(), number, message_)};
    }
    end_as(Outcome::Failed);
}

void GrblSender::do_status(const std::string& line, Time now) {
    status_ = line.substr(1, line.find('>') - 1);
    rests_ = is_moving() ? 0 : rests_ + 1;
    if (phase_ == Phase::Holding && rests_ > 0) {
        output_ += '\x18';
        enter(Phase::Resetting, now);
    }
    // Waits for a second report: the first may have been sent before the machine began to move.
    if (phase_ == Phase::Finishing && rests_ > 1 && (status_.starts_with("Idle") || status_.starts_with("Check"))) {
        end_as(Outcome::Done);
    }
}

bool GrblSender::is_moving() const {
    return std::ranges::any_of(std::initializer_list<std::string_view>{"Run", "Jog", "Home", "Hold:1", "Door:2"},
                               [&](std::string_view state) { return status_.starts_with(state); });
}

void GrblSender::pass(Time now) {
    const Time waited = now - since_;
    switch (phase_) {
        case Phase::Greeting:
            if (waited > kGreetingPatience) { ask(now); }
            return;
        case Phase::Asking:
            if (waited > kPatience) {
                lose("no controller with grbl's protocol answers; check the port and the speed");
            }
            return;
        case Phase::Streaming: return pass_streaming(now);
        case Phase::Finishing: return pass_status(now);
        case Phase::Holding:
            pass_status(now);
            if (waited > kStopPatience) {
                output_ += '\x18';
                enter(Phase::Resetting, now);
            }
            return;
        case Phase::Resetting:
            if (waited > kStopPatience) { end_as(trouble_ ? Outcome::Failed : Outcome::Stopped); }
            return;
        case Phase::Over: return;
    }
}

void GrblSender::pass_streaming(Time now) {
    output_ += flow_.take();
    if (const Line* line = flow_.too_long(); line != nullptr && flow_.oldest() == nullptr) {
        return stop({.line = line->number,
                     .text = fmt::format("the line has {} bytes, more than the controller's buffer takes; shorten it",
                                         line->text.size())},
                    now);
    }
    if (flow_.is_done()) { return enter(Phase::Finishing, now); }
    pass_status(now);
}

void GrblSender::pass_status(Time now) {
    if (is_silent(now)) { return lose("the controller does not answer any more"); }
    if (now - asked_ < kStatusEvery) { return; }
    asked_ = now;
    output_ += '?';
}

bool GrblSender::is_silent(Time now) const {
    const bool is_homing = flow_.oldest() != nullptr && flow_.oldest()->text.starts_with("$H");
    return now - received_ > (is_homing ? Time(kHomingPatience) : Time(kPatience));
}

void GrblSender::stop(Time now) {
    if (phase_ == Phase::Holding || phase_ == Phase::Resetting || phase_ == Phase::Over) { return; }
    if (phase_ == Phase::Greeting || phase_ == Phase::Asking) {
        return end_as(trouble_ ? Outcome::Failed : Outcome::Stopped);
    }
    output_ += "!?";
    asked_ = now;
    enter(Phase::Holding, now);
}

void GrblSender::stop(Trouble trouble, Time now) {
    if (!trouble_) { trouble_ = std::move(trouble); }
    stop(now);
}

void GrblSender::lose(const std::string& why) {
    if (phase_ == Phase::Over) { return; }
    const bool has_begun = phase_ != Phase::Greeting && phase_ != Phase::Asking;
    if (!trouble_) { trouble_ = {.line = number_of(flow_.oldest()), .text = why}; }
    end_as(has_begun ? Outcome::Failed : Outcome::Silent);
}

void GrblSender::enter(Phase phase, Time now) {
    phase_ = phase;
    since_ = now;
    rests_ = 0;
}

void GrblSender::end_as(Outcome outcome) {
    phase_ = Phase::Over;
    outcome_ = outcome;
}

}  // namespace lockstep::sender
