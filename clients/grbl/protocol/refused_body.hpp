// The lines of a loop, branches or a subroutine after its first line was refused. A sender may have sent them already,
// so they are refused too: run once and unconditionally, they would move the machine to another place.
#pragma once

#include <optional>
#include <string_view>

#include "core/gcode/flow/o_word.hpp"

namespace lockstep::grbl {

class RefusedBody {
public:
    /// Call with each line. Returns the O-word of the body that the line belongs to; nullopt if the line may be read.
    /// An O-word that opens a body may be read, which refuses it.
    std::optional<gcode::OWord> take(std::string_view line) {
        const auto word = gcode::find_o_word(line);
        if (!open_) {
            if (word && (gcode::opens(word->keyword) || word->keyword == gcode::Keyword::Sub)) { open_ = word; }
            return std::nullopt;
        }
        const auto body = open_;
        if (word && gcode::same_label(*word, *body) && word->keyword == gcode::end_of(body->keyword)) { open_.reset(); }
        return body;
    }
    void clear() { open_.reset(); }

private:
    std::optional<gcode::OWord> open_;
};

}  // namespace lockstep::grbl
