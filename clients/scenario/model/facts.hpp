// Results of a scenario: what was observed while it ran, and what the record contains.
#pragma once

#include <expected>
#include <set>
#include <string>
#include <vector>

#include "clients/scenario/model/record_facts.hpp"
#include "idl/proto/report.pb.h"
#include "idl/proto/scenario.pb.h"

namespace lockstep::scenario {

using Check = proto::ScenarioCheck;

inline constexpr const char* kAsObserved = "as observed in the run";  // the source of results that are not on record

inline Check check_of(const std::string& asked, const std::string& found, const std::string& where, bool held) {
    Check check;
    check.set_asked(asked);
    check.set_found(found);
    check.set_where(where);
    check.set_held(held);
    return check;
}

/// An act after which the machine must come to rest.
struct AwaitedRest {
    std::string act;  // as text
    Tick at;          // machine time
    int within_frames = 0;
    std::vector<std::string> axes;  // axes with running processes
};

/// An act after which an output must go off, or keep its level.
struct AwaitedOutput {
    std::string act;  // as text
    Tick at;          // machine time
    proto::Scenario::OutputAfter asked;
};

/// The observations while the scenario ran.
struct Observations {
    std::vector<Check> checks;  // of steps, of acts, of processes
    std::vector<proto::ScenarioHappening> events;
    std::vector<AwaitedRest> rests;
    std::vector<AwaitedOutput> outputs;
    proto::StatusReport status;  // at the end
    std::string broken;          // why the scenario did not run to its end; empty if it did
};

struct FoundCause {
    std::string kind;     // as in incident::CauseKind
    std::string process;  // axis-X, coordinator; empty if none
    std::string text;
};

/// The contents of the record and of the flight recorders. An error says why a report is missing.
struct Evidence {
    std::expected<proto::MergeReport, std::string> merged;
    std::expected<proto::VerifyReport, std::string> verified;
    std::expected<proto::AnalysisReport, std::string> analysis;
    RecordFacts record;
    std::vector<FoundCause> causes;   // of each incident
    std::set<std::string> vetoed_by;  // axes that vetoed because they lacked a frame, a state or time
};

}  // namespace lockstep::scenario
