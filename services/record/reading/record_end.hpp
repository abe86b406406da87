// Checks whether a record has its end. It compares the last counts that the processes published in their marks with the
// messages received. Sequence numbers show messages missing between others. This check finds messages missing after the
// last one, and processes without any message.
#pragma once

#include <compare>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/record/reading/motor_labels.hpp"
#include "services/record/reading/number_set.hpp"
#include "services/record/reading/recorded_mark.hpp"
#include "services/wire/lcm/lcm_channels.hpp"

namespace lockstep::analysis {

/// The remedy if a log lacks messages. The log's writer may have missed messages that their sender has in its own log.
inline constexpr const char* kWhereTheRestIs =
    "missing messages are in the processes' own logs: lockstep log merge combines them";

/// The name of channel_event_t in sentences about missing messages.
inline constexpr const char* kChannelChanges = "changes of inputs and outputs";

/// `axis` is empty for a coordinator.
struct RecordingProcess {
    std::string machine;
    std::string axis;
    std::int64_t incarnation = 0;
    auto operator<=>(const RecordingProcess&) const = default;
};

/// Messages missing at the end that a process had published by `published_us` of machine time.
struct MissingEnd {
    RecordingProcess process;
    RecordKind kind = RecordKind::Steps;
    Numbers numbers;
    std::int64_t published_us = 0;
};

/// A process without a recorded end. Messages that it published after its last mark may be missing.
struct OpenEnd {
    RecordingProcess process;
    std::optional<std::int64_t> known_us;  // time of that mark; nullopt without a mark, as in logs of earlier versions
};

struct RecordEnd {
    std::vector<MissingEnd> missing;
    std::vector<OpenEnd> open;
    std::vector<RecordingProcess> channels_not_counted;  // axes whose marks do not count channel_event_t
    MotorLabels labels;                                  // for the sentences

    std::int64_t missing_messages() const;
    bool lacks_steps() const;
    /// Whether messages of this kind are missing at the end of an axis's record.
    bool lacks(RecordKind kind, const std::string& machine, const std::string& axis) const;
    /// Whether changes of inputs and outputs are missing at the end of an axis's record, or may be.
    bool may_lack_changes(const std::string& machine, const std::string& axis) const;
    /// Whether all published messages are known to be in the log.
    bool is_closed() const { return missing.empty() && open.empty() && channels_not_counted.empty(); }
};

class RecordEndCheck {
public:
    RecordEndCheck() = default;
    RecordEndCheck(const RecordEndCheck&) = delete;  // last_ points into processes_
    RecordEndCheck& operator=(const RecordEndCheck&) = delete;

    static constexpr std::size_t kMostProcesses = 4096;  // more than any real log contains
    /// Another process may have a message on its disk sooner than the process that published it. In logs that are read
    /// while they are written, a mark by another process therefore counts only when it is this old.
    static constexpr std::int64_t kOnItsWay_us = 1'000'000;
    /// The maximum age of the counts in a mark about another process when the mark is written.
    static constexpr std::int64_t kNoted_us = 300'000;

    /// Notes that a message with this number was read.
    void saw(RecordKind kind, const std::string& machine, const std::string& axis, std::int64_t incarnation,
             std::int64_t sequence);
    void take(const RecordedMark& mark);
    /// Call once, at the end.
    RecordEnd finish();

private:
    static constexpr std::size_t kKinds = 7;
    struct Counted {
        /// For each kind, one more than the highest number read. If none was read, the count in the first mark of this
        /// log, because earlier messages may have been published before the log began. nullopt without such a mark.
        std::optional<std::int64_t> there[kKinds];
        bool is_seen[kKinds]{};
        std::int64_t published[kKinds]{};  // highest count in a mark
        std::int64_t published_us[kKinds]{};
        std::optional<std::int64_t> marked_us;
        std::deque<RecordedMark> others;  // marks about it by other processes, possibly too new to count
        bool ended = false;
        bool counts_channels = false;  // a mark about it does
    };
    void hold_to(const RecordedMark& mark, Counted& counted);
    bool is_of_this_log(const RecordedMark& mark) const;
    Counted* of(const std::string& machine, const std::string& axis, std::int64_t incarnation);

    std::map<RecordingProcess, Counted> processes_;
    std::optional<std::int64_t> first_us_;                               // of the first mark
    std::int64_t newest_us_ = std::numeric_limits<std::int64_t>::min();  // of all marks
    Counted* last_ = nullptr;                                            // process of the previous message
    const RecordingProcess* last_process_ = nullptr;
};

/// A line for each process and kind, "axis X: 3 messages of steps missing at the end (numbers 5 to 7), published by
/// machine time 12.345 s".
std::vector<std::string> missing_sentences(const RecordEnd& end);
/// Says until when the record is known to be complete, for processes without a recorded end, and what marks do not
/// count; empty if there are none.
std::vector<std::string> open_sentences(const RecordEnd& end);

}  // namespace lockstep::analysis
