#include "sim_fpga/output_ring.hpp"

#include <variant>

#include "core/step/executable.hpp"
#include "sim_fpga/channel_words.hpp"

namespace lockstep {
namespace {

/// Appends a change that is not before the one before it. Returns false if that is not so, or if there is no room.
bool append(auto& list, const OutputChange& change) {
    const bool in_order = list.empty() || list[list.size() - 1].at <= change.at;
    return in_order && change.at >= Ticks{1} && change.at <= kMaxPieceTicks && list.push_back(change);
}

}  // namespace

bool OutputRing::is_empty() const {
    const std::uint64_t loaded = window_.load(registers::kOutputHead) - tail_;
    return loaded == 0 || loaded > ring_.entries();
}

bool OutputRing::take(std::uint64_t run, FrameNumber frame, OutputTrack& track) {
    track.body.clear();
    track.tail.clear();
    bool is_well = true;
    bool is_found = false;
    while (!is_empty()) {
        const bool of_run = is_of_run(window_, oldest(), run);
        const std::int32_t after = of_run ? frames_after(window_, oldest(), frame) : -1;
        if (after > 0) { break; }
        if (!is_found) { first_ = tail_; }
        if (after == 0) {
            is_found = true;
            is_well = read(track) && is_well;
        }
        ++tail_;
    }
    if (!is_found) { first_ = tail_; }
    if (!is_well) {
        track.body.clear();
        track.tail.clear();
    }
    return is_well;
}

void OutputRing::drop_run(std::uint64_t run) {
    while (!is_empty() && is_of_run(window_, oldest(), run)) { ++tail_; }
}

bool OutputRing::read(OutputTrack& track) const {
    const auto change = load_change(window_, oldest());
    if (!change || !is_possible(*change)) { return false; }
    return is_of_tail(window_, oldest()) ? append(track.tail, *change) : append(track.body, *change);
}

bool OutputRing::is_possible(const OutputChange& change) const {
    if (const auto* digital = std::get_if<SetDigital>(&change.what)) {
        return (digital->mask >> abilities_.digital_outputs) == 0;
    }
    if (const auto* analog = std::get_if<RampAnalog>(&change.what)) {
        return analog->channel < abilities_.analog_outputs;
    }
    return abilities_.can_compare;
}

}  // namespace lockstep
