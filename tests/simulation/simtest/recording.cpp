#include "tests/simulation/simtest/recording.hpp"

#include <algorithm>

namespace lockstep::simtest {
namespace {

/// A piece of n ticks from speed register v with acceleration a covers n v + a n (n + 1) / 2.
Int128 gone(const Piece& piece) {
    const Int128 n = piece.ticks.value;
    return n * piece.velocity.raw + n * (n + 1) / 2 * piece.acceleration.raw;
}

/// A pulse stands for every half passed upwards.
std::int64_t pulses_at(Int128 raw) { return static_cast<std::int64_t>((raw + (Int128{1} << 63)) >> 64); }

Track track_of(const ExecutedTrack& executed, FrameNumber armed) {
    Track track{.epoch = executed.epoch, .frame = executed.frame, .tail = executed.tail, .start = executed.start};
    Int128 at = executed.from.raw;
    for (const Piece& piece : executed.pieces) {
        track.ticks += piece.ticks;
        at += gone(piece);
    }
    track.net_steps = pulses_at(at) - pulses_at(executed.from.raw);
    track.cut = executed.cut;
    track.armed = armed;
    return track;
}

}  // namespace

std::uint64_t Recording::steps() const {
    std::uint64_t sum = 0;
    for (const AxisRecord& axis : axes) { sum += axis.steps.size(); }
    return sum;
}

/// FNV-1a over whole words.
std::uint64_t Recording::hash() const {
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto take = [&hash](std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3U; };
    for (const AxisRecord& axis : axes) {
        take(axis.steps.size());
        for (const StepEdge& step : axis.steps) {
            take(static_cast<std::uint64_t>(step.tick.value) * 2 + (step.direction > 0 ? 1 : 0));
        }
    }
    return hash;
}

void Recorder::on_axis(std::size_t axis, Tick /*now*/, const AxisOutputs& out, AxisNode& node) {
    using Kind = AxisNotice::Kind;
    for (const ExecutedTrack& executed : out.tracks) {
        recording_.axes[axis].tracks.push_back(track_of(executed, armed_[axis]));
    }
    for (const AxisNotice& notice : out.notices) {
        if (notice.kind == Kind::EpochBegun) {
            epoch_[axis] = notice.number;
            armed_[axis] = 0;
        } else if (notice.kind == Kind::FrameRefused || notice.kind == Kind::Fault) {
            recording_.troubles.push_back(recording_.machine.axes[axis].name + ": " +
                                          (notice.kind == Kind::Fault ? "fault " : "frame refused: ") +
                                          std::string(name_of(notice.fault)) + " " + node.trouble());
        }
    }
    for (const DeviceOrder& order : out.orders) {
        const auto* arm = std::get_if<device::Arm>(&order);
        if (arm != nullptr) { armed_[axis] = std::max(armed_[axis], arm->number); }
    }
}

void Recorder::on_coordinator(Tick /*now*/, const CoordinatorOutputs& out) {
    for (const Frame& frame : out.frames) { keep(frame); }
    for (const CoordinatorNotice& notice : out.notices) {
        if (notice.kind == CoordinatorNotice::Kind::Fault) {
            recording_.troubles.push_back("coordinator: fault " + std::string(name_of(notice.fault)));
        }
    }
    if (out.must_quit) { recording_.troubles.push_back("coordinator: another one is heard"); }
}

void Recorder::keep(const Frame& frame) {
    if (std::ranges::find(recording_.writers, frame.coordinator) == recording_.writers.end()) {
        recording_.writers.push_back(frame.coordinator);
    }
    SentFrame sent{frame.start, frame.ticks, frame.last, {}};
    for (const AxisTrack& track : frame.axes) {
        Int128 raw = 0;
        for (const Piece& piece : track.body) { raw += gone(piece); }
        sent.shares.push_back({raw});
    }
    const auto [kept, first] = recording_.frames[frame.epoch].try_emplace(frame.number, sent);
    if (!first && kept->second != sent) {
        recording_.troubles.push_back("coordinator: frame " + std::to_string(frame.number) + " sent in two versions");
    }
}

}  // namespace lockstep::simtest
