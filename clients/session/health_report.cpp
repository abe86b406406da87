#include "clients/session/health_report.hpp"

namespace lockstep {
namespace {

constexpr double kMicrosecond = 1;
constexpr double kMillisecond = 1e-3;  // times microseconds

}  // namespace

proto::HealthReport health_report(const AxisHealth& health, const MachineConfig& machine) {
    const auto in = [&](double unit, Ticks ticks) { return machine.microseconds(ticks) * unit; };
    const auto fill = [&](proto::Spread* spread, const Extremes& extremes, double unit) {
        spread->set_count(extremes.count);
        spread->set_min(in(unit, extremes.least));
        spread->set_max(in(unit, extremes.most));
    };
    proto::HealthReport report;
    if (health.step_lateness.count > 0) { fill(report.mutable_step_lateness_us(), health.step_lateness, kMicrosecond); }
    if (health.step_interval.count > 0) { fill(report.mutable_step_interval_us(), health.step_interval, kMicrosecond); }
    if (health.setpoint_slack.count > 0) {
        fill(report.mutable_setpoint_slack_ms(), health.setpoint_slack, kMillisecond);
    }
    if (health.setpoint_age) { report.set_setpoint_age_ms(in(kMillisecond, *health.setpoint_age)); }
    report.set_least_free_segments(health.least_free_segments);
    report.set_least_free_captures(health.least_free_captures);
    report.set_loop_p50_us(in(kMicrosecond, health.loop.p50));
    report.set_loop_p99_us(in(kMicrosecond, health.loop.p99));
    report.set_loop_max_us(in(kMicrosecond, health.loop.most));
    report.set_clock_error_us(in(kMicrosecond, health.clock_error));
    report.set_refused_frames(health.refused.frames);
    report.set_refused_commands(health.refused.commands);
    report.set_refused_messages(health.refused.messages);
    report.set_refused_orders(health.refused.orders);
    report.set_lost_captures(health.refused.captures);
    report.set_lost_records(health.refused.records);
    report.set_skipped_loops(health.refused.skipped_loops);
    report.set_participant_reopened(health.process.reopened);
    report.set_lost_log_lines(health.process.lost_log_lines);
    return report;
}

}  // namespace lockstep
