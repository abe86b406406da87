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
    const bool is_last = part.parts > 0 && part.part + 1 == part.parts;
    const bool is_part = part.parts >= 0 && part.parts <= kMostParts && part.part >= 0 && part.part < kMostParts &&
                         (part.parts == 0 || part.part < part.parts);
    if (!is_part || (part.data.empty() && !is_last)) {
        return std::unexpected(std::string("an impossible part of a program"));
    }
    Parts& parts = parts_of(part);
    const auto place = static_cast<std::size_t>(part.part);
    parts.count = std::max(parts.count, static_cast<std::size_t>(part.parts));
    if (parts.data.size() <= place) { parts.data.resize(place + 1); }
    parts.data[place].emplace(part.data.begin(), part.data.end());
    return {};
}

/// A part that is another one in the same place is of another program.
bool ProgramParts::Parts::fits(const program_part_t& part) const {
    const auto place = static_cast<std::size_t>(part.part);
    const auto parts = static_cast<std::size_t>(part.parts);
    if (count > 0 && (place >= count || (parts > 0 && parts != count))) { return false; }
    if (parts > 0 && data.size() > parts) { return false; }
    return place >= data.size() || !data[place] || std::ranges::equal(*data[place], part.data);
}

std::size_t ProgramParts::Parts::missing() const {
    const auto came = static_cast<std::size_t>(std::ranges::count_if(data, [](const auto& part) { return !!part; }));
    return std::max(count, data.size()) - came;
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

/// One that does not fit is of a later program of the same number.
void ProgramParts::take_later(const program_part_t& part, const job_t& job) {
    if (part.job != 0 || part.program != of_jobs_.at({job.coordinator, job.job})) { return; }
    const Parts* parts = find(job.coordinator, part.program);
    program_part_t its = part;
    its.coordinator = job.coordinator;
    if (parts == nullptr || parts->fits(its)) { (void)take(its); }
}

void ProgramParts::complete(job_t& job) const {
    const auto known = of_jobs_.find({job.coordinator, job.job});
    if (job.event != "begun" || !job.program.empty() || known == of_jobs_.end()) { return; }
    job.program = program_in_parts(job.coordinator, known->second);
}

/// Without a last part the program ends with the parts that are known: no more of it was run.
std::string ProgramParts::program_in_parts(std::int64_t coordinator, std::int64_t program) const {
    const Parts* known = find(coordinator, program);
    if (known == nullptr) { return kLacks + std::string("no part of it is in the log"); }
    if (const std::size_t missing = known->missing(); missing > 0) {
        return kLacks + std::to_string(missing) + " of its " +
               std::to_string(std::max(known->count, known->data.size())) + " parts are not in the log";
    }
    std::string bytes(1, kBytes);
    for (const auto& part : known->data) { bytes.append(part->begin(), part->end()); }
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
