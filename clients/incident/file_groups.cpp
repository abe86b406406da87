#include "clients/incident/file_groups.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::incident {
namespace {

constexpr double kApart_s = 10;                              // of machine time between two incidents
constexpr std::int64_t kApart_us = 24LL * 3600 * 1'000'000;  // of wall time: machine time restarted between the marks

/// A file, and the machine time of its notes.
struct Stretch {
    const FlightFile* file = nullptr;
    Tick from;
    Tick to;
};

Stretch stretch_of(const FlightFile& file) {
    Stretch stretch{&file, file.head.mark.tick, file.head.mark.tick};
    for (const NumberedEvent& noted : file.events) {
        stretch.from = std::min(stretch.from, noted.event.tick);
        stretch.to = std::max(stretch.to, noted.event.tick);
    }
    return stretch;
}

bool are_near(const Stretch& a, const Stretch& b) {
    const IncidentMark& one = a.file->head.mark;
    const IncidentMark& other = b.file->head.mark;
    const double apart = std::abs(static_cast<double>(one.tick.value) - static_cast<double>(other.tick.value));
    const bool is_soon = apart <= kApart_s * a.file->machine.ticks_per_second();
    const bool overlaps = a.from <= b.to && b.from <= a.to;
    return (is_soon || overlaps) && std::abs(one.wall_us - other.wall_us) <= kApart_us;
}

}  // namespace

std::vector<FileGroup> grouped(const std::vector<FlightFile>& files) {
    std::vector<Stretch> all;
    for (const FlightFile& file : files) { all.push_back(stretch_of(file)); }
    std::ranges::sort(all, {}, [](const Stretch& stretch) { return stretch.file->head.mark.tick; });
    std::vector<std::vector<Stretch>> groups;
    for (const Stretch& stretch : all) {
        const auto has_near = [&](const auto& group) {
            return std::ranges::any_of(group, [&](const Stretch& other) { return are_near(other, stretch); });
        };
        const auto found = std::ranges::find_if(groups, has_near);
        found == groups.end() ? groups.push_back({stretch}) : found->push_back(stretch);
    }
    std::vector<FileGroup> out;
    for (const auto& group : groups) {
        FileGroup& made = out.emplace_back();
        for (const Stretch& stretch : group) { made.push_back(stretch.file); }
    }
    std::ranges::sort(out, {}, [](const FileGroup& group) { return group.front()->head.mark.wall_us; });
    return out;
}

}  // namespace lockstep::incident
