#include "tests/integration/oracle/gouge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <regex>
#include <vector>

#include "tests/integration/oracle/differences.hpp"

namespace lockstep::oracle {
namespace {

using At = std::array<double, 3>;

constexpr double kSample_mm = 0.02;
constexpr double kDigits_mm = 0.01;      // of rs274's output, and of the samples
constexpr std::size_t kCallsAfter = 12;  // rs274's path is looked at so far behind the refused line

double distance(const At& a, const At& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

At place_of(const Call& call) { return {call.numbers[0], call.numbers[1], call.numbers[2]}; }

bool is_motion(const Call& call) { return call.name == "rapid" || call.name == "feed" || call.name == "arc"; }

void sample_straight(const At& from, const At& to, std::vector<At>& path) {
    const int count = 1 + static_cast<int>(distance(from, to) / kSample_mm);
    for (int i = 0; i <= count; ++i) {
        At at{};
        for (std::size_t k = 0; k < 3; ++k) { at[k] = from[k] + (to[k] - from[k]) * i / count; }
        path.push_back(at);
    }
}

/// About the axis that has no part in the centre's call.
struct SweptArc {
    SweptArc(const At& from, const Call& arc, const Call& call, std::array<std::size_t, 2> in)
        : centre(place_of(call)), axes(in), begin(angle(from)) {
        side = arc.numbers.back() > 0 ? 1 : -1;
        sweep = side * (angle(place_of(arc)) - begin);
        while (sweep <= 1e-7) { sweep += 2 * std::numbers::pi; }
        radius = std::hypot(from[axes[0]] - centre[axes[0]], from[axes[1]] - centre[axes[1]]);
    }
    double angle(const At& at) const {
        return std::atan2(at[axes[1]] - centre[axes[1]], at[axes[0]] - centre[axes[0]]);
    }

    At centre;
    std::array<std::size_t, 2> axes;
    double begin;
    double side = 1;
    double sweep = 0;
    double radius = 0;
};

void sample_arc(const At& from, const SweptArc& arc, std::vector<At>& path) {
    const int count = 1 + static_cast<int>(arc.sweep * arc.radius / kSample_mm);
    for (int i = 0; i <= count; ++i) {
        const double turned = arc.begin + arc.side * arc.sweep * i / count;
        At at = from;
        at[arc.axes[0]] = arc.centre[arc.axes[0]] + arc.radius * std::cos(turned);
        at[arc.axes[1]] = arc.centre[arc.axes[1]] + arc.radius * std::sin(turned);
        path.push_back(at);
    }
}

struct Path {
    std::vector<At> places;
    std::vector<At> ways;   // of the straight motions, of length 1
    double most_sweep = 0;  // of an arc
};

/// The motions from `begin` to `end`.
Path path_of(const std::vector<Call>& calls, std::size_t begin, std::size_t end, std::array<std::size_t, 2> axes) {
    Path path;
    At at{};
    for (std::size_t i = 0; i < end && i < calls.size(); ++i) {
        if (!is_motion(calls[i])) { continue; }
        const At to = place_of(calls[i]);
        const bool is_arc = calls[i].name == "arc" && i + 1 < calls.size() && calls[i + 1].name == "centre";
        if (i >= begin && is_arc) {
            const SweptArc arc(at, calls[i], calls[i + 1], axes);
            sample_arc(at, arc, path.places);
            path.most_sweep = std::max(path.most_sweep, arc.sweep);
        } else if (i >= begin) {
            sample_straight(at, to, path.places);
            const double length = std::hypot(to[axes[0]] - at[axes[0]], to[axes[1]] - at[axes[1]]);
            if (length > kDigits_mm) {
                path.ways.push_back({(to[axes[0]] - at[axes[0]]) / length, (to[axes[1]] - at[axes[1]]) / length, 0});
            }
        }
        at = to;
    }
    return path;
}

/// The text with the words that turn compensation on taken out, line by line.
std::string uncompensated(const std::string& text) {
    return std::regex_replace(text, std::regex("G4[12](\\.1)?|(^|[ \\n])[DL][-+]?[0-9.]+(?=[ \\n])"), " ");
}

struct Section {
    int first = 0;  // the line that turns compensation on
    int last = 0;   // the one that turns it off
    bool is_zx = false;
    bool is_entry = false;  // the refused line itself turns it on
};

Section section_about(const std::string& text, int line) {
    Section section;
    const int lines = static_cast<int>(std::ranges::count(text, '\n'));
    for (int i = 1; i <= line; ++i) {
        const std::string one = line_of(text, i);
        if (std::regex_search(one, std::regex("G4[12]"))) { section.first = i; }
        if (one.find("G18") != std::string::npos) { section.is_zx = true; }
        if (one.find("G17") != std::string::npos) { section.is_zx = false; }
    }
    section.is_entry = section.first == line;
    section.last = lines;
    for (int i = lines; i > line; --i) {
        if (line_of(text, i).find("G40") != std::string::npos) { section.last = i; }
    }
    return section;
}

double radius_in(const std::string& message) {
    const std::string before = "a tool of radius ";
    const std::size_t at = message.find(before);
    return at == std::string::npos ? 0 : std::strtod(message.c_str() + at + before.size(), nullptr);
}

/// The path to which the tool is to keep its distance: without the entry.
Path programmed_path(const std::string& text, const Section& section, std::array<std::size_t, 2> axes) {
    const std::vector<Call> calls = read_with_ours(uncompensated(text)).calls;
    std::size_t begin = calls.size();
    std::size_t end = calls.size();
    for (std::size_t i = calls.size(); i-- > 0;) {
        if (calls[i].line >= section.last) { end = i; }
        if (is_motion(calls[i]) && calls[i].line >= section.first) { begin = i; }
    }
    return path_of(calls, begin + (section.is_entry ? 0 : 1), end, axes);
}

bool comes_nearer(const Path& tool, const Path& programmed, double least, std::size_t normal) {
    const auto is_near = [&](At a, At b) {
        a[normal] = b[normal] = 0;
        return distance(a, b) < least;
    };
    return std::ranges::any_of(tool.places, [&](const At& a) {
        return std::ranges::any_of(programmed.places, [&](const At& b) { return is_near(a, b); });
    });
}

bool runs_backward(const Path& tool, const Path& programmed) {
    constexpr double kOpposite = 1e-3;
    return std::ranges::any_of(tool.ways, [&](const At& a) {
        return std::ranges::any_of(programmed.ways,
                                   [&](const At& b) { return a[0] * b[0] + a[1] * b[1] < -1 + kOpposite; });
    });
}

}  // namespace

bool strays_from_path(const std::string& text, const Reading& theirs, const Reading& ours) {
    constexpr double kMoreSweep = 2;  // radians: an arc that has passed its end goes around once more
    const Section section = section_about(text, ours.line);
    const std::array<std::size_t, 2> axes =
        section.is_zx ? std::array<std::size_t, 2>{2, 0} : std::array<std::size_t, 2>{0, 1};
    const Path programmed = programmed_path(text, section, axes);
    const std::size_t begin = ours.calls.empty() ? 0 : ours.calls.size() - 1;
    const Path tool = path_of(theirs.calls, begin, begin + kCallsAfter, axes);
    return comes_nearer(tool, programmed, radius_in(ours.message) - kDigits_mm, 3 - axes[0] - axes[1]) ||
           runs_backward(tool, programmed) || tool.most_sweep > programmed.most_sweep + kMoreSweep;
}

}  // namespace lockstep::oracle
