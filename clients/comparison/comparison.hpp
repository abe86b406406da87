// One move by the published methods of step generation, and its errors against the continuous ideal.
//
// Errors are step times minus the ideal's, in us, each in the method's own convention for a step's place. Peaks are
// measured from the steps as `lockstep analyze` measures them (clients/analysis/measure/speed_meter.hpp), in whole us.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clients/comparison/lines.hpp"
#include "core/methods/methods.hpp"
#include "core/motion/ideal.hpp"

namespace lockstep::comparison {

/// The result of a method for the move.
struct Outcome {
    methods::StepTrain train;
    std::vector<double> errors_us;  // of each step
    double duration_s = 0;          // until the last step
    double ratio = 0;               // to the ideal's last step
    double largest_error_us = 0;    // signed: below 0, early
    double rms_error_us = 0;
    double peak_speed = 0;                    // steps/s
    std::optional<double> peak_acceleration;  // steps/s^2, either way; nothing if the move is too short

    /// Speed over time, for a picture.
    std::vector<double> speed_time_s;
    std::vector<double> speed;
};

struct Row {
    methods::Method method;
    std::expected<Outcome, std::string> outcome;  // or why the method cannot make even a similar move
};

struct Comparison {
    StepMove move;
    double ideal_s = 0;
    double ideal_peak = 0;
    std::vector<Ideal::Corner> ideal;
    std::vector<Row> rows;
    std::vector<LineDeviation> lines;
};

/// The move must pass methods::check(). In the methods' order as given.
Comparison compare(const StepMove& move, std::span<const methods::Method> methods);

}  // namespace lockstep::comparison
