// The lines that go to a sender.
#pragma once

#include <string>
#include <utility>

#include "clients/grbl/protocol/errors.hpp"

namespace lockstep::grbl {

class SenderOutput {
public:
    void say(const std::string& line) { text_ += line + "\r\n"; }
    /// Replaces line ends, because a message is one line.
    void say_message(const std::string& text);
    void ok() { say("ok"); }
    void refuse(Error error, const std::string& text = {});
    /// The lines since the last call.
    std::string take() { return std::exchange(text_, {}); }

private:
    std::string text_;
};

}  // namespace lockstep::grbl
