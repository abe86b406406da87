#include "services/record/record_marker.hpp"

#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep {
namespace {

/// Ignores positions and figures, which are published all the time.
bool same_events(const RecordCounts& a, const RecordCounts& b) {
    return a.steps == b.steps && a.runs == b.runs && a.channel_events == b.channel_events &&
           a.job_events == b.job_events && a.program_parts == b.program_parts;
}

}  // namespace

void RecordMarker::note(const std::string& process, Identity incarnation, const RecordCounts& counts, Tick then) {
    if (known_.size() == kMostProcesses) { known_.clear(); }
    const auto [found, is_new] = known_.try_emplace({process, incarnation});
    Known& known = found->second;
    if (is_new) { known = {mark_channel(machine_, process), counts, then, counts, then}; }
    if (!same_events(known.counts, counts)) { known.grown = then; }
    known.counts = counts;
    if (!is_new && !is_due(known, then)) { return; }
    known.marked = counts;
    known.marked_at = then;
    mark(known.channel, process, incarnation, counts, then, false);
}

void RecordMarker::note_end(const std::string& process, Identity incarnation, const RecordCounts& counts, Tick then) {
    known_.erase({process, incarnation});
    mark(mark_channel(machine_, process), process, incarnation, counts, then, true);
}

bool RecordMarker::is_due(const Known& known, Tick then) const {
    const bool has_settled = (then - known.grown).value * tick_ns_ >= kSettled_ns;
    return (then - known.marked_at).value * tick_ns_ >= kPeriod_ns ||
           (has_settled && !same_events(known.counts, known.marked));
}

void RecordMarker::mark(const std::string& channel, const std::string& process, Identity incarnation,
                        const RecordCounts& counts, Tick then, bool ended) {
    const RecordMark mark{.machine = machine_,
                          .witness = writer_,
                          .process = process,
                          .incarnation = incarnation,
                          .counts = counts,
                          .ended = ended};
    sink_.publish(channel, to_lcm(mark, then, tick_ns_));
}

}  // namespace lockstep
