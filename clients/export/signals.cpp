#include "clients/export/signals.hpp"

#include "core/faults.hpp"

namespace lockstep::exporting {
namespace {

std::int64_t whole(std::int64_t number) { return number; }

std::string fault_name(std::int32_t fault) {
    return std::string(name_of(static_cast<FaultCode>(static_cast<std::uint16_t>(fault))));
}

Topic topic_of(const std::string& machine, const std::string& axis, const char* kind) {
    return "/" + machine + "/" + axis + "/" + kind;
}

}  // namespace

Sample sample_of(const axis_position_t& m) {
    return {topic_of(m.machine, m.axis, "position"),
            m.utime,
            {{"position_mm", m.position_mm},
             {"velocity_mm_s", m.velocity_mm_per_s},
             {"position_steps", whole(m.position_steps)},
             {"velocity_steps_s", m.velocity_steps_per_s},
             {"following_error_steps", whole(m.following_error_steps)},
             {"homed", whole(m.homed)},
             {"state", m.state},
             {"fault", whole(m.fault)},
             {"fault_name", fault_name(m.fault)}}};
}

Sample sample_of(const axis_health_t& m) {
    return {topic_of(m.machine, m.axis, "health"),
            m.utime,
            {{"step_lateness_min_us", m.step_lateness_min_us},
             {"step_lateness_max_us", m.step_lateness_max_us},
             {"setpoint_slack_min_ms", m.setpoint_slack_min_ms},
             {"setpoint_slack_max_ms", m.setpoint_slack_max_ms},
             {"loop_p50_us", m.loop_p50_us},
             {"loop_p99_us", m.loop_p99_us},
             {"loop_max_us", m.loop_max_us},
             {"clock_error_us", m.clock_error_us},
             {"least_free_segments", whole(m.least_free_segments)},
             {"least_free_captures", whole(m.least_free_captures)},
             {"refused_frames", whole(m.refused_frames)},
             {"refused_commands", whole(m.refused_commands)},
             {"refused_messages", whole(m.refused_messages)},
             {"refused_orders", whole(m.refused_orders)},
             {"lost_captures", whole(m.lost_captures)},
             {"lost_records", whole(m.lost_records)},
             {"skipped_loops", whole(m.skipped_loops)}}};
}

Sample sample_of(const channel_event_t& m) {
    return {topic_of(m.machine, m.axis, "channels"),
            m.utime,
            {{"kind", m.kind},
             {"channel", whole(m.channel)},
             {"closed", whole(m.closed)},
             {"levels", whole(m.levels)},
             {"value", whole(m.value)},
             {"detail", whole(m.detail)},
             {"tick", m.tick + m.ahead},
             {"clock_error_ticks", whole(m.clock_error)},
             {"lost", whole(m.lost)}}};
}

Sample sample_of(const job_t& m) {
    return {"/" + m.machine + "/job",
            m.utime,
            {{"job", whole(m.job)},
             {"kind", m.kind},
             {"event", m.event},
             {"outcome", m.outcome},
             {"epoch", whole(m.epoch)}}};
}

Sample sample_of(const program_event_t& m) {
    return {"/" + m.machine + "/event",
            m.utime,
            {{"job", whole(m.job)},
             {"kind", m.kind},
             {"index", whole(m.index)},
             {"value", m.value},
             {"line", whole(m.line)},
             {"tick", m.tick},
             {"at_rest", whole(m.at_rest)}}};
}

}  // namespace lockstep::exporting
