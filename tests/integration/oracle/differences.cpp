#include "tests/integration/oracle/differences.hpp"

#include <array>
#include <regex>
#include <string_view>

#include "tests/integration/oracle/gouge.hpp"

namespace lockstep::oracle {
namespace {

bool matches(const std::string& text, const char* pattern) { return std::regex_search(text, std::regex(pattern)); }

struct Refusal {
    const std::string& text;  // of the program
    const Reading& theirs;
    const Reading& ours;
    std::string line;  // that is refused
};

struct Difference {
    const char* reason;
    bool (*holds)(const Refusal& refusal);
};

/// rs274 takes the program.
constexpr std::array kRefusedByUs{
    Difference{"the tool would cut into the path, or run backward; rs274's tool does",
               [](const Refusal& r) {
                   return r.ours.message.find("without cutting into the path") != std::string::npos &&
                          strays_from_path(r.text, r.theirs, r.ours);
               }},
    Difference{"a spline is not compensated: rs274 puts the points of G5.2 on the programmed path",
               [](const Refusal& r) { return r.ours.message.starts_with("G5.2 while cutter compensation is on"); }},
    Difference{
        "offsets that change with compensation on would move the path: rs274 takes G92.1 to G92.3",
        [](const Refusal& r) { return matches(r.ours.message, "^G92\\.[123] while cutter compensation is on"); }},
    Difference{"a block has one non-modal word: rs274 takes G10 or G53 beside G92.1 to G92.3",
               [](const Refusal& r) {
                   return r.ours.message.find("one non-modal word") != std::string::npos &&
                          matches(r.line, "[Gg]92\\.[123]") && matches(r.line, "[Gg]10|[Gg]53");
               }},
    Difference{"NURBS are in the plane of X and Y: rs274 takes them as X and Y whichever plane holds",
               [](const Refusal& r) { return r.ours.message.starts_with("G5.2 is in the plane of X and Y"); }},
    Difference{"a word stands once: rs274 takes a word of -1 for a missing one",
               [](const Refusal& r) { return matches(r.ours.message, "repeats [A-Z]-1;"); }},
};

/// We take the program.
constexpr std::array kRefusedByThem{
    Difference{"#5420 is the place of the tool's centre: rs274 gives it in messages alone",
               [](const Refusal& r) {
                   return r.theirs.message == "Cannot read current position with cutter radius compensation on" &&
                          matches(r.theirs.refused, "#542[0-8]|#<_[xyzabcuvw]>");
               }},
};

template <typename Differences>
bool any(const Differences& differences, const Refusal& refusal) {
    for (const Difference& difference : differences) {
        if (difference.holds(refusal)) { return true; }
    }
    return false;
}

}  // namespace

std::string line_of(const std::string& text, int number) {
    std::size_t begin = 0;
    for (int i = 1; i < number; ++i) { begin = text.find('\n', begin) + 1; }
    return text.substr(begin, text.find('\n', begin) - begin);
}

bool may_refuse_alone(const std::string& text, const Reading& theirs, const Reading& ours) {
    const Refusal refusal{text, theirs, ours, line_of(text, ours.line)};
    return theirs.taken ? any(kRefusedByUs, refusal) : any(kRefusedByThem, refusal);
}

/// rs274 alone has no tool changer: behind M6 or M61 it takes the axes to stand where the new offset puts them, and
/// G43 without H takes a tool that G10 has set for the one in the spindle.
bool may_move_apart(const std::string& text) {
    const bool changes_beside_offset = matches(text, "G4[39][^\\n]*M6|M6[^\\n]*G4[39]");
    const bool has_empty_spindle = !matches(text, "T2 M6");
    return changes_beside_offset || (has_empty_spindle && matches(text, "G10 L1[01]? [^]*G43( [^H]|\\n)"));
}

}  // namespace lockstep::oracle
