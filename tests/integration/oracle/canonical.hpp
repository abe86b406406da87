// What a program does, as a list of calls that two interpreters can be compared by.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/motion.hpp"

namespace lockstep::oracle {

/// Moves end in machine coordinates, mm and degrees: X Y Z A B C, and the feed (0: rapid). Arcs have their centre and
/// their signed turns besides.
struct Call {
    std::string name;
    std::vector<double> numbers;
    double tolerance = 1e-6;  // of the numbers
    double relative = 0;      // how much more, of a number: a rounded length makes so much of a feed
    int line = 0;             // of the text; 0: not known
};

std::string to_text(const Call& call);
bool equal(const Call& a, const Call& b);

/// Of rs274's output. Its numbers have four decimals, so they are known to half of the last; values that the program
/// prints itself, (debug,#5420), have six.
std::vector<Call> calls_of_output(std::string_view output);
/// The same format with all digits.
std::vector<Call> calls_of_exact_output(std::string_view output);

/// Without moves that lead to where the axes stand.
std::vector<Call> without_rests(const std::vector<Call>& calls);

/// Of our interpreter's actions.
class CallList {
public:
    void take(const gcode::Action& action, int line);
    const std::vector<Call>& calls() const { return calls_; }

private:
    void add(std::string name, std::vector<double> numbers = {});
    void take_event(const gcode::Event& event);

    std::vector<Call> calls_;
    int line_ = 0;
};

}  // namespace lockstep::oracle
