#include "services/record/reading/program_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>

#include "services/documents/program_document.hpp"

namespace lockstep::analysis {
std::expected<void, std::string> ProgramParts::take(const program_part_t& part, std::uint64_t offset) {
    if (part.job != 0) {
        of_jobs_[{part.coordinator, part.job}] = part.program;
        return {};
    }
    const bool is_last = part.parts > 0 && part.part + 1 == part.parts;
    const bool is_part = part.parts >= 0 && part.parts <= kMostParts && part.part >= 0 && part.part < kMostParts &&
                         (part.parts == 0 || part.part < part.parts);
    if (!is_part || (part.data.empty() && !is_last)) {
        return std::unexpected(std::string("a part of a program with impossible numbers"));
    }
    Parts& parts = parts_of(part);
    const auto place = static_cast<std::size_t>(part.part);
    parts.count = std::max(parts.count, static_cast<std::size_t>(part.parts));
    if (parts.places.size() <= place) { parts.places.resize(place + 1); }
    parts.places[place] = place_of(part, offset);
    return {};
}

ProgramParts::Place ProgramParts::place_of(const program_part_t& part, std::uint64_t offset) {
    const std::string_view content(reinterpret_cast<const char*>(part.data.data()), part.data.size());
    return {.offset = offset, .bytes = content.size(), .hash = std::hash<std::string_view>{}(content)};
}

/// Whether the part can belong to this program. It cannot if another part with other content has the same place.
bool ProgramParts::Parts::fits(const program_part_t& part) const {
    const auto place = static_cast<std::size_t>(part.part);
    const auto parts = static_cast<std::size_t>(part.parts);
    if (count > 0 && (place >= count || (parts > 0 && parts != count))) { return false; }
    if (parts > 0 && places.size() > parts) { return false; }
    return place >= places.size() || !places[place] || places[place]->has_same_content(place_of(part, 0));
}

std::size_t ProgramParts::Parts::missing() const {
    const auto came = static_cast<std::size_t>(std::ranges::count_if(places, [](const auto& part) { return !!part; }));
    return std::max(count, places.size()) - came;
}

const ProgramParts::Parts* ProgramParts::find(std::int64_t coordinator, std::int64_t program) const {
    const auto known = std::ranges::find_if(
        programs_, [&](const Parts& parts) { return parts.coordinator == coordinator && parts.program == program; });
    return known == programs_.end() ? nullptr : &*known;
}

ProgramParts::Parts& ProgramParts::parts_of(const program_part_t& part) {
    const auto known = std::ranges::find_if(programs_, [&](const Parts& parts) {
        return parts.coordinator == part.coordinator && parts.program == part.program;
    });
    if (known != programs_.end() && known->fits(part)) { return *known; }
    if (known != programs_.end()) { programs_.erase(known); }
    if (programs_.size() == kProgramsKept) { programs_.pop_front(); }
    programs_.push_back({part.coordinator, part.program, {}, 0});
    return programs_.back();
}

bool ProgramParts::is_open(const job_t& job) const {
    const auto known = of_jobs_.find({job.coordinator, job.job});
    if (job.event != "begun" || !job.program.empty() || known == of_jobs_.end()) { return false; }
    const Parts* parts = find(job.coordinator, known->second);
    return parts == nullptr || parts->count == 0;
}

/// A part that does not fit belongs to a later program of the same number.
void ProgramParts::take_later(const program_part_t& part, std::uint64_t offset, const job_t& job) {
    if (part.job != 0 || part.program != of_jobs_.at({job.coordinator, job.job})) { return; }
    const Parts* parts = find(job.coordinator, part.program);
    program_part_t its = part;
    its.coordinator = job.coordinator;
    if (parts == nullptr || parts->fits(its)) { (void)take(its, offset); }
}

/// If the last part is missing, the program ends with the known parts, because no more of it was run.
void ProgramParts::complete(RecordedJob& job) const {
    const auto known = of_jobs_.find({job.coordinator, job.job});
    if (job.event != "begun" || !job.program.empty() || known == of_jobs_.end()) { return; }
    const Parts* parts = find(job.coordinator, known->second);
    if (parts == nullptr) {
        job.lacks = "no part of it is in the log";
    } else if (const std::size_t missing = parts->missing(); missing > 0) {
        job.lacks =
            fmt::format("{} of its {} parts are not in the log", missing, std::max(parts->count, parts->places.size()));
    } else {
        job.parts = ProgramPlaces{.log = log_, .offsets = {}};
        for (const auto& place : parts->places) { job.parts->offsets.push_back(place->offset); }
    }
}

std::expected<std::shared_ptr<const RecordedProgram>, std::string> RecordedJob::read_program() const {
    if (!lacks.empty()) { return std::unexpected(lacks); }
    if (parts) { return RecordedProgram::open(*parts); }
    auto read = program_from_text(program);
    if (!read) { return std::unexpected(read.error()); }
    return std::make_shared<const RecordedProgram>(std::move(*read));
}

}  // namespace lockstep::analysis
