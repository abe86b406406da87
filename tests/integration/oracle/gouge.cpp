#include "tests/integration/oracle/gouge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <regex>
#include <sstream>
#include <vector>

#include "core/gcode/run/corner.hpp"
#include "tests/integration/oracle/differences.hpp"

namespace lockstep::oracle {
namespace {

using At = std::array<double, 3>;

constexpr double kSample_mm = 0.02;
constexpr double kDigits_mm = 0.01;      // of rs274's output, and of the samples
constexpr std::size_t kCallsAfter = 12;  // how many calls of rs274 after the refused line are checked

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

/// An arc about the axis that is normal to the plane of the axes `in`.
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
    At direction(double turned) const {
        const double angle = begin + side * turned;
        return {-side * std::sin(angle), side * std::cos(angle), 0};
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
    std::vector<At> ways;   // unit directions of the straight motions
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

/// The directions of a motion where it begins and ends, in the plane.
struct Way {
    At begin{};
    At end{};
    int line = 0;
    bool is_arc = false;
};

std::vector<Way> ways_of(const std::vector<Call>& calls, std::array<std::size_t, 2> axes) {
    std::vector<Way> ways;
    At at{};
    for (std::size_t i = 0; i < calls.size(); ++i) {
        if (!is_motion(calls[i])) { continue; }
        const At to = place_of(calls[i]);
        const bool is_arc = calls[i].name == "arc" && i + 1 < calls.size() && calls[i + 1].name == "centre";
        if (is_arc) {
            const SweptArc arc(at, calls[i], calls[i + 1], axes);
            ways.push_back({arc.direction(0), arc.direction(arc.sweep), calls[i].line, true});
        } else {
            const At way{to[axes[0]] - at[axes[0]], to[axes[1]] - at[axes[1]], 0};
            if (std::hypot(way[0], way[1]) > kDigits_mm) { ways.push_back({way, way, calls[i].line, false}); }
        }
        at = to;
    }
    return ways;
}

/// The text without the words that turn compensation on. An L beside them belongs to a lathe's tool, unless another
/// code of the line has one.
std::string uncompensated(const std::string& text) {
    const std::regex on("G4[12](\\.1)?|D *[-+]?[0-9.]+");
    const std::regex lathe("L *[-+]?[0-9.]+");
    const std::regex other("G10|G73|G8[1-9]|M66");
    std::string without;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (std::regex_search(line, std::regex("G4[12]"))) {
            line = std::regex_replace(line, on, "");
            if (!std::regex_search(line, other)) { line = std::regex_replace(line, lathe, ""); }
        }
        without += line + "\n";
    }
    return without;
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

std::array<std::size_t, 2> axes_of(const Section& section) {
    return section.is_zx ? std::array<std::size_t, 2>{2, 0} : std::array<std::size_t, 2>{0, 1};
}

double radius_in(const std::string& message) {
    const std::string before = "a tool of radius ";
    const std::size_t at = message.find(before);
    return at == std::string::npos ? 0 : std::strtod(message.c_str() + at + before.size(), nullptr);
}

/// The programmed path, without the entry. The tool must keep its distance from it.
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

/// The least distance between the two paths in the plane.
double nearest(const Path& tool, const Path& programmed, std::array<std::size_t, 2> axes) {
    double least = std::numeric_limits<double>::infinity();
    for (const At& a : tool.places) {
        for (const At& b : programmed.places) {
            least = std::min(least, std::hypot(a[axes[0]] - b[axes[0]], a[axes[1]] - b[axes[1]]));
        }
    }
    return least;
}

bool runs_backward(const Path& tool, const Path& programmed) {
    constexpr double kOpposite = 1e-3;
    return std::ranges::any_of(tool.ways, [&](const At& a) {
        return std::ranges::any_of(programmed.ways,
                                   [&](const At& b) { return a[0] * b[0] + a[1] * b[1] < -1 + kOpposite; });
    });
}

struct Corner {
    double turn = 0;  // radians, above 0 to the left
    int before = 0;   // the lines of its motions
    int after = 0;
    bool has_arc = false;
};

/// The corners of the program's path, in the plane of `line`.
std::vector<Corner> corners_of(const std::string& text, int line) {
    const auto axes = axes_of(section_about(text, line));
    const std::vector<Way> ways = ways_of(read_with_ours(uncompensated(text)).calls, axes);
    std::vector<Corner> corners;
    for (std::size_t i = 0; i + 1 < ways.size(); ++i) {
        const At& arrival = ways[i].end;
        const At& departure = ways[i + 1].begin;
        const double turn = std::atan2(arrival[0] * departure[1] - arrival[1] * departure[0],
                                       arrival[0] * departure[0] + arrival[1] * departure[1]);
        corners.push_back({turn, ways[i].line, ways[i + 1].line, ways[i].is_arc || ways[i + 1].is_arc});
    }
    return corners;
}

}  // namespace

bool strays_from_path(const std::string& text, const Reading& theirs, const Reading& ours) {
    constexpr double kMoreSweep = 2;  // radians: an arc that has passed its end goes around once more
    const Section section = section_about(text, ours.line);
    const auto axes = axes_of(section);
    const Path programmed = programmed_path(text, section, axes);
    const std::size_t begin = ours.calls.empty() ? 0 : ours.calls.size() - 1;
    const Path tool = path_of(theirs.calls, begin, begin + kCallsAfter, axes);
    return nearest(tool, programmed, axes) < radius_in(ours.message) - kDigits_mm || runs_backward(tool, programmed) ||
           tool.most_sweep > programmed.most_sweep + kMoreSweep;
}

bool turns_back_at(const std::string& text, int line) {
    return std::ranges::any_of(corners_of(text, line), [&](const Corner& corner) {
        const bool turns_back = std::abs(corner.turn) > std::numbers::pi - gcode::kLeastCorner;
        return turns_back && corner.has_arc && (corner.before == line || corner.after == line);
    });
}

bool follows_almost_straight_arc(const std::string& text, int line) {
    const std::vector<Corner> corners = corners_of(text, line);
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const Corner& begin = corners[i - 1];
        if (corners[i].after == line && begin.has_arc && std::abs(begin.turn) < gcode::kLeastCorner) { return true; }
    }
    return false;
}

}  // namespace lockstep::oracle
