#include "services/flight/incident_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "services/documents/machine_file.hpp"
#include "services/files/unfinished_file.hpp"
#include "services/record/own_log.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/lcm_log.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnd = ".flight.lcm";

/// Returns a stamp such as "20261121T094512.123Z", so that names sort by time.
std::string stamp(std::int64_t wall_us) {
    const std::time_t seconds = wall_us / 1'000'000;
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    char text[32];
    const std::size_t length = std::strftime(text, sizeof text, "%Y%m%dT%H%M%S", &utc);
    return fmt::format("{}.{:03}Z", std::string_view(text, length), wall_us / 1000 % 1000);
}

/// The name is STAMP-PROCESS-INCARNATION, so a coordinator and its standby get different names.
fs::path file_for(const FlightSource& source, const IncidentMark& mark) {
    return source.directory /
           fmt::format("{}-{}-{}{}", stamp(mark.wall_us), source.process, source.incarnation % 100'000, kEnd);
}

bool is_of(const fs::path& file, const std::string& process) {
    const std::string name = file.filename().string();
    const std::size_t from = name.find('-');
    return from != name.npos && name.substr(from + 1).starts_with(process + "-");
}

void remove_oldest(const FlightSource& source) {
    auto files = incident_files(source.directory);
    std::erase_if(files, [&](const fs::path& file) { return !is_of(file, source.process); });
    const auto most = static_cast<std::size_t>(std::max(1, source.files));
    for (std::size_t i = 0; i + most < files.size(); ++i) {
        std::error_code ignored;
        fs::remove(files[i], ignored);
    }
}

bool write_events(const FlightSnapshot& snapshot, const IncidentMark& mark, LogWriter& log) {
    const FlightSource& source = snapshot.source;
    const MachineSetup machine = parse_machine(source.config).value_or(MachineSetup{{.tick_ns = source.tick_ns}});
    const std::string channel = flight_channel(source.machine, source.process);
    const Ticks before{static_cast<std::int64_t>(machine.ticks_per_second()) * kFlightSeconds};
    bool written = log.write_message(channel, utime_of(mark.tick, source.tick_ns), to_lcm(source, mark));
    if (!snapshot.note.empty()) {
        written &= log.write_message(channel, utime_of(mark.tick, source.tick_ns), to_lcm(source, mark, snapshot.note));
    }
    for (const NumberedEvent& event : snapshot.events) {
        if (event.event.tick + before < mark.tick) { continue; }
        written &=
            log.write_message(channel, utime_of(event.event.tick, source.tick_ns), to_lcm(source, machine, event));
    }
    return written && log.flush();
}

}  // namespace

std::optional<NumberedEvent> first_incident(std::span<const NumberedEvent> events, std::uint64_t after) {
    const auto found = std::ranges::find_if(events, [&](const NumberedEvent& event) {
        return event.number > after && event.event.kind == FlightKind::Incident;
    });
    return found == events.end() ? std::nullopt : std::optional(*found);
}

std::expected<fs::path, std::string> write_incident(const FlightSnapshot& snapshot, const IncidentMark& mark) {
    const FlightSource& source = snapshot.source;
    std::error_code error;
    fs::create_directories(source.directory, error);
    if (error) {
        return std::unexpected(
            fmt::format("cannot create {}: {}; set record {{ directory }} to a directory that can be written",
                        source.directory.string(), error.message()));
    }
    UnfinishedFile file(file_for(source, mark));
    auto log = LogWriter::open(file.unfinished());
    if (!log) { return std::unexpected(log.error()); }
    if (!write_events(snapshot, mark, *log)) {
        return std::unexpected(file.path().string() + ": cannot be written completely; check whether the disk is full");
    }
    if (const auto kept = file.keep(); !kept) { return std::unexpected(kept.error()); }
    remove_oldest(source);
    return file.path();
}

std::vector<fs::path> incident_files(const fs::path& directory) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(directory, error)) {
        if (entry.path().filename().string().ends_with(kEnd)) { files.push_back(entry.path()); }
    }
    std::ranges::sort(files);
    return files;
}

fs::path incident_directory(const MachineSetup& machine) { return own_log_directory(machine) / "incidents"; }

std::int64_t wall_clock_us() {
    return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

}  // namespace lockstep
