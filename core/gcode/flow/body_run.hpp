// The run of one stored body: its next line, its branches and its loops.
#pragma once

#include <cstddef>
#include <map>

#include "core/gcode/flow/body.hpp"

namespace lockstep::gcode {

class BodyRun {
public:
    /// The body must outlive the run.
    explicit BodyRun(const Body& body, std::size_t first_line) : body_(&body), next_(first_line) {}

    const Body& body() const { return *body_; }
    bool is_done() const { return next_ >= body_->lines.size(); }
    /// Returns the line to run now, and goes to the line behind it.
    const KeptLine& take_line() { return body_->lines[at_ = next_++]; }
    /// Goes on as the O-word of the line taken last says. `reader` is behind its keyword.
    Result follow(Reader& reader);
    /// Goes to the end.
    void leave() { next_ = body_->lines.size(); }

private:
    Result begin_branch(Reader& reader);
    Result choose_branch(Reader& reader);
    Result begin_repeat(Reader& reader);
    Result end_loop(Reader& reader);

    const Body* body_;
    std::size_t at_ = 0;  // the line taken last
    std::size_t next_;
    bool is_choosing_ = false;               // no branch of the present if has held so far
    std::map<std::size_t, double> repeats_;  // remaining ones, by the loop's first line
};

}  // namespace lockstep::gcode
