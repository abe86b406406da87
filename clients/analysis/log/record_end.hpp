// Checks whether a record has its end: compares the last counts that its processes published, in their marks, with the
// messages received. Sequence numbers show messages missing between others; this finds those missing after the last
// one, and processes without any message.
#pragma once

#include <compare>
#include <cstdint>
#include <deque>
#include <limits>
#include <lockstep/record_mark_t.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/analysis/log/number_set.hpp"
#include "services/wire/lcm/lcm_channels.hpp"

namespace lockstep::analysis {

/// `axis` is empty for a coordinator.
struct RecordingProcess {
    std::string machine;
    std::string axis;
    std::int64_t incarnation = 0;
    auto operator<=>(const RecordingProcess&) const = default;
};

/// Messages that a process had published by then, in microseconds of machine time, and that are missing at the end.
struct MissingEnd {
    RecordingProcess process;
    RecordKind kind = RecordKind::Steps;
    Numbers numbers;
    std::int64_t published_us = 0;
};

/// A process whose end was not recorded: messages that it published after its last mark may be missing.
struct OpenEnd {
    RecordingProcess process;
    std::optional<std::int64_t> known_us;  // of that mark; none: there is none, as in logs of earlier versions
};

struct RecordEnd {
    std::vector<MissingEnd> missing;
    std::vector<OpenEnd> open;

    std::int64_t missing_messages() const;
    bool lacks_steps() const;
    /// All published messages are known to be in the log.
    bool is_closed() const { return missing.empty() && open.empty(); }
};

class RecordEndCheck {
public:
    RecordEndCheck() = default;
    RecordEndCheck(const RecordEndCheck&) = delete;  // it points into itself
    RecordEndCheck& operator=(const RecordEndCheck&) = delete;

    static constexpr std::size_t kMostProcesses = 4096;  // more than any real log contains
    /// One process's message may be on another's disk sooner than on its own. So in logs that are read while they are
    /// written, the newest marks of other processes prove nothing yet.
    static constexpr std::int64_t kOnItsWay_us = 1'000'000;
    /// The maximum age of a mark about another process when it is written.
    static constexpr std::int64_t kNoted_us = 300'000;

    /// A message with its number was read.
    void saw(RecordKind kind, const std::string& machine, const std::string& axis, std::int64_t incarnation,
             std::int64_t sequence);
    void take(const record_mark_t& mark);
    /// Call once, at the end.
    RecordEnd finish();

private:
    static constexpr std::size_t kKinds = 6;
    struct Counted {
        /// One more than the highest number read, of each kind. None read: after those that may have been published
        /// before the log began; nothing without a mark.
        std::optional<std::int64_t> there[kKinds];
        bool is_seen[kKinds]{};
        std::int64_t published[kKinds]{};  // by the highest mark
        std::int64_t published_us[kKinds]{};
        std::optional<std::int64_t> marked_us;
        std::deque<record_mark_t> others;  // marks of it by other processes that may be too new
        bool ended = false;
    };
    void hold_to(const record_mark_t& mark, Counted& counted);
    bool is_of_this_log(const record_mark_t& mark) const;
    Counted* of(const std::string& machine, const std::string& axis, std::int64_t incarnation);

    std::map<RecordingProcess, Counted> processes_;
    std::optional<std::int64_t> first_us_;                               // of the first mark
    std::int64_t newest_us_ = std::numeric_limits<std::int64_t>::min();  // of all marks
    Counted* last_ = nullptr;                                            // messages of one process come together
    const RecordingProcess* last_process_ = nullptr;
};

/// "X: 3 messages of steps (numbers 5 to 7), published by machine time 12.345 s": a line for each process and kind, and
/// the remedy.
std::vector<std::string> missing_sentences(const RecordEnd& end);
/// Up to when the record is known to be complete, if no process is known to lack a message; empty: to its end.
std::vector<std::string> open_sentences(const RecordEnd& end);

}  // namespace lockstep::analysis
