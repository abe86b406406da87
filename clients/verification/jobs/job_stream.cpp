#include "clients/verification/jobs/job_stream.hpp"

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

namespace lockstep::verification {
namespace {

std::int64_t coordinator_of(const JobRecord& record) {
    return std::visit([](const auto& of) { return of.coordinator; }, record);
}
std::int64_t sequence_of(const JobRecord& record) {
    return std::visit([](const auto& of) { return of.sequence; }, record);
}
std::int64_t time_of(const JobRecord& record) {
    return std::visit([](const auto& of) { return of.utime; }, record);
}

/// Of the message as it is encoded.
std::size_t content_of(const JobRecord& record) {
    return std::visit(
        [](const auto& of) {
            std::vector<char> bytes(static_cast<std::size_t>(of.getEncodedSize()));
            (void)of.encode(bytes.data(), 0, static_cast<unsigned>(bytes.size()));
            return std::hash<std::string_view>{}({bytes.data(), bytes.size()});
        },
        record);
}

}  // namespace

void JobStream::take(JobRecord record) {
    const std::pair number{coordinator_of(record), sequence_of(record)};
    const std::size_t content = content_of(record);
    if (const auto before = contents_.find(number)) {
        if (*before != content) { on_other_(record); }
        return;
    }
    contents_.add(number, content);
    Coordinator& of = coordinators_[number.first];
    if (number.second < of.expected) { return; }  // it was given up as missing
    of.waiting.emplace(number.second, std::move(record));
    ++waiting_;
    deliver(of, kPatience, std::nullopt);
}

void JobStream::pass(std::int64_t utime) {
    if (waiting_ == 0) { return; }
    for (auto& [name, of] : coordinators_) { deliver(of, kPatience, utime); }
}

void JobStream::finish() {
    for (auto& [name, of] : coordinators_) { deliver(of, 0, std::nullopt); }
}

void JobStream::deliver(Coordinator& of, std::size_t patience, std::optional<std::int64_t> newest_us) {
    while (!of.waiting.empty()) {
        const auto first = of.waiting.begin();
        const bool begins_late = !of.has_begun && first->first > kShuffled;
        const bool is_next = first->first == of.expected || begins_late;
        const bool is_old = newest_us && time_of(first->second) < *newest_us - kPatience_us;
        const std::size_t enough = of.has_begun ? patience : std::min<std::size_t>(patience, kShuffled);
        if (!is_next && of.waiting.size() <= enough && !is_old) { return; }
        of.expected = first->first + 1;
        --waiting_;
        const bool is_behind_gap = std::exchange(of.has_begun, true) && !is_next;
        on_record_(of.waiting.extract(first).mapped(), is_behind_gap);
    }
}

}  // namespace lockstep::verification
