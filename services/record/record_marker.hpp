// Writes into one process's record how much of the record each process has published, itself included: so the logs of
// the other processes show what a log lacks at its end, or that it is missing altogether.
//
// A mark is written at once for a new process, then every kPeriod, as soon as its counts of motion and jobs have not
// grown for kSettled, and at its end.
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
    static constexpr std::size_t kMostProcesses = 1024;  // beyond it all are marked again

    /// `writer` is the axis that writes, empty for a coordinator. `sink` outlives this object.
    RecordMarker(const MachineConfig& machine, std::string writer, RecordSink& sink)
        : machine_(machine.name), writer_(std::move(writer)), tick_ns_(machine.tick_ns), sink_(sink) {}

    /// The published counts of a process at `then`, machine time. `process` is an axis, empty for a coordinator.
    void note(const std::string& process, Identity incarnation, const RecordCounts& counts, Tick then);
    /// The same, and the process publishes nothing more.
    void note_end(const std::string& process, Identity incarnation, const RecordCounts& counts, Tick then);

private:
    struct Known {
        std::string channel;
        RecordCounts counts;
        Tick grown;  // when the counts of motion and jobs last grew
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
