#include "clients/methods/report.hpp"

namespace lockstep::comparison {
namespace {

void fill(const Row& row, proto::ComparedMethod& report) {
    report.set_name(std::string(row.method.name));
    report.set_source(std::string(row.method.source));
    report.set_step_at(row.method.crossing == Crossing::Half ? "k - 1/2" : "k");
    if (!row.outcome) {
        report.set_refusal(row.outcome.error());
        return;
    }
    const Outcome& made = *row.outcome;
    if (!made.train.nearest.empty()) { report.set_nearest(made.train.nearest); }
    report.set_clock_us(made.train.clock_s * 1e6);
    report.set_steps(static_cast<std::int64_t>(made.train.times_s.size()));
    report.set_duration_s(made.duration_s);
    report.set_ratio_to_ideal(made.ratio);
    report.set_peak_velocity_steps_s(made.peak_speed);
    if (made.peak_acceleration) { report.set_peak_acceleration_steps_s2(*made.peak_acceleration); }
    report.set_largest_error_us(made.largest_error_us);
    report.set_rms_error_us(made.rms_error_us);
}

void fill(const LineDeviation& line, proto::ComparedLine& report) {
    report.set_from_x(line.from_x);
    report.set_deviation_without_dda_pulses(line.without_dda);
    report.set_deviation_with_dda_pulses(line.with_dda);
    report.set_peak_without_dda_pulses_s(line.rate_without_dda);
    report.set_peak_with_dda_pulses_s(line.rate_with_dda);
}

}  // namespace

proto::CompareReport to_report(const Comparison& comparison) {
    proto::CompareReport report;
    proto::ComparedMove& move = *report.mutable_move();
    move.set_steps(comparison.move.steps);
    move.set_start_steps_s(comparison.move.start);
    move.set_max_steps_s(comparison.move.max);
    move.set_acceleration_steps_s2(comparison.move.acceleration);
    move.set_deceleration_steps_s2(comparison.move.deceleration);
    report.set_ideal_duration_s(comparison.ideal_s);
    report.set_ideal_peak_steps_s(comparison.ideal_peak);
    for (const Row& row : comparison.rows) { fill(row, *report.add_methods()); }
    for (const LineDeviation& line : comparison.lines) { fill(line, *report.add_lines()); }
    return report;
}

}  // namespace lockstep::comparison
