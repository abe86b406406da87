#include "clients/grbl/protocol/sender_output.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lockstep::grbl {

void SenderOutput::say_message(const std::string& text) {
    std::string line = "[MSG:" + text + "]";
    std::ranges::replace_if(
        line, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    say(line);
}

void SenderOutput::refuse(Error error, const std::string& text) {
    if (!text.empty()) { say_message(text); }
    say(fmt::format("error:{}", static_cast<int>(error)));
}

}  // namespace lockstep::grbl
