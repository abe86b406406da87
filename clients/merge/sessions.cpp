#include "clients/merge/sessions.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "services/record/reading/job_of.hpp"
#include "services/record/reading/record_end.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/lcm_decode.hpp"
#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep::merge {
namespace {

namespace fs = std::filesystem;
using analysis::RecordingProcess;

/// The processes and jobs in a log.
struct Contents {
    std::set<RecordingProcess> processes;
    std::vector<job_t> jobs;               // beginnings and ends, without their documents
    std::vector<program_part_t> in_parts;  // which jobs run programs recorded in parts
};

void take_job(const LogEvent& event, Contents& contents) {
    auto job = decode_lcm<job_t>(event.data);
    if (!job || (job->event != "begun" && job->event != "ended")) { return; }
    job->program.clear();
    job->config.clear();
    contents.jobs.push_back(std::move(*job));
}

void take_part(const LogEvent& event, Contents& contents) {
    auto part = decode_lcm<program_part_t>(event.data);
    if (part && part->job != 0) { contents.in_parts.push_back(std::move(*part)); }
}

std::expected<Contents, std::string> contents_of(const fs::path& path) {
    auto reader = LogReader::open(path);
    if (!reader) { return std::unexpected(reader.error()); }
    Contents contents;
    while (true) {
        const auto event = reader->next();
        if (!event) { return std::unexpected(event.error()); }
        if (!*event) { return contents; }
        if (kind_of((*event)->channel) == RecordKind::Job) { take_job(**event, contents); }
        if (kind_of((*event)->channel) == RecordKind::ProgramPart) { take_part(**event, contents); }
        if (kind_of((*event)->channel) != RecordKind::Mark) { continue; }
        if (const auto mark = analysis::decode_mark((*event)->data)) {
            contents.processes.insert({mark->machine, mark->process, mark->incarnation});
        }
    }
}

/// Returns the session of each log, as the index of the session's first log.
std::vector<std::size_t> sessions_of(const std::vector<Contents>& logs) {
    std::vector<std::size_t> parent(logs.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t log) {
        while (parent[log] != log) { log = parent[log]; }
        return log;
    };
    std::map<RecordingProcess, std::size_t> known;
    for (std::size_t i = 0; i < logs.size(); ++i) {
        for (const RecordingProcess& process : logs[i].processes) {
            const std::size_t other = root(known.try_emplace(process, i).first->second);
            const std::size_t mine = root(i);
            parent[std::max(mine, other)] = std::min(mine, other);
        }
    }
    for (std::size_t i = 0; i < logs.size(); ++i) { parent[i] = root(i); }
    return parent;
}

std::size_t newest_of(const std::vector<GivenLog>& given, const std::vector<Contents>& contents) {
    std::size_t newest = given.size();
    fs::file_time_type written;
    for (std::size_t i = 0; i < given.size(); ++i) {
        std::error_code error;
        const auto time = fs::last_write_time(given[i].path, error);
        if (contents[i].processes.empty() || (newest != given.size() && time <= written)) { continue; }
        newest = i;
        written = time;
    }
    return newest;
}

std::vector<JobSpan> spans_of(std::vector<job_t> events) {
    std::ranges::stable_sort(events, {}, &job_t::utime);
    std::vector<JobSpan> spans;
    for (const job_t& event : events) {
        JobSpan* its = analysis::job_of(spans, event);  // several logs may contain the same job
        const bool begins = event.event == "begun";
        if (begins && its == nullptr) { spans.push_back({event.job, event.utime, {}, event.coordinator, {}}); }
        if (!begins && its != nullptr && !its->ended_us) { its->ended_us = event.utime; }
    }
    return spans;
}

void note_programs(const Contents& log, std::vector<JobSpan>& spans) {
    for (const program_part_t& part : log.in_parts) {
        for (JobSpan& span : spans) {
            if (span.job == part.job && span.coordinator == part.coordinator) { span.program = part.program; }
        }
    }
}

}  // namespace

std::expected<ChosenLogs, std::string> choose_logs(const std::vector<GivenLog>& given, bool all) {
    std::vector<Contents> contents;
    for (const GivenLog& log : given) {
        auto found = contents_of(log.path);
        if (!found) { return std::unexpected(found.error()); }
        contents.push_back(std::move(*found));
    }
    const std::vector<std::size_t> sessions = sessions_of(contents);
    std::set<std::size_t> wanted;
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (given[i].is_named && !contents[i].processes.empty()) { wanted.insert(sessions[i]); }
    }
    const std::size_t newest = newest_of(given, contents);
    if (wanted.empty() && newest < given.size()) { wanted.insert(sessions[newest]); }
    ChosenLogs chosen;
    std::vector<job_t> jobs;
    std::set<std::size_t> left_out;
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (all || given[i].is_named || contents[i].processes.empty() || wanted.contains(sessions[i])) {
            chosen.logs.push_back(given[i].path);
            jobs.insert(jobs.end(), contents[i].jobs.begin(), contents[i].jobs.end());
        } else {
            chosen.left_out.push_back(given[i].path);
            left_out.insert(sessions[i]);
        }
    }
    chosen.sessions_left_out = static_cast<std::int64_t>(left_out.size());
    chosen.jobs = spans_of(std::move(jobs));
    for (const Contents& log : contents) { note_programs(log, chosen.jobs); }
    return chosen;
}

std::optional<TimeSpan> span_of_job(const std::vector<JobSpan>& jobs, std::int64_t job) {
    const auto found = std::ranges::find(jobs.rbegin(), jobs.rend(), job, &JobSpan::job);
    if (found == jobs.rend()) { return std::nullopt; }
    constexpr std::int64_t kBefore_us = 20'000;
    constexpr std::int64_t kBehind_us = 500'000;  // steps are published within 0.1 s
    TimeSpan span{.from_us = found->begun_us - kBefore_us, .until_us = {}, .program = {}};
    if (found->ended_us) { span.until_us = *found->ended_us + kBehind_us; }
    if (found->program) { span.program = {found->coordinator, *found->program}; }
    if (const auto before = found + 1; before != jobs.rend()) {
        span.from_us = std::max(*span.from_us, before->ended_us.value_or(before->begun_us) + 1);
    }
    if (found != jobs.rbegin()) {
        const std::int64_t next_us = (found - 1)->begun_us;
        span.until_us = std::min(span.until_us.value_or(next_us), next_us);
    }
    return span;
}

}  // namespace lockstep::merge
