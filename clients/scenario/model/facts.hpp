// What is known of a scenario that was played: as it was seen, and as the record has it.
#pragma once

#include <expected>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "clients/scenario/model/record_facts.hpp"
#include "idl/proto/report.pb.h"
#include "idl/proto/scenario.pb.h"

namespace lockstep::scenario {

using Check = proto::ScenarioCheck;

inline constexpr const char* kAsPlayed = "as it was played";  // where what is not on record was found

inline Check check_of(const std::string& asked, const std::string& found, const std::string& where, bool held) {
    Check check;
    check.set_asked(asked);
    check.set_found(found);
    check.set_where(where);
    check.set_held(held);
    return check;
}

/// After an act the machine was to come to rest.
struct AwaitedRest {
    std::string act;  // in words
    Tick at;          // machine time
    int within_frames = 0;
    std::vector<std::string> axes;  // whose processes ran on
};

/// As it was seen while it was played.
struct Seen {
    std::vector<Check> checks;  // of steps, of acts, of processes
    std::vector<proto::ScenarioHappening> story;
    std::vector<AwaitedRest> rests;
    proto::StatusReport status;  // at the end
    std::string broken;          // why it was not played to its end; empty: it was
};

struct FoundCause {
    std::string kind;     // as in incident::CauseKind
    std::string process;  // axis-X, coordinator; empty: no one's
    std::string text;
};

/// As the record and the processes' own notes have it. Errors: why there is none.
struct Evidence {
    std::expected<proto::MergeReport, std::string> merged;
    std::expected<proto::VerifyReport, std::string> verified;
    std::expected<proto::AnalysisReport, std::string> analysis;
    RecordFacts record;
    std::vector<FoundCause> causes;   // of each incident, but those that were merely asked for
    std::set<std::string> vetoed_by;  // axes, for want of what they needed
};

}  // namespace lockstep::scenario
