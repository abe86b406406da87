#include "core/axis/state/run_recorder.hpp"

#include <optional>
#include <utility>

#include "core/check.hpp"

namespace lockstep {
namespace {

/// `cut_at`: where the pulses ceased early, in machine coordinates.
void record(const HeldFrame& frame, bool tail, std::optional<std::int64_t> cut_at, const RunRecorder::Run& run,
            ReusedVector<ExecutedTrack>& tracks) {
    ExecutedTrack& r = tracks.renew_back([&](ExecutedTrack&& old) {
        old.commanded_ticks.clear();
        return ExecutedTrack{.epoch = run.epoch,
                             .frame = frame.number,
                             .tail = tail,
                             .start = tail ? frame.end() : frame.start,
                             .from = tail ? frame.body_end() : frame.track.from,
                             .pieces = std::move(old.pieces),
                             .cut = cut_at.has_value(),
                             .zero_count = run.zero_count,
                             .commanded_ticks = std::move(old.commanded_ticks)};
    });
    const auto take = [&r](const auto& pieces) { r.pieces.assign(pieces.begin(), pieces.end()); };
    tail ? take(frame.track.tail) : take(frame.track.body);
    Position end = r.from;
    for (const Piece& piece : r.pieces) { end = end + piece.covered(); }
    r.stop_count = cut_at.value_or(end.count());
}

void record_end(const HeldFrame& frame, const DeviceStatus& device, const RunRecorder::Run& run,
                ReusedVector<ExecutedTrack>& tracks) {
    const bool stopped =
        device.stopped_by_limit || device.stopped_by_trigger || device.stopped_by_host || device.stopped_by_input;
    const std::int64_t here = device.position.count() - run.zero_count;
    const bool in_tail = !frame.last && (!stopped || device.in_tail);
    record(frame, false, stopped && !in_tail ? std::optional(here) : std::nullopt, run, tracks);
    if (in_tail && !frame.track.tail.empty()) {
        record(frame, true, stopped ? std::optional(here) : std::nullopt, run, tracks);
    }
}

}  // namespace

void RunRecorder::take(const DeviceStatus& device, const Run& run, HeldFrames& frames,
                       ReusedVector<ExecutedTrack>& tracks) {
    for (; recorded_ < device.frame; ++recorded_) {
        const FrameNumber k = recorded_ + 1;
        const HeldFrame& frame =
            check_found(frames.find(k), "a frame that the device runs is held until it is recorded");
        if (k < device.frame) {
            record(frame, false, {}, run, tracks);
        } else if (device.finished) {
            record_end(frame, device, run, tracks);
        } else {
            break;
        }
    }
    frames.forget_before(recorded_ + 1);
}

}  // namespace lockstep
