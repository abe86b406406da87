// Runs one move with the published methods of step generation and measures their errors against the continuous ideal.
//
// An error is a step time minus the ideal's step time, in us. The ideal's step times follow the method's own convention
// for a step's place (Crossing). Peaks are measured from step times rounded to whole us, as `lockstep analyze` measures
// them (clients/analysis/measure/speed_meter.hpp).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clients/methods/lines.hpp"
#include "core/methods/methods.hpp"
#include "core/motion/ideal.hpp"

namespace lockstep::comparison {

/// The result of a method for the move.
struct Outcome {
    methods::StepTrain train;
    std::vector<double> errors_us;  // of each step
    double duration_s = 0;          // until the last step
    double ratio = 0;               // of duration_s to the time of the ideal's last step
    double largest_error_us = 0;    // negative if the step is early
    double rms_error_us = 0;
    double peak_speed = 0;                    // steps/s
    std::optional<double> peak_acceleration;  // steps/s^2, up or down; nullopt if the move is too short

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

/// The move must pass methods::check(). The rows have the order of `methods`.
Comparison compare(const StepMove& move, std::span<const methods::Method> methods);

}  // namespace lockstep::comparison
