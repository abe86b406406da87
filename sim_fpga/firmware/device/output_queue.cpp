#include "sim_fpga/firmware/device/output_queue.hpp"

namespace lockstep::firmware {

using namespace registers;

namespace {

constexpr Ring kChanges{kOutputRing, kOutputRoom, kOutputRingEntryBytes};

/// Appends a change that is not before the one before it. Returns false if that is not so, or if there is no room.
template <std::size_t Most>
bool append(ChangeList<Most>& list, const OutputChange& change) {
    const bool is_in_order = list.size == 0 || list.changes[list.size - 1].at <= change.at;
    if (!is_in_order || change.at < 1 || change.at > kLongestPiece || list.size == list.kRoom) { return false; }
    list.changes[list.size++] = change;
    return true;
}

/// By how many frames the entry's is after this one; below 0: before it. Only low bits are compared.
std::int32_t frames_after(std::uint64_t tag, std::uint64_t frame) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(kOutputRingTagFrame.of(tag) - frame));
}

}  // namespace

bool OutputQueue::is_empty() const {
    const std::uint64_t loaded = words_.load(kOutputHead) - tail_;
    return loaded == 0 || loaded > kOutputRoom;
}

std::uint64_t OutputQueue::oldest_tag() const { return words_.load(kChanges.entry(tail_) + kOutputRingTag); }

bool OutputQueue::take(std::uint64_t run, std::uint64_t frame, OutputTrack& track) {
    track.clear();
    bool is_well = true;
    while (!is_empty()) {
        const std::uint64_t tag = oldest_tag();
        const std::int32_t after = kOutputRingTagRun.shows(tag, run) ? frames_after(tag, frame) : -1;
        if (after > 0) { break; }
        if (after == 0) { is_well = read(track) && is_well; }
        ++tail_;
    }
    if (!is_well) { track.clear(); }
    return is_well;
}

void OutputQueue::drop_run(std::uint64_t run) {
    while (!is_empty() && kOutputRingTagRun.shows(oldest_tag(), run)) { ++tail_; }
}

bool OutputQueue::read(OutputTrack& track) const {
    const std::size_t at = kChanges.entry(tail_);
    const std::uint64_t tag = words_.load(at + kOutputRingTag);
    const OutputChange change{.at = static_cast<std::int64_t>(words_.load(at + kOutputRingAt)),
                              .kind = static_cast<ChangeKind>(kOutputRingTagKind.of(tag)),
                              .channel = static_cast<std::uint8_t>(kOutputRingTagChannel.of(tag)),
                              .value = words_.load(at + kOutputRingValue),
                              .slope = words_.load(at + kOutputRingSlope)};
    if (!is_possible(change)) { return false; }
    return (tag & kOutputRingTagTail) != 0 ? append(track.tail, change) : append(track.body, change);
}

bool OutputQueue::is_possible(const OutputChange& change) const {
    switch (change.kind) {
        case ChangeKind::Digital: return change.mask() >> abilities_.digital_outputs == 0;
        case ChangeKind::Analog: return change.channel < abilities_.analog_outputs;
        case ChangeKind::Compare: return abilities_.can_compare;
    }
    return false;
}

}  // namespace lockstep::firmware
