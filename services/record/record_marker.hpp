// Writes into one process's record how many messages each process has published, including itself. So the logs of the
// other processes show which messages a log lacks at its end, or that a log is missing.
//
// It writes a mark of a process when the process is new, every kPeriod_ns, when its counts of motion, changes of inputs
// and outputs, and jobs have not grown for kSettled_ns, and at its end.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "core/machine.hpp"
#include "core/protocol/messages.hpp"
#include "services/record/record_sink.hpp"

namespace lockstep {

class RecordMarker {
public:
    static constexpr std::int64_t kPeriod_ns = 1'000'000'000;
    static constexpr std::int64_t kSettled_ns = 100'000'000;
    static constexpr std::size_t kMostProcesses = 1024;  // at this number all are forgotten and marked again

    /// `writer` is the axis that writes, empty for a coordinator. `sink` must outlive this object.
    RecordMarker(const MachineConfig& machine, std::string writer, RecordSink& sink)
        : machine_(machine.name), writer_(std::move(writer)), tick_ns_(machine.tick_ns), sink_(sink) {}

    /// Notes the published counts of a process at machine time `then`. `process` is an axis, empty for a coordinator.
    void note(const std::string& process, Identity incarnation, const RecordCounts& counts, Tick then);
    /// Notes the final counts of a process that publishes nothing more.
    void note_end(const std::string& process, Identity incarnation, const RecordCounts& counts, Tick then);

private:
    struct Known {
        std::string channel;
        RecordCounts counts;
        Tick grown;  // when the counts other than positions and figures last grew
        RecordCounts marked;
        Tick marked_at;
    };

    bool is_due(const Known& known, Tick then) const;
    void mark(const std::string& channel, const std::string& process, Identity incarnation, const RecordCounts& counts,
              Tick then, bool ended);

    std::string machine_;
    std::string writer_;
    std::int64_t tick_ns_;
    RecordSink& sink_;
    std::map<std::pair<std::string, Identity>, Known> known_;
};

}  // namespace lockstep
