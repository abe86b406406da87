#include "clients/merge/message_id.hpp"

#include "services/record/reading/log_step.hpp"
#include "services/record/reading/recorded_mark.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/lcm_decode.hpp"

namespace lockstep::merge {
namespace {

using Identified = std::expected<std::optional<MessageId>, std::string>;

std::int64_t process_of(const job_t& message) { return message.coordinator; }
std::int64_t process_of(const program_event_t& message) { return message.coordinator; }
std::int64_t process_of(const program_part_t& message) { return message.coordinator; }
template <typename Message>
std::int64_t process_of(const Message& message) {
    return message.incarnation;
}

template <typename Message>
Identified identify_as(const LogEvent& event) {
    const auto message = decode_lcm<Message>(event.data);
    if (!message) { return std::unexpected(message.error() + " on " + std::string(event.channel)); }
    MessageId id{.utime = message->utime, .channel = std::string(event.channel), .number = {}};
    if constexpr (requires { message->sequence; }) {
        id.number = MessageNumber{process_of(*message), message->sequence};
        if (!analysis::is_message_number(message->sequence)) {
            return std::unexpected("a message with an impossible number");
        }
    }
    if constexpr (std::is_same_v<Message, step_batch_t>) {
        if (const auto batch = analysis::to_batch(*message); !batch) { return std::unexpected(batch.error()); }
    }
    if (!analysis::is_countable(id.utime)) { return std::unexpected("a message with an impossible time"); }
    return id;
}

Identified identify_mark(const LogEvent& event) {
    const auto mark = analysis::decode_mark(event.data);
    if (!mark) { return std::unexpected(mark.error() + " on " + std::string(event.channel)); }
    if (!analysis::is_countable(mark->utime)) { return std::unexpected("a message with an impossible time"); }
    return MessageId{.utime = mark->utime, .channel = std::string(event.channel), .number = {}};
}

}  // namespace

std::expected<std::optional<MessageId>, std::string> identify(const LogEvent& event) {
    switch (kind_of(event.channel)) {
        case RecordKind::Steps: return identify_as<step_batch_t>(event);
        case RecordKind::Position: return identify_as<axis_position_t>(event);
        case RecordKind::Health: return identify_as<axis_health_t>(event);
        case RecordKind::Run: return identify_as<run_t>(event);
        case RecordKind::Channels: return identify_as<channel_event_t>(event);
        case RecordKind::Job: return identify_as<job_t>(event);
        case RecordKind::Event: return identify_as<program_event_t>(event);
        case RecordKind::ProgramPart: return identify_as<program_part_t>(event);
        case RecordKind::Mark: return identify_mark(event);
        case RecordKind::Loss: return identify_as<record_loss_t>(event);
        case RecordKind::Foreign: break;
    }
    return std::nullopt;
}

}  // namespace lockstep::merge
