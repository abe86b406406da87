#include "clients/merge/log_merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "clients/merge/job_program.hpp"
#include "clients/merge/written_lately.hpp"

namespace lockstep::merge {
namespace {

constexpr std::uint64_t kMessagesPerProgress = 4096;
constexpr std::int64_t kWindowsRemembered = 4;

using Failure = std::unexpected<std::string>;

class Merger {
public:
    Merger(const MergeOptions& options, RecordSink& to)
        : options_(options),
          to_(to),
          missing_(options.span.from_us.has_value()),
          program_(options.span.program),
          lately_(options.window_us * kWindowsRemembered) {}

    std::expected<void, std::string> open() {
        for (const auto& path : options_.logs) {
            auto input = MergeInput::open(path);
            if (!input) { return Failure(input.error()); }
            merged_.inputs.push_back({.log = path});
            inputs_.push_back(std::move(*input));
        }
        const auto holds_something = [](const MergeInput& input) { return input.begins_utime().has_value(); };
        if (std::ranges::any_of(inputs_, holds_something)) {
            sort_waiting();
            return {};
        }
        return Failure(fmt::format("no message of a record in {}{}; check that they are LCM logs of a machine",
                                   options_.logs.front().string(),
                                   (options_.logs.size() > 1 ? " and the others" : "")));
    }

    std::expected<void, std::string> run() {
        while (true) {
            if (const auto begun = begin_due(); !begun) { return begun; }
            const std::size_t next = lowest();
            if (next == inputs_.size()) { return {}; }
            const HeldMessage message = inputs_[next].take();
            if (const auto filled = fill(next); !filled) { return filled; }
            write(next, message);
            if (options_.progress && ++steps_ % kMessagesPerProgress == 0) { options_.progress(share_read()); }
        }
    }

    Merged finish() {
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            merged_.inputs[i].messages = inputs_[i].messages();
            merged_.inputs[i].damages = inputs_[i].damages();
        }
        merged_.axes = missing_.finish();
        merged_.missing_job_events = missing_.missing_of_jobs(RecordKind::Job);
        merged_.missing_program_parts = std::max(missing_.missing_of_jobs(RecordKind::ProgramPart), program_.missing());
        merged_.absent_axes = missing_.absent_axes();
        merged_.end = missing_.end();
        return std::move(merged_);
    }

private:
    /// Opens a log only when the merge reaches its beginning. Of a log split into many files, few are open at a time.
    std::expected<void, std::string> begin_due() {
        while (!waiting_.empty()) {
            const std::size_t first = lowest();
            const bool is_due = first == inputs_.size() ||
                                begins(waiting_.back()) <= inputs_[first].front()->id.utime + options_.window_us;
            if (!is_due) { return {}; }
            if (const auto filled = fill(waiting_.back()); !filled) { return filled; }
            waiting_.pop_back();
        }
        return {};
    }

    void sort_waiting() {
        for (std::size_t i = 0; i < inputs_.size(); ++i) { waiting_.push_back(i); }
        std::ranges::sort(waiting_, std::greater{}, [this](std::size_t i) { return begins(i); });
    }

    std::expected<void, std::string> fill(std::size_t i) {
        std::uint64_t others = 0;
        for (const MergeInput& input : inputs_) { others += &input == &inputs_[i] ? 0 : input.bytes_held(); }
        return inputs_[i].fill(options_.window_us, kMostBytesHeld - std::min(kMostBytesHeld, others));
    }

    /// A log without messages of the record is opened first, so that its errors are reported.
    std::int64_t begins(std::size_t i) const {
        return inputs_[i].begins_utime().value_or(std::numeric_limits<std::int64_t>::min());
    }

    /// Returns the input with the earliest next message, or the number of inputs if none has a message left.
    std::size_t lowest() const {
        std::size_t lowest = inputs_.size();
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            const HeldMessage* front = inputs_[i].front();
            if (front != nullptr && (lowest == inputs_.size() || front->id < inputs_[lowest].front()->id)) {
                lowest = i;
            }
        }
        return lowest;
    }

    bool is_wanted(std::int64_t utime) const {
        return (!options_.span.from_us || utime >= *options_.span.from_us) &&
               (!options_.span.until_us || utime < *options_.span.until_us);
    }

    void write(std::size_t from, const HeldMessage& message) {
        const bool is_part_of_program = program_.takes(message);
        if (!is_wanted(message.id.utime)) {
            if (is_part_of_program && is_before(message)) { pass_on(from, message); }
            return;
        }
        if (!message.is_foreign && !is_new(message)) { return; }
        missing_.take(message.id, message.data);
        pass_on(from, message);
    }

    /// From before the span only parts of the program are written. Other messages there do not count as missing.
    bool is_before(const HeldMessage& message) const { return message.id.utime < options_.span.from_us; }

    void pass_on(std::size_t from, const HeldMessage& message) {
        merged_.late += message.id.utime < written_utime_ ? 1 : 0;
        written_utime_ = std::max(written_utime_, message.id.utime);
        to_.write(message.id.channel, message.id.utime, message.data);
        merged_.foreign += message.is_foreign ? 1 : 0;
        ++merged_.messages;
        ++merged_.inputs[from].kept;
    }

    bool is_new(const HeldMessage& message) {
        const bool is_new_number = missing_.is_new(message.id);
        const bool is_new_content = lately_.add(message);
        const bool is_new = message.id.number ? is_new_number : is_new_content;
        merged_.duplicates += is_new ? 0 : 1;
        const bool is_remembered = message.id.utime > written_utime_ - options_.window_us * kWindowsRemembered;
        merged_.differing += !is_new && is_new_content && is_remembered ? 1 : 0;
        return is_new;
    }

    double share_read() const {
        double read = 0;
        double all = 1;
        for (const MergeInput& input : inputs_) {
            read += static_cast<double>(input.bytes_read());
            all += static_cast<double>(input.file_bytes());
        }
        return read / all;
    }

    const MergeOptions& options_;
    RecordSink& to_;
    std::vector<MergeInput> inputs_;
    std::vector<std::size_t> waiting_;  // inputs not opened yet, the earliest last
    MissingWatch missing_;
    JobProgram program_;
    WrittenLately lately_;
    Merged merged_;
    std::int64_t written_utime_ = std::numeric_limits<std::int64_t>::min();
    std::uint64_t steps_ = 0;
};

}  // namespace

bool Merged::lacks_messages() const {
    return missing_job_events != 0 || missing_program_parts != 0 || !end.missing.empty() || !absent_axes.empty() ||
           std::ranges::any_of(axes, [](const AxisRecord& axis) {
               return axis.missing_messages() != 0 || axis.changes_lost_by_device != 0;
           });
}

bool Merged::contradicts() const {
    return differing > 0 ||
           std::ranges::any_of(axes, [](const AxisRecord& axis) { return !axis.contradictions.empty(); });
}

std::expected<Merged, std::string> merge_logs(const MergeOptions& options, RecordSink& to) {
    Merger merger(options, to);
    if (const auto opened = merger.open(); !opened) { return Failure(opened.error()); }
    if (const auto run = merger.run(); !run) { return Failure(run.error()); }
    return merger.finish();
}

}  // namespace lockstep::merge
