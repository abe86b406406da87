// Finds the job that a record belongs to.
#pragma once

#include <algorithm>
#include <cstdint>
#include <lockstep/job_t.hpp>
#include <optional>
#include <vector>

namespace lockstep::analysis {

/// The newest job of a list with the record's coordinator and number. After a takeover another coordinator continues a
/// job: then the newest one with that number that has begun and not ended. Null if there is none.
///
/// A job has `coordinator`, `job` (its number), `begun_us` and `ended_us` (optional).
template <typename Job>
Job* job_of(std::vector<Job>& jobs, const job_t& record) {
    const auto has_number = [&](const Job& job) { return static_cast<std::int64_t>(job.job) == record.job; };
    const auto is_it = [&](const Job& job) { return has_number(job) && job.coordinator == record.coordinator; };
    const auto is_open = [&](const Job& job) {
        return has_number(job) && std::optional<std::int64_t>(job.begun_us) && !job.ended_us;
    };
    auto found = std::ranges::find_if(jobs.rbegin(), jobs.rend(), is_it);
    if (found == jobs.rend() && record.event != "begun") {
        found = std::ranges::find_if(jobs.rbegin(), jobs.rend(), is_open);
    }
    return found == jobs.rend() ? nullptr : &*found;
}

}  // namespace lockstep::analysis
