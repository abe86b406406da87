#include "services/wire/translate/checks.hpp"
#include "services/wire/translate/translate.hpp"

namespace lockstep {
namespace {

lockstep_wire_Extremes to_wire(const Extremes& extremes) {
    return {.count = extremes.count, .least = extremes.least.value, .most = extremes.most.value};
}

Extremes believed(const lockstep_wire_Extremes& wire, const char* field, Checks& check) {
    check.far(field, wire.least);
    check.far(field, wire.most);
    return {.count = wire.count, .least = {wire.least}, .most = {wire.most}};
}

Ticks believed_length(const char* field, std::int64_t ticks, Checks& check) {
    check.far(field, ticks);
    return {ticks};
}

}  // namespace

lockstep_wire_AxisHealth to_wire(const AxisHealth& health) {
    return {.axis = health.axis,
            .identity = health.identity,
            .tick = health.tick.value,
            .step_lateness = to_wire(health.step_lateness),
            .step_interval = to_wire(health.step_interval),
            .setpoint_slack = to_wire(health.setpoint_slack),
            .least_free_segments = health.least_free_segments,
            .least_free_captures = health.least_free_captures,
            .loop_p50_ticks = health.loop.p50.value,
            .loop_p99_ticks = health.loop.p99.value,
            .loop_most_ticks = health.loop.most.value,
            .has_setpoint_age = health.setpoint_age.has_value(),
            .setpoint_age_ticks = health.setpoint_age.value_or(Ticks{}).value,
            .clock_error_ticks = health.clock_error.value,
            .refused_frames = health.refused.frames,
            .refused_commands = health.refused.commands,
            .refused_messages = health.refused.messages,
            .refused_orders = health.refused.orders,
            .lost_captures = health.refused.captures,
            .lost_records = health.refused.records,
            .skipped_loops = health.refused.skipped_loops,
            .step_messages = health.published.steps,
            .run_messages = health.published.runs,
            .position_messages = health.published.positions,
            .figure_messages = health.published.figures,
            .channel_messages = health.published.channel_events,
            .reopened = health.process.reopened,
            .lost_log_lines = health.process.lost_log_lines};
}

FromWire<AxisHealth> from_wire(const lockstep_wire_AxisHealth& wire) {
    Checks check("axis health");
    check.within<std::size_t>("axis", wire.axis, 0, kMaxAxes - 1);
    check.far("tick", wire.tick);
    const Ticks age = believed_length("setpoint_age_ticks", wire.setpoint_age_ticks, check);
    const AxisHealth health{
        .identity = wire.identity,
        .axis = wire.axis,
        .tick = {wire.tick},
        .step_lateness = believed(wire.step_lateness, "step_lateness", check),
        .step_interval = believed(wire.step_interval, "step_interval", check),
        .setpoint_slack = believed(wire.setpoint_slack, "setpoint_slack", check),
        .least_free_segments = wire.least_free_segments,
        .least_free_captures = wire.least_free_captures,
        .loop = {.p50 = believed_length("loop_p50_ticks", wire.loop_p50_ticks, check),
                 .p99 = believed_length("loop_p99_ticks", wire.loop_p99_ticks, check),
                 .most = believed_length("loop_most_ticks", wire.loop_most_ticks, check)},
        .setpoint_age = wire.has_setpoint_age ? std::optional(age) : std::nullopt,
        .clock_error = believed_length("clock_error_ticks", wire.clock_error_ticks, check),
        .refused = {.frames = wire.refused_frames,
                    .commands = wire.refused_commands,
                    .messages = wire.refused_messages,
                    .orders = wire.refused_orders,
                    .captures = wire.lost_captures,
                    .records = wire.lost_records,
                    .skipped_loops = wire.skipped_loops},
        .published = {.steps = wire.step_messages,
                      .runs = wire.run_messages,
                      .positions = wire.position_messages,
                      .figures = wire.figure_messages,
                      .channel_events = wire.channel_messages},
        .process = {.reopened = wire.reopened, .lost_log_lines = wire.lost_log_lines},
    };
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    return health;
}

}  // namespace lockstep
