#include "tests/integration/oracle/differences.hpp"

#include <algorithm>
#include <array>
#include <regex>

#include "tests/integration/oracle/gouge.hpp"

namespace lockstep::oracle {
namespace {

bool matches(const std::string& text, const char* pattern) { return std::regex_search(text, std::regex(pattern)); }

/// The number of the first line with this text; 0 if there is none.
int number_of(const std::string& text, const std::string& line) {
    const std::size_t at = text.find(line);
    return at == std::string::npos
               ? 0
               : 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

struct Refusal {
    const std::string& text;  // of the program
    const Reading& theirs;
    const Reading& ours;
    std::string line;  // that is refused
};

struct KnownDifference {
    const char* reason;
    bool (*holds)(const Refusal& refusal);
};

/// rs274 accepts the program, and we refuse it.
constexpr std::array kRefusedByUs{
    KnownDifference{"the tool would cut into the path, or run backward; rs274's tool does",
                    [](const Refusal& r) {
                        return r.ours.message.find("without cutting into the path") != std::string::npos &&
                               strays_from_path(r.text, r.theirs, r.ours);
                    }},
    KnownDifference{"a spline is not compensated: rs274 puts the points of G5.2 on the programmed path",
                    [](const Refusal& r) {
                        return r.ours.message.starts_with("G5.2 is not possible while cutter compensation is on");
                    }},
    KnownDifference{"offsets that change with compensation on would move the path: rs274 takes G92.1 to G92.3",
                    [](const Refusal& r) {
                        return matches(r.ours.message, "^G92\\.[123] is not possible while cutter compensation is on");
                    }},
    KnownDifference{
        "the programmed place is not the tool's: rs274 takes G10 L20 with compensation on, at the tool's centre",
        [](const Refusal& r) { return r.ours.message.starts_with("G10 L20 sets a zero from the axes' positions"); }},
    KnownDifference{"a block has one non-modal word: rs274 takes another one beside G92.1 to G92.3",
                    [](const Refusal& r) {
                        return r.ours.message.find("one non-modal word") != std::string::npos &&
                               matches(r.line, "[Gg]92\\.[123]");
                    }},
    KnownDifference{"a spline keeps the time of G93: rs274 makes it at the feed of the motion before",
                    [](const Refusal& r) { return r.ours.message.starts_with("G5.2 needs F in inverse time (G93)"); }},
    KnownDifference{"NURBS are in the plane of X and Y: rs274 takes them as X and Y whichever plane holds",
                    [](const Refusal& r) { return r.ours.message.starts_with("G5.2 is in the plane of X and Y"); }},
    KnownDifference{"a word stands once: rs274 takes a word of -1 for a missing one",
                    [](const Refusal& r) { return matches(r.ours.message, "repeats [A-Z]-1;"); }},
};

/// We accept the program, and rs274 refuses it.
constexpr std::array kRefusedByThem{
    KnownDifference{"#5420 is the place of the tool's centre: rs274 gives it in messages alone",
                    [](const Refusal& r) {
                        return r.theirs.message == "Cannot read current position with cutter radius compensation on" &&
                               matches(r.theirs.refused, "#542[0-8]|#<_[xyzabcuvw]>");
                    }},
    KnownDifference{"where a path turns back from arc to arc, their curvature decides whether the corner is inside",
                    [](const Refusal& r) {
                        return r.theirs.message.find("a corner the compensated tool can't fit in") !=
                                   std::string::npos &&
                               turns_back_at(r.text, number_of(r.text, r.theirs.refused));
                    }},
    KnownDifference{
        "a corner below 0.05 radians counts as none: rs274 then refuses an arc that it has made longer at it",
        [](const Refusal& r) {
            return r.theirs.message == "Arc move in concave corner cannot be reached by the tool without gouging" &&
                   follows_almost_straight_arc(r.text, number_of(r.text, r.theirs.refused));
        }},
    KnownDifference{"G98 and G99 change nothing of a path: rs274 refuses them with compensation on",
                    [](const Refusal& r) {
                        return r.theirs.message == "Cannot change retract mode with cutter radius compensation on";
                    }},
};

struct Parting {
    const std::string& text;  // of the program
    const std::vector<Call>& theirs;
    const std::vector<Call>& ours;
    std::size_t index;  // of the first call that differs
};

struct MotionDifference {
    const char* reason;
    bool (*holds)(const Parting& parting);
};

/// Both accept the program, and move differently.
constexpr std::array kMovesApart{
    MotionDifference{
        "rs274 alone has no tool changer: behind M6 and M61 it takes the axes to stand where the new offset "
        "puts them",
        [](const Parting& p) { return matches(p.text, "G4[39][^\\n]*M6|M6[^\\n]*G4[39]"); }},
    MotionDifference{"rs274 alone has no tool changer: G43 without H takes a tool that G10 has set for the one in the "
                     "spindle",
                     [](const Parting& p) {
                         return !matches(p.text, "T2 M6") && matches(p.text, "G10 L1[01]? [^]*G43( [^H]|\\n)");
                     }},
    MotionDifference{"where a path turns back from arc to arc, their curvature decides whether the corner is inside: "
                     "rs274 may take it for an outside one and cut into the path",
                     [](const Parting& p) { return turns_back_at(p.text, p.ours[p.index].line); }},
};

template <typename Differences>
bool any(const Differences& differences, const Refusal& refusal) {
    for (const KnownDifference& difference : differences) {
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

bool may_move_apart(const std::string& text, const std::vector<Call>& theirs, const std::vector<Call>& ours,
                    std::size_t index) {
    const Parting parting{text, theirs, ours, index};
    return std::ranges::any_of(kMovesApart, [&](const auto& difference) { return difference.holds(parting); });
}

}  // namespace lockstep::oracle
