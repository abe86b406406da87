#include "clients/incident/flight_file.hpp"

#include <utility>

#include "services/documents/machine_file.hpp"
#include "services/wire/lcm/lcm_decode.hpp"

namespace lockstep::incident {
namespace {

using analysis::LogPlace;

std::string no_incident(const std::filesystem::path& path) {
    return path.string() +
           ": contains no notes of a flight recorder; an incident file is named STAMP-PROCESS-NUMBER.flight.lcm, "
           "and is in the directory that lockstep status shows. Name the log of a run after the incident files, or "
           "give it to lockstep analyze without --incident";
}

/// The machine from the process's configuration. If that cannot be read, only the data of the head.
MachineConfig machine_of(const FlightSource& source) {
    auto machine = parse_machine(source.config);
    return machine ? *std::move(machine) : MachineConfig{.name = source.machine, .tick_ns = source.tick_ns};
}

class Reading {
public:
    explicit Reading(const std::filesystem::path& path) { file_.path = path; }

    void take(const LogEvent& event) {
        const LogPlace place{event.offset, event.bytes};
        if (const auto head = decode_lcm<flight_head_t>(event.data)) { return take_head(*head, place); }
        if (const auto note = decode_lcm<flight_note_t>(event.data)) {
            file_.note = note->text;
            return;
        }
        const auto message = decode_lcm<flight_event_t>(event.data);
        if (!message) { return damage(place, message.error() + " on " + std::string(event.channel)); }
        if (!has_head_) { return damage(place, "an event comes before the head"); }
        const auto noted = from_lcm(*message, file_.machine);
        if (!noted) { return damage(place, noted.error()); }
        file_.events.push_back(*noted);
    }
    void damage(LogPlace place, std::string what) { analysis::note_damage(file_.damages, place, std::move(what)); }
    bool has_head() const { return has_head_; }
    FlightFile take() && { return std::move(file_); }

private:
    void take_head(const flight_head_t& message, LogPlace place) {
        auto head = from_lcm(message);
        if (!head) { return damage(place, head.error()); }
        if (std::exchange(has_head_, true)) { return damage(place, "the file has a second head"); }
        file_.head = *std::move(head);
        file_.machine = machine_of(file_.head.source);
    }

    FlightFile file_;
    bool has_head_ = false;
};

}  // namespace

std::expected<FlightFile, std::string> read_flight_file(const std::filesystem::path& path) {
    auto reader = LogReader::open(path);
    if (!reader) { return std::unexpected(reader.error()); }
    Reading reading(path);
    for (;;) {
        const auto event = reader->next();
        if (!event) { return std::unexpected(path.string() + ": " + event.error()); }
        if (!*event) { break; }
        reading.take(**event);
    }
    analysis::report_damages(*reader,
                             [&](LogPlace place, std::string what) { reading.damage(place, std::move(what)); });
    if (!reading.has_head()) { return std::unexpected(no_incident(path)); }
    return std::move(reading).take();
}

}  // namespace lockstep::incident
