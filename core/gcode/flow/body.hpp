// The lines of a loop, a branch or a subroutine, stored until its end has been read.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/gcode/flow/o_word.hpp"

namespace lockstep::gcode {

struct KeptLine {
    int number = 0;  // in its text
    std::string text;
    Keyword keyword = Keyword::None;
    // Lines of the body, by index:
    std::size_t begin = 0;   // first line of the loop; set at its end, break and continue
    std::size_t branch = 0;  // the next elseif, else or endif; set at if and elseif
    std::size_t end = 0;     // the last line of the loop, the branches or the subroutine
};

struct Body {
    std::string label;  // of a subroutine
    std::string file;   // of the subroutine, if it is in a file
    std::vector<KeptLine> lines;
};

/// Stores lines from an opening O-word to the one that closes it.
class Recorder {
public:
    bool active() const { return !open_.empty(); }
    /// Takes the first line of a body, or one within it. Returns an error if the O-word does not fit the open ones.
    std::optional<GcodeError> take(const Line& line, const OWord& word, std::string_view text);
    /// Returns the finished body and empties the recorder.
    Body take_body() { return std::exchange(body_, {}); }
    bool is_subroutine() const { return !body_.lines.empty() && body_.lines.front().keyword == Keyword::Sub; }
    std::size_t lines() const { return body_.lines.size(); }
    /// The first O-word that is open; nullopt if none is.
    std::optional<std::string> open_word() const;
    /// Returns an error if a body is open at the text's end.
    std::optional<GcodeError> unclosed() const;
    void clear();

private:
    struct Open {
        OWord word;
        std::size_t line;
        std::vector<std::size_t> branches;  // lines that wait for the next branch
        std::vector<std::size_t> exits;     // lines that wait for the end
        bool has_else = false;
    };

    std::optional<std::string> open(const OWord& word);
    std::optional<std::string> open_subroutine(const OWord& word);
    std::optional<std::string> branch(const OWord& word);
    std::optional<std::string> close(const OWord& word);
    std::optional<std::string> leave(const OWord& word);
    std::optional<std::string> place(const OWord& word);
    std::string not_open(const OWord& word) const;

    Body body_;
    std::vector<Open> open_;
    std::set<std::string, std::less<>> subroutines_;  // the labels of all subroutines that were begun so far
};

}  // namespace lockstep::gcode
