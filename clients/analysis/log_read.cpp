#include "clients/analysis/log_read.hpp"

#include <system_error>

#include "services/wire/lcm_decode.hpp"
#include "services/wire/lcm_log.hpp"

namespace lockstep::analysis {
namespace {

constexpr std::uint64_t kEventsPerProgress = 4096;

bool is_of(std::string_view channel, std::string_view suffix) {
    return channel.starts_with("LOCKSTEP_") && channel.ends_with(suffix);
}

template <typename Message>
void tell(const LogEvent& event, LogListener& listener, void (LogListener::*told)(const Message&, LogPlace)) {
    const auto message = decode_lcm<Message>(event.data);
    if (message) {
        (listener.*told)(*message, {event.offset, event.bytes});
    } else {
        listener.on_damage({event.offset, event.bytes}, message.error() + " on " + std::string(event.channel));
    }
}

void tell(const LogEvent& event, LogListener& listener) {
    if (is_of(event.channel, "_STEPS")) { return tell<step_batch_t>(event, listener, &LogListener::on_steps); }
    if (is_of(event.channel, "_POSITION")) { return tell<axis_position_t>(event, listener, &LogListener::on_position); }
    if (is_of(event.channel, "_HEALTH")) { return tell<axis_health_t>(event, listener, &LogListener::on_health); }
    if (is_of(event.channel, "_RUN")) { return tell<run_t>(event, listener, &LogListener::on_run); }
    if (is_of(event.channel, "_JOB")) { return tell<job_t>(event, listener, &LogListener::on_job); }
    listener.on_foreign(event.channel);
}

std::string reason_of(LogDamage::Kind kind) {
    switch (kind) {
        case LogDamage::Kind::CutOff: return "the log ends within an event";
        case LogDamage::Kind::NoEvent: return "bytes that are no event";
        case LogDamage::Kind::WrongLength: return "an event whose length is wrong";
    }
    return "";
}

void tell_damages(const LogReader& reader, LogListener& listener) {
    std::uint64_t bytes = 0;
    for (const LogDamage& damage : reader.damages()) {
        listener.on_damage({damage.offset, damage.bytes}, reason_of(damage.kind));
        bytes += damage.bytes;
    }
    if (reader.damaged_stretches() == reader.damages().size()) { return; }
    const std::uint64_t more = reader.damaged_stretches() - reader.damages().size();
    listener.on_damage({reader.damages().back().offset, reader.damaged_bytes() - bytes},
                       std::to_string(more) + " more damaged stretches, further on");
}

/// Events read. Progress is the share of the file behind us.
std::expected<std::uint64_t, std::string> read_events(LogReader& reader, LogListener& listener, double file_bytes,
                                                      const std::function<void(double)>& progress) {
    for (std::uint64_t events = 0;; ++events) {
        const auto event = reader.next();
        if (!event) { return std::unexpected(event.error()); }
        if (!*event) { return events; }
        tell(**event, listener);
        if (progress && events % kEventsPerProgress == 0) {
            progress(static_cast<double>((*event)->offset) / file_bytes);
        }
    }
}

}  // namespace

std::expected<std::uint64_t, std::string> read_log(const std::filesystem::path& path, LogListener& listener,
                                                   const std::function<void(double)>& progress) {
    auto reader = LogReader::open(path);
    if (!reader) { return std::unexpected(reader.error()); }
    std::error_code ignored;
    const auto bytes = static_cast<double>(std::filesystem::file_size(path, ignored));
    const auto events = read_events(*reader, listener, bytes, progress);
    if (!events) { return events; }
    tell_damages(*reader, listener);
    if (bytes == 0) { return std::unexpected(path.string() + ": the file is empty"); }
    if (*events == 0) { return std::unexpected(path.string() + ": not an LCM log: no event in it"); }
    if (progress) { progress(1); }
    return events;
}

}  // namespace lockstep::analysis
