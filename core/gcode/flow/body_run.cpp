#include "core/gcode/flow/body_run.hpp"

#include <cmath>
#include <utility>

namespace lockstep::gcode {

Result BodyRun::follow(Reader& reader) {
    const KeptLine& line = body_->lines[at_];
    switch (line.keyword) {
        case Keyword::If:
        case Keyword::While: return begin_branch(reader);
        case Keyword::ElseIf:
            if (is_choosing_) { return choose_branch(reader); }
            next_ = line.end + 1;
            return {};
        case Keyword::Else:
            if (!std::exchange(is_choosing_, false)) { next_ = line.end + 1; }
            return {};
        case Keyword::EndIf: is_choosing_ = false; return nothing_follows(reader);
        case Keyword::Repeat: return begin_repeat(reader);
        case Keyword::EndWhile:
        case Keyword::EndRepeat: return end_loop(reader);
        case Keyword::Break: next_ = line.end + 1; return nothing_follows(reader);
        case Keyword::Continue:
            next_ = body_->lines[line.begin].keyword == Keyword::While ? line.begin : line.end;
            return nothing_follows(reader);
        default: return nothing_follows(reader);
    }
}

Result BodyRun::begin_branch(Reader& reader) {
    const KeptLine& line = body_->lines[at_];
    const bool holds = reader.expression() != 0;
    if (holds) { return nothing_follows(reader); }
    is_choosing_ = line.keyword == Keyword::If;
    next_ = is_choosing_ ? line.branch : line.end + 1;
    return nothing_follows(reader);
}

/// Called at an elseif if no branch before it has held.
Result BodyRun::choose_branch(Reader& reader) {
    is_choosing_ = reader.expression() == 0;
    if (is_choosing_) { next_ = body_->lines[at_].branch; }
    return nothing_follows(reader);
}

Result BodyRun::begin_repeat(Reader& reader) {
    const double count = std::ceil(reader.expression());
    repeats_[at_] = count;
    if (count < 1) { next_ = body_->lines[at_].end + 1; }
    return nothing_follows(reader);
}

Result BodyRun::end_loop(Reader& reader) {
    const std::size_t begin = body_->lines[at_].begin;
    bool again = true;
    switch (body_->lines[begin].keyword) {
        case Keyword::While: next_ = begin; return nothing_follows(reader);
        case Keyword::Do: again = reader.expression() != 0; break;
        default: again = --repeats_[begin] >= 1; break;
    }
    if (again) { next_ = begin + 1; }
    return nothing_follows(reader);
}

}  // namespace lockstep::gcode
