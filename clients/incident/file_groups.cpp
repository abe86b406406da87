#include "clients/incident/file_groups.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::incident {
namespace {

constexpr double kApart_s = 10;                              // of machine time between two incidents
constexpr std::int64_t kApart_us = 24LL * 3600 * 1'000'000;  // of wall time: machine time restarted between the marks

/// A file, and the machine time of its notes.
struct FileSpan {
    const FlightFile* file = nullptr;
    Tick from;
    Tick to;
};

FileSpan span_of(const FlightFile& file) {
    FileSpan span{&file, file.head.mark.tick, file.head.mark.tick};
    for (const NumberedEvent& noted : file.events) {
        span.from = std::min(span.from, noted.event.tick);
        span.to = std::max(span.to, noted.event.tick);
    }
    return span;
}

bool are_near(const FileSpan& a, const FileSpan& b) {
    const IncidentMark& one = a.file->head.mark;
    const IncidentMark& other = b.file->head.mark;
    const double apart = std::abs(static_cast<double>(one.tick.value) - static_cast<double>(other.tick.value));
    const bool is_soon = apart <= kApart_s * a.file->machine.ticks_per_second();
    const bool overlaps = a.from <= b.to && b.from <= a.to;
    return (is_soon || overlaps) && std::abs(one.wall_us - other.wall_us) <= kApart_us;
}

}  // namespace

std::vector<FileGroup> grouped(const std::vector<FlightFile>& files) {
    std::vector<FileSpan> all;
    for (const FlightFile& file : files) { all.push_back(span_of(file)); }
    std::ranges::sort(all, {}, [](const FileSpan& span) { return span.file->head.mark.tick; });
    std::vector<std::vector<FileSpan>> groups;
    for (const FileSpan& span : all) {
        const auto has_near = [&](const auto& group) {
            return std::ranges::any_of(group, [&](const FileSpan& other) { return are_near(other, span); });
        };
        const auto found = std::ranges::find_if(groups, has_near);
        found == groups.end() ? groups.push_back({span}) : found->push_back(span);
    }
    std::vector<FileGroup> out;
    for (const auto& group : groups) {
        FileGroup& made = out.emplace_back();
        for (const FileSpan& span : group) { made.push_back(span.file); }
    }
    std::ranges::sort(out, {}, [](const FileGroup& group) { return group.front()->head.mark.wall_us; });
    return out;
}

}  // namespace lockstep::incident
