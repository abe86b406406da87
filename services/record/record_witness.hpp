// Writes into one process's record how much of the record each process has published, itself included: so the logs of
// the others show what a log lacks at its end, or that it is missing altogether.
//
// A mark is written at once for a process seen for the first time, then every kPeriod, as soon as what it published of
// motion and jobs has not grown for kSettled, and at its end.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "core/machine.hpp"
#include "core/protocol/messages.hpp"
#include "services/record/record_sink.hpp"

namespace lockstep {

class RecordWitness {
public:
    static constexpr std::int64_t kPeriod_ns = 1'000'000'000;
    static constexpr std::int64_t kSettled_ns = 100'000'000;
    static constexpr std::size_t kMostProcesses = 1024;  // beyond it all are marked anew

    /// `witness` is the axis that writes, empty for a coordinator. `sink` outlives this object.
    RecordWitness(const MachineConfig& machine, std::string witness, RecordSink& sink)
        : machine_(machine.name), witness_(std::move(witness)), tick_ns_(machine.tick_ns), sink_(sink) {}

    /// A process had published so much at `then`, machine time. `process` is an axis, empty for a coordinator.
    void note(const std::string& process, Identity incarnation, const RecordCounts& counts, Tick then);
    /// The same, and it publishes nothing more.
    void note_end(const std::string& process, Identity incarnation, const RecordCounts& counts, Tick then);

private:
    struct Known {
        RecordCounts counts;
        Tick grown;  // when the counts of motion and jobs last grew
        RecordCounts marked;
        Tick marked_at;
    };

    bool is_due(const Known& known, Tick then) const;
    void mark(const std::string& process, Identity incarnation, const RecordCounts& counts, Tick then, bool ended);

    std::string machine_;
    std::string witness_;
    std::int64_t tick_ns_;
    RecordSink& sink_;
    std::map<std::pair<std::string, Identity>, Known> known_;
};

}  // namespace lockstep
