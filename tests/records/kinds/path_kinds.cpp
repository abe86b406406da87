// Records of programs, one for each kind of path.
#include <cmath>

#include "tests/records/kinds/kinds.hpp"

namespace lockstep::records {
namespace {

RecordKind program(std::string name, const std::string& gcode) {
    return {std::move(name), [gcode] { return recorded_program("G21 G90 G17 G94\n" + gcode); }};
}

/// A curve in short lines, one direction after the other.
std::string short_lines(int count, double length_mm, const std::string& mode) {
    std::string text = mode + "\nG1 F3000\n";
    double angle = 0;
    double x = 60;
    double y = 60;
    for (int i = 0; i < count; ++i) {
        angle += 0.03 + 0.02 * std::sin(0.01 * i);
        x += length_mm * std::cos(angle);
        y += length_mm * std::sin(angle);
        text += "X" + std::to_string(x) + " Y" + std::to_string(y) + "\n";
    }
    return text;
}

/// Lines along one axis: each end is a joint where no axis turns.
std::string straight_lines(int count) {
    std::string text = "G64\nG1 F3000\n";
    for (int i = 1; i <= count; ++i) { text += "X" + std::to_string(5 + 0.01 * i) + "\n"; }
    return text;
}

}  // namespace

std::vector<RecordKind> path_kinds() {
    return {
        program("two_lines_with_an_arc", "G0 X10 Y10\nG2 X30 Y10 I10 J0 F1200\n"),
        program("quarter_arcs",
                "G0 X20 Y20\nG1 X60 F3000\nG3 X70 Y30 R10\nG1 Y50\nG3 X60 Y60 I-10 J0\nG1 X20\n"
                "G3 X10 Y50 R10\nG1 Y30\nG3 X20 Y20 I10 J0\n"),
        program("full_circles", "G0 X40 Y30\nG2 I10 J0 F3000\nG3 I-5 J5\n"),
        program("arcs_in_other_planes", "G0 X20 Y20 Z10\nG18 G2 X40 Z10 I10 K0 F2400\nG19 G3 Y40 Z10 J10 K0\nG17\n"),
        program("helices", "G0 X40 Y40 Z5\nG2 X40 Y40 Z10 I10 J0 P3 F3000\nG3 X60 Y40 Z6 I10 J0\n"),
        program("arcs_joined_with_lines", "G64 P0.1\nG0 X20 Y20\nG1 X40 F4000\nG2 X50 Y10 R10\nG1 Y5\nX30\n"),
        program("splines", "G0 X20 Y20\nG5 I0 J-8 P0 Q-8 X32 Y20 F2400\nG5.1 I5 J8 X50 Y20\n"),
        program("canned_cycles",
                "G0 X10 Y10 Z20\nG99 G81 X15 Y15 Z4 R8 F1200\nX25\nG98 G83 Z3 R8 Q2\n"
                "G82 X30 Y20 Z6 R8 P0.1\nG80\nG0 X5\n"),
        program("short_lines_joined", short_lines(2000, 0.08, "G64")),
        program("short_lines_joined_widely", short_lines(1000, 0.08, "G64 P0.05")),
        program("straight_short_lines_joined", straight_lines(3000)),
        program("short_lines_exact_path", short_lines(150, 0.4, "G61")),
        program("short_lines_exact_stop", short_lines(20, 2, "G61.1")),
        program("corners_joined", "G64 P0.5\nG1 X40 Y8 F6000\nX42 Y40\nX10 Y40\nX5 Y5\n"),
        program("dwells", "G1 X30 F3000\nG4 P0.3\nY30\nG4 P0.05\nG0 X5 Y5\n"),
        program("inverse_time", "G93\nG1 X20 Y20 F60\nG2 X40 Y20 I10 J0 F60\nG94\n"),
        {"one_slow_axis_with_a_coarse_clock",
         [] { return recorded_program(slow_axis_machine(), "G64\nG1 X2 F200\nX3.5\nX3.2\nX6\nX5.9\nX0.5\n"); }},
    };
}

}  // namespace lockstep::records
