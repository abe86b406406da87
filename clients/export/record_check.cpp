#include "clients/export/record_check.hpp"

#include "services/documents/machine_file.hpp"

namespace lockstep::exporting {
namespace {

std::string name_of(RecordKind kind) {
    switch (kind) {
        case RecordKind::Steps: return "steps";
        case RecordKind::Run: return "runs";
        case RecordKind::Position: return "positions";
        case RecordKind::Health: return "figures";
        case RecordKind::Channels: return analysis::kChannelChanges;
        case RecordKind::Job: return "jobs";
        default: return "programs";
    }
}

}  // namespace

void RecordCheck::saw(RecordKind kind, const analysis::RecordingProcess& process, std::int64_t sequence) {
    seen_[{process, numbered_with(kind)}].add(sequence);
    end_.saw(kind, process.machine, process.axis, process.incarnation, sequence);
}

void RecordCheck::take_machine(const std::string& config) {
    if (config.empty() || config == config_) { return; }
    config_ = config;
    if (const auto machine = parse_machine(config)) { labels_.add(Kinematics(*machine)); }
}

analysis::RecordState RecordCheck::finish() {
    analysis::RecordEnd end = end_.finish();
    end.labels = labels_;
    analysis::RecordState state{.missing = missing_sentences(end), .not_known = open_sentences(end)};
    for (const auto& [whose, numbers] : seen_) {
        const auto& [process, kind] = whose;
        const std::string name = process.axis.empty() ? "coordinator" : labels_.of(process.axis);
        if (const std::int64_t missing = numbers.missing_within(); missing > 0) {
            state.missing.push_back(analysis::missing_between(name, missing, name_of(kind)));
        }
    }
    return state;
}

}  // namespace lockstep::exporting
