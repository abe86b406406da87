// Finds the messages that a record lacks, by gaps in their sequence numbers, while the record is merged.
#pragma once

#include <cstdint>
#include <lockstep/step_batch_t.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "clients/merge/channel_gaps.hpp"
#include "clients/merge/message_id.hpp"
#include "services/record/reading/number_set.hpp"
#include "services/record/reading/record_end.hpp"
#include "services/record/reading/step_stream.hpp"
#include "services/wire/lcm/lcm_channels.hpp"

namespace lockstep::merge {

/// Steps that no log contains. The last step before them is at from_tick and leads to from_step. The first step after
/// them is at to_tick and starts at to_step. Ticks of machine time; steps in machine coordinates. from_* are nullopt if
/// the log lacks the axis's first steps.
struct MissingSteps {
    std::string axis;
    std::int64_t messages = 0;
    std::optional<std::int64_t> from_step;
    std::optional<Tick> from_tick;
    std::optional<std::int64_t> to_step;
    std::optional<Tick> to_tick;
};

/// Frames and tails that no log contains.
struct MissingRuns {
    std::string axis;
    std::int64_t incarnation = 0;  // of the axis's process
    analysis::Numbers numbers;
};

/// The record of one axis.
struct AxisRecord {
    std::string machine;
    std::string axis;
    std::int64_t steps = 0;
    std::int64_t step_messages = 0;
    std::int64_t runs = 0;
    std::vector<MissingSteps> missing_steps;      // the first kListed
    std::vector<MissingRuns> missing_runs;        // the first kListed
    std::vector<MissingChanges> missing_changes;  // of inputs and outputs, the first kListed
    std::vector<std::string> contradictions;      // messages of steps that contradict the others, the first kListed
    std::int64_t missing_step_messages = 0;
    std::int64_t missing_run_messages = 0;
    std::int64_t missing_positions = 0;  // messages, between the first and the last: a log may begin later
    std::int64_t missing_figures = 0;
    std::int64_t missing_channel_messages = 0;
    std::int64_t changes_lost_by_device = 0;  // the device could not keep them until they were read

    std::int64_t missing_messages() const {
        return missing_step_messages + missing_run_messages + missing_positions + missing_figures +
               missing_channel_messages;
    }
};

class MissingWatch {
public:
    static constexpr std::size_t kListed = 1000;  // per axis; the counts include the rest

    /// If `begins_late`, messages before the first one of a process do not count as missing.
    explicit MissingWatch(bool begins_late);
    ~MissingWatch();

    /// Returns true if the message is new or has no number. Messages of a channel must come nearly in order.
    bool is_new(const MessageId& id);
    /// Call it with each new message.
    void take(const MessageId& id, const std::vector<std::uint8_t>& data);
    /// Returns the record of each axis. Call it once, at the end.
    std::vector<AxisRecord> finish();
    /// Number of job events or program parts (`kind`) missing between the first and the last of each coordinator.
    std::int64_t missing_of_jobs(RecordKind kind) const;
    /// Axes without any message that the recorded machine has, or that a mark names.
    std::vector<std::string> absent_axes() const;
    /// Call once, at the end.
    analysis::RecordEnd end();

private:
    class Axis;
    Axis& axis(const std::string& machine, const std::string& name);

    using Whose = std::pair<std::string, std::int64_t>;  // channel and incarnation
    static Whose whose(const MessageId& id);

    bool begins_late_;
    void note_steps(const step_batch_t& message);
    void note_machine(const std::vector<std::uint8_t>& data);
    void note_missing_runs(const Whose& whose, AxisRecord& record) const;
    void note_missing_changes(const Whose& whose, AxisRecord& record) const;

    std::map<Whose, analysis::NumberSet> seen_;
    std::map<Whose, ChannelGaps> channels_;
    std::map<std::pair<std::string, std::string>, std::unique_ptr<Axis>> axes_;  // by machine and name
    std::map<Whose, analysis::RecordingProcess> processes_;                      // the process that published them
    std::map<std::string, std::string> newest_config_;                           // the file of each machine
    std::map<std::string, std::vector<std::string>> axes_wanted_;                // by machine
    std::set<std::pair<std::string, std::string>> marked_;                       // machines and axes that marks name
    analysis::RecordEndCheck marks_;
    analysis::MotorLabels labels_;
};

}  // namespace lockstep::merge
