#include "services/record/reading/recorded_mark.hpp"

#include "services/wire/lcm/lcm_decode.hpp"

namespace lockstep::analysis {
namespace {

RecordedMark recorded(const auto& message) {
    RecordedMark mark{.utime = message.utime,
                      .machine = message.machine,
                      .witness = message.witness,
                      .process = message.process,
                      .incarnation = message.incarnation,
                      .ended = message.ended != 0,
                      .steps = message.steps,
                      .runs = message.runs,
                      .positions = message.positions,
                      .figures = message.figures,
                      .channel_events = {},
                      .job_events = message.job_events,
                      .program_parts = message.program_parts};
    if constexpr (requires { message.channel_events; }) { mark.channel_events = message.channel_events; }
    return mark;
}

}  // namespace

std::expected<RecordedMark, std::string> decode_mark(std::span<const std::uint8_t> bytes) {
    if (const auto earlier = decode_lcm<record_mark_t>(bytes)) { return recorded(*earlier); }
    const auto message = decode_lcm<record_mark2_t>(bytes);
    if (!message) { return std::unexpected(message.error()); }
    return recorded(*message);
}

}  // namespace lockstep::analysis
