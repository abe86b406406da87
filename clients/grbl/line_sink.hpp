// Where lines of G-code go that move axes.
#pragma once

#include <string>

#include "clients/grbl/protocol/request.hpp"

namespace lockstep::grbl {

class LineSink {
public:
    virtual ~LineSink() = default;
    /// Takes the line, or refuses it.
    virtual Answer take(const std::string& line) = 0;
};

/// Refuses all of them.
class NoLines : public LineSink {
public:
    Answer take(const std::string&) override {
        return {.text = "lines that move are not taken one by one; jog with $J=, or run a file: lockstep run FILE"};
    }
};

}  // namespace lockstep::grbl
