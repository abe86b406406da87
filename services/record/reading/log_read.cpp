#include "services/record/reading/log_read.hpp"

#include <system_error>
#include <utility>

#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/lcm_decode.hpp"

namespace lockstep::analysis {
namespace {

constexpr std::uint64_t kEventsPerProgress = 4096;

template <typename Message>
void deliver(const LogEvent& event, LogListener& listener, void (LogListener::*handler)(const Message&, LogPlace)) {
    const auto message = decode_lcm<Message>(event.data);
    if (message) {
        (listener.*handler)(*message, {event.offset, event.bytes});
    } else {
        listener.on_damage({event.offset, event.bytes}, message.error() + " on " + std::string(event.channel));
    }
}

void deliver_steps(const LogEvent& event, LogListener& listener, step_batch_t& message) {
    const LogPlace place{event.offset, event.bytes};
    message.delta_ticks.clear();
    message.direction.clear();
    const auto decoded = decode_lcm(event.data, message);
    if (!decoded) { return listener.on_damage(place, decoded.error() + " on " + std::string(event.channel)); }
    listener.on_steps(message, place);
}

void deliver_part(const LogEvent& event, LogListener& listener, ProgramParts& programs) {
    const LogPlace place{event.offset, event.bytes};
    const auto part = decode_lcm<program_part_t>(event.data);
    if (!part) { return listener.on_damage(place, part.error() + " on " + std::string(event.channel)); }
    if (const auto taken = programs.take(*part, event.offset); !taken) {
        return listener.on_damage(place, taken.error());
    }
    listener.on_program_part(*part, place);
}

/// Finds the parts of a job's program that were received while it ran, and therefore follow the job in the log.
void look_ahead(const std::filesystem::path& path, const job_t& job, ProgramParts& programs) {
    auto reader = LogReader::open(path);
    while (reader) {
        const auto event = reader->next();
        if (!event || !*event) { return; }
        if (kind_of((*event)->channel) != RecordKind::ProgramPart) { continue; }
        if (const auto part = decode_lcm<program_part_t>((*event)->data)) {
            programs.take_later(*part, (*event)->offset, job);
        }
    }
}

/// A job's link to its program and the program's parts are recorded before the job, but the job may have overtaken the
/// last of them.
void look_for_link(const std::filesystem::path& path, std::uint64_t offset, ProgramParts& programs) {
    constexpr int kOvertaken = 32;
    auto reader = LogReader::open(path);
    if (!reader) { return; }
    (void)reader->event_at(offset);
    for (int i = 0; i < kOvertaken; ++i) {
        const auto event = reader->next();
        if (!event || !*event) { return; }
        if (kind_of((*event)->channel) != RecordKind::ProgramPart) { continue; }
        const auto part = decode_lcm<program_part_t>((*event)->data);
        if (part) { (void)programs.take(*part, (*event)->offset); }
    }
}

void deliver_job(const LogEvent& event, LogListener& listener, ProgramParts& programs,
                 const std::filesystem::path& path) {
    const LogPlace place{event.offset, event.bytes};
    auto message = decode_lcm<job_t>(event.data);
    if (!message) { return listener.on_damage(place, message.error() + " on " + std::string(event.channel)); }
    RecordedJob job(*std::move(message));
    if (job.event == "begun" && job.program.empty()) { look_for_link(path, event.offset, programs); }
    if (programs.is_open(job)) { look_ahead(path, job, programs); }
    programs.complete(job);
    listener.on_job(job, place);
}

void deliver_mark(const LogEvent& event, LogListener& listener) {
    const LogPlace place{event.offset, event.bytes};
    const auto mark = decode_mark(event.data);
    if (!mark) { return listener.on_damage(place, mark.error() + " on " + std::string(event.channel)); }
    listener.on_mark(*mark, place);
}

/// `steps`: its memory is used again for each message of steps.
void deliver(const LogEvent& event, LogListener& listener, ProgramParts& programs, const std::filesystem::path& path,
             step_batch_t& steps) {
    switch (kind_of(event.channel)) {
        case RecordKind::Steps: return deliver_steps(event, listener, steps);
        case RecordKind::Position: return deliver<axis_position_t>(event, listener, &LogListener::on_position);
        case RecordKind::Health: return deliver<axis_health_t>(event, listener, &LogListener::on_health);
        case RecordKind::Run: return deliver<run_t>(event, listener, &LogListener::on_run);
        case RecordKind::Channels: return deliver<channel_event_t>(event, listener, &LogListener::on_channel);
        case RecordKind::Job: return deliver_job(event, listener, programs, path);
        case RecordKind::Event: return deliver<program_event_t>(event, listener, &LogListener::on_event);
        case RecordKind::ProgramPart: return deliver_part(event, listener, programs);
        case RecordKind::Mark: return deliver_mark(event, listener);
        case RecordKind::Loss: return;  // concerns one log only; sequence numbers show which messages the record lacks
        case RecordKind::Foreign: return listener.on_foreign(event.channel);
    }
}

/// Returns the number of events read. Progress is the share of the file that has been read.
std::expected<std::uint64_t, std::string> read_events(LogReader& reader, const std::filesystem::path& path,
                                                      LogListener& listener, double file_bytes,
                                                      const std::function<void(double)>& progress) {
    ProgramParts programs(path);
    step_batch_t steps;
    for (std::uint64_t events = 0;; ++events) {
        const auto event = reader.next();
        if (!event) { return std::unexpected(event.error()); }
        if (!*event) { return events; }
        deliver(**event, listener, programs, path, steps);
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
    const auto events = read_events(*reader, path, listener, bytes, progress);
    if (!events) { return events; }
    report_damages(*reader, [&](LogPlace place, std::string what) { listener.on_damage(place, std::move(what)); });
    if (bytes == 0) { return std::unexpected(path.string() + ": the file is empty"); }
    if (*events == 0) { return std::unexpected(path.string() + ": not an LCM log: no event in it"); }
    if (progress) { progress(1); }
    return events;
}

}  // namespace lockstep::analysis
