// Random programs without errors, from a seed. They use what a line can leave behind for later lines.
#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/gcode/gcode_stream.hpp"

namespace lockstep {

class RandomProgram {
public:
    /// `setup`: with the axes X, Y and Z.
    RandomProgram(std::uint32_t seed, GcodeSetup setup) : random_(seed), setup_(std::move(setup)) {}

    /// Each line is one that the lines before it allow.
    std::vector<std::string> lines(std::size_t count) {
        std::vector<std::string> lines;
        GcodeStream stream(setup_);
        for (std::size_t tries = 0; lines.size() < count && tries < 40 * count; ++tries) {
            std::string line = any_line();
            if (stream.take(line, static_cast<int>(lines.size()) + 1)) {
                lines.push_back(std::move(line));
            } else {
                stream = stream_behind(lines);  // an error is a stream's end
            }
        }
        return lines;
    }

private:
    GcodeStream stream_behind(const std::vector<std::string>& lines) const {
        GcodeStream stream(setup_);
        for (int number = 1; const std::string& line : lines) { (void)stream.take(line, number++); }
        return stream;
    }
    int pick(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
    std::string one_of(const std::vector<std::string>& texts) {
        return texts[static_cast<std::size_t>(pick(0, static_cast<int>(texts.size()) - 1))];
    }
    /// Often between two steps.
    std::string number(int most_mm) {
        return pick(0, 3) == 0 ? "0.00" + std::to_string(pick(1, 9))
                               : std::to_string(pick(0, most_mm)) + "." + std::to_string(pick(0, 9999));
    }
    std::string parameter() { return one_of({"#1", "#2", "#31", "#100", "#<a>", "#<b>", "#<_g>"}); }
    std::string value() {
        switch (pick(0, 9)) {
            case 0: return parameter();
            case 1: return "[" + parameter() + "/2+" + number(9) + "]";
            case 2: return "[#5420+" + number(3) + "]";
            case 3: return "[#<_y>-" + number(3) + "]";
            case 4: return "-" + number(9);
            default: return number(90);
        }
    }
    std::string axes(int least = 1) {
        std::string words;
        for (const char* letter : {"X", "Y", "Z"}) {
            if (pick(0, 1) == 1 || (words.empty() && least > 0 && *letter == 'Z')) { words += letter + value() + " "; }
        }
        return words;
    }
    std::string mode() {
        return one_of({"G90", "G91",  "G20", "G21",   "G17",    "G18", "G19",    "G54",    "G55",      "G59.3", "G93",
                       "G94", "F900", "F#1", "G90.1", "G91.1",  "G61", "G61.1",  "G64",    "G64 P",    "G98",   "G99",
                       "G80", "M70",  "M71", "M72",   "M73",    "M48", "M49",    "M50 P0", "M3 S900",  "M4",    "M5",
                       "S#2", "M7",   "M9",  "T1",    "M61 Q1", "G43", "G43 H1", "G49",    "G64 P0.1", "G1",    "G0"});
    }
    std::string offsets() {
        const std::string place = axes();
        return one_of({"G92 " + place, "G92.1", "G92.2", "G92.3", "G52 " + place, "G10 L2 P1 " + place,
                       "G10 L2 P2 R30 " + place, "G10 L20 P0 " + place, "G10 L1 P1 Z" + value() + " R1", "G28.1",
                       "G30.1", "#5221=" + value(), "#5242=" + value(), "#5220=2", "#5211=" + value(), "#5210=1",
                       "G43.1 Z" + value()});
    }
    std::string motion() {
        switch (pick(0, 9)) {
            case 0: return one_of({"G2", "G3"}) + " X" + value() + " Y" + value() + " I" + value() + " J" + value();
            case 1: return one_of({"G2", "G3"}) + " X" + value() + " Y" + value() + " R" + number(60);
            case 2: return one_of({"G81", "G82 P0.01", "G83 Q3"}) + " " + axes() + "R" + value();
            case 3: return "G5 X" + value() + " Y" + value() + " I1 J2 P" + value() + " Q1";
            case 4: return "G5 X" + value() + " Y" + value() + " P1 Q" + value();
            case 5: return one_of({"G5.2 X", "X", "G5.3 X"}) + value() + " Y" + value() + " P1 L3";
            case 6: return one_of({"G28", "G30", "G53 G0 ", "G4 P0.01"}) + (pick(0, 1) == 1 ? axes() : "");
            case 7: return axes();
            default: return one_of({"G0 ", "G1 ", "G1 F600 ", "G53 G1 "}) + axes();
        }
    }
    std::string any_line() {
        switch (pick(0, 9)) {
            case 0:
            case 1: return parameter() + "=" + value();
            case 2:
            case 3: return mode();
            case 4: return offsets();
            default: return motion();
        }
    }

    std::mt19937 random_;
    GcodeSetup setup_;
};

}  // namespace lockstep
