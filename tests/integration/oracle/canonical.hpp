// The effects of a program as a list of calls, by which two interpreters can be compared.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/motion.hpp"

namespace lockstep::oracle {

/// The numbers of a move are its end in machine coordinates (X Y Z A B C, in mm and degrees) and its feed (0: rapid).
/// An arc also has its signed turns, and a call for its centre.
struct Call {
    std::string name;
    std::vector<double> numbers;
    double tolerance = 1e-6;  // of the numbers
    double relative = 0;      // increase of the tolerance per unit of a number: rounded lengths change a feed
    int line = 0;             // of the text; 0: not known
};

std::string to_text(const Call& call);
bool equal(const Call& a, const Call& b);

/// The calls in rs274's output. Its numbers have four decimals, so they are known to half of the last one. Values that
/// the program prints itself, (debug,#5420), have six.
std::vector<Call> calls_of_output(std::string_view output);
/// The same format with all digits.
std::vector<Call> calls_of_exact_output(std::string_view output);

/// The calls without moves to the place where the axes already stand.
std::vector<Call> without_rests(const std::vector<Call>& calls);

/// Collects the calls of our interpreter's actions.
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
