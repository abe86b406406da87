// Random paths with cutter compensation. The programmed place is kept here, because #5420 is the tool's place.
#include <cmath>
#include <cstdio>

#include "tests/integration/oracle/line_maker.hpp"

namespace lockstep::oracle {
namespace {

constexpr std::array<std::array<int, 2>, 3> kAxes{{{0, 1}, {2, 0}, {1, 2}}};

/// With so many digits arcs have the same radius at both ends: see the list in oracle_test.cpp.
std::string exact(double value) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.12f", value);
    return text.data();
}

}  // namespace

std::string LineMaker::end_words(PathEnd& path, std::array<double, 2> step) {
    std::string text;
    for (std::size_t i = 0; i < 2; ++i) {
        path.at[i] += step[i];
        text += " " + std::string(1, "XYZ"[path.axes[i]]) + exact(relative_ ? step[i] : path.at[i]);
    }
    return text;
}

/// Turns compensation on, with a tool of the table or a diameter in the current units.
std::string LineMaker::cutter_on() {
    const std::string left = one_in(2) ? "G41" : "G42";
    switch (below(is_plain_ ? 3 : 4)) {
        case 3: return left + " D" + std::to_string(1 + below(3));
        case 1:
            return left + ".1 D" + number(one_in(5) ? -drawn(0.1, 4) : drawn(0.1, 4)) +
                   (plane_ == 1 ? " L" + std::to_string(below(10)) : "");
        default: return left + ".1 D" + number(drawn(0.1, 6));
    }
}

std::string LineMaker::cutter_straight(PathEnd& path) {
    const double angle = drawn(0, 6.28);
    const double length = one_in(8) ? drawn(0.2, 5) : drawn(10, 60);
    const bool is_rapid = one_in(6);
    std::string text = is_rapid ? "G0" : "G1";
    text += end_words(
        path, {std::round(1000 * length * std::cos(angle)) / 1000, std::round(1000 * length * std::sin(angle)) / 1000});
    if (one_in(6)) { text += " A" + number(drawn(-9, 9)); }
    return is_rapid ? text : text + feed();
}

std::string LineMaker::cutter_arc(PathEnd& path, double least_angle, double most_angle) {
    const double i = drawn(4, 30);
    const double j = drawn(-30, 30);
    const double angle = drawn(least_angle, most_angle);
    const bool is_clockwise = one_in(2);
    const double turned = is_clockwise ? -angle : angle;
    const std::array<double, 2> step{i - (i * std::cos(turned) - j * std::sin(turned)),
                                     j - (i * std::sin(turned) + j * std::cos(turned))};
    std::string text = is_clockwise ? "G2" : "G3";
    std::string centre;
    for (std::size_t k = 0; k < 2; ++k) {
        const double offset = (k == 0 ? i : j) + (centres_absolute_ ? path.at[k] : 0);
        centre += " " + std::string(1, "IJK"[path.axes[k]]) + exact(offset);
    }
    text += end_words(path, step) + centre;
    if (one_in(6)) { text += " P" + std::to_string(1 + below(3)); }
    return text + feed();
}

std::string LineMaker::compensated() {
    PathEnd path{kAxes[static_cast<std::size_t>(plane_)], {drawn(-20, 20), drawn(-20, 20)}};
    const char normal = "XYZ"[3 - path.axes[0] - path.axes[1]];
    std::string text = "G90 G0";
    for (std::size_t i = 0; i < 2; ++i) { text += " " + std::string(1, "XYZ"[path.axes[i]]) + number(path.at[i]); }
    text += (relative_ ? "\nG91\n" : "\n") + cutter_on() + "\n";
    const bool is_lathe_tool = text.find(" L") != std::string::npos;
    text += !is_lathe_tool && one_in(5) ? cutter_arc(path, 1.6, 4.6) : cutter_straight(path);
    const int count = below(6);
    for (int i = 0; i < count; ++i) {
        text += "\n" + (one_in(3) ? cutter_arc(path, 0.3, 6) : cutter_straight(path));
        if (one_in(7)) { text += "\nG0 " + std::string(1, normal) + number(drawn(-5, 5)); }
        if (one_in(8)) { text += one_in(2) ? "\nG4 P0.5" : "\nM3 S80"; }
        if (one_in(6)) { text += "\n" + report(); }
    }
    return text + "\nG40\n" + (one_in(2) ? cutter_straight(path) : "G0 " + std::string(1, normal) + "3") + "\n" +
           report();
}

}  // namespace lockstep::oracle
