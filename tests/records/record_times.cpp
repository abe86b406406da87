#include "tests/records/record_times.hpp"

#include <algorithm>
#include <stdexcept>

namespace lockstep::records {

std::vector<RecordedSpan> job_spans(const Record& record) {
    std::vector<RecordedSpan> spans;
    for (const Message& message : record) {
        const auto job = decoded<job_t>(message);
        if (!job) { continue; }
        if (job->event == "begun") { spans.push_back({job->job, job->kind, job->utime, record.back().utime}); }
        const auto span = std::ranges::find(spans, job->job, &RecordedSpan::job);
        if (job->event == "ended" && span != spans.end()) { span->end_us = job->utime; }
    }
    return spans;
}

RecordedSpan first_span(const Record& record, const std::string& kind) {
    for (const RecordedSpan& span : job_spans(record)) {
        if (span.kind == kind) { return span; }
    }
    throw std::runtime_error("the record has no job of kind " + kind);
}

}  // namespace lockstep::records
