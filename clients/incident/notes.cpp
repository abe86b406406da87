#include "clients/incident/notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "clients/incident/sentences.hpp"

namespace lockstep::incident {

std::string wall_time(std::int64_t wall_us) {
    const std::time_t seconds = wall_us / 1'000'000;
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    char text[32];
    return std::string(text, std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", &utc));
}

std::vector<std::string> notes_of(const Incident& incident) {
    std::vector<std::string> notes;
    Ticks error;
    for (const Process& process : incident.processes) { error = std::max(error, process.clock_error); }
    if (error > Ticks{}) {
        notes.push_back("times of different processes are comparable within " + duration(2 * incident.seconds(error)));
    }
    if (!incident.absent.empty()) { notes.push_back(fmt::format("no file of: {}", fmt::join(incident.absent, ", "))); }
    for (const std::string& unread : incident.unread) { notes.push_back("not read: " + unread); }
    return notes;
}

}  // namespace lockstep::incident
