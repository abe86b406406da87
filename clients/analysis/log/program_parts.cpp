#include "clients/analysis/log/program_parts.hpp"

#include <algorithm>
#include <span>

#include "services/documents/program_document.hpp"

namespace lockstep::analysis {
namespace {

// The first character of a job's program marks it as not text: no text begins with either.
constexpr char kBytes = '\0';  // the rest is Protobuf bytes
constexpr char kLacks = '\1';  // the rest states what is missing

bool begins_with(const std::string& program, char mark) { return !program.empty() && program.front() == mark; }

}  // namespace

std::expected<void, std::string> ProgramParts::take(const program_part_t& part) {
    if (part.job != 0) {
        of_jobs_[{part.coordinator, part.job}] = part.program;
        return {};
    }
    const bool is_part = part.parts > 0 && part.parts <= kMostParts && part.part >= 0 && part.part < part.parts;
    if (!is_part || part.data.empty()) { return std::unexpected(std::string("an impossible part of a program")); }
    auto& place = parts_of(part).data[static_cast<std::size_t>(part.part)];
    if (place.empty()) { ++parts_of(part).came; }
    place.assign(part.data.begin(), part.data.end());
    return {};
}

/// If a program of the same number is complete, or has another length, it is another program.
ProgramParts::Parts& ProgramParts::parts_of(const program_part_t& part) {
    const auto known = std::ranges::find_if(programs_, [&](const Parts& parts) {
        return parts.coordinator == part.coordinator && parts.program == part.program;
    });
    const auto count = static_cast<std::size_t>(part.parts);
    const auto place = static_cast<std::size_t>(part.part);
    if (known != programs_.end() && known->data.size() == count && known->came < count) { return *known; }
    if (known != programs_.end() && known->data.size() == count && !known->data[place].empty() &&
        std::ranges::equal(known->data[place], part.data)) {
        return *known;
    }
    if (known != programs_.end()) { programs_.erase(known); }
    if (programs_.size() == kProgramsKept) { programs_.pop_front(); }
    programs_.push_back({part.coordinator, part.program, {}, 0});
    programs_.back().data.resize(count);
    return programs_.back();
}

void ProgramParts::complete(job_t& job) const {
    const auto known = of_jobs_.find({job.coordinator, job.job});
    if (job.event != "begun" || !job.program.empty() || known == of_jobs_.end()) { return; }
    job.program = program_in_parts(job.coordinator, known->second);
}

std::string ProgramParts::program_in_parts(std::int64_t coordinator, std::int64_t program) const {
    const auto known = std::ranges::find_if(
        programs_, [&](const Parts& parts) { return parts.coordinator == coordinator && parts.program == program; });
    if (known == programs_.end()) { return kLacks + std::string("no part of it is in the log"); }
    if (known->came < known->data.size()) {
        return kLacks + std::to_string(known->data.size() - known->came) + " of its " +
               std::to_string(known->data.size()) + " parts are not in the log";
    }
    std::string bytes(1, kBytes);
    for (const auto& part : known->data) { bytes.append(part.begin(), part.end()); }
    return bytes;
}

bool has_whole_program(const job_t& job) { return !begins_with(job.program, kLacks); }

std::expected<Program, std::string> program_of(const job_t& job) {
    if (!has_whole_program(job)) { return std::unexpected(job.program.substr(1)); }
    if (!begins_with(job.program, kBytes)) { return program_from_text(job.program); }
    const auto* data = reinterpret_cast<const std::uint8_t*>(job.program.data());
    return program_from_bytes({data + 1, job.program.size() - 1});
}

}  // namespace lockstep::analysis
