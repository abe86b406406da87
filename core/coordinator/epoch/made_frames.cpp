#include "core/coordinator/epoch/made_frames.hpp"

#include <algorithm>

namespace lockstep {

void MadeFrames::begin(const PathPlace& place, const MotorPositions& at) {
    start_.reset();
    newest_ = 0;
    at_ = at;
    frames_.clear();
    Made begin{.rest = place, .positions = at};
    begin.places.fill(place);
    frames_.push_back(begin);
}

void MadeFrames::add(const Frame& frame, const PathFrame& path, bool has_pulses) {
    const Ticks end = frames_.back().end + path.ticks;
    Made& made = frames_.push_back({.end = end,
                                    .places = path.places,
                                    .rest = path.rest,
                                    .positions = {},
                                    .complete = path.last,
                                    .has_pulses = has_pulses});
    for (std::size_t i = 0; i < at_.size(); ++i) {
        const AxisTrack& track = frame.axes[i];
        for (const Piece& piece : track.body) { at_[i] = at_[i] + piece.covered(); }
        made.positions.append(at_[i]);
        for (const Piece& piece : track.tail) { made.positions[i] = made.positions[i] + piece.covered(); }
        rests_ = std::max(rests_, frame.start + frame.ticks + total_ticks(track.tail));
    }
    newest_ = frame.number;
    if (frames_.size() > kMaxRests) { frames_.pop_front(); }
}

PathPlace MadeFrames::place_at(Tick tick) const {
    if (!start_ || newest_ == 0 || tick <= *start_) { return frames_.front().places.front(); }
    const Ticks into = tick - *start_;
    std::size_t k = frames_.size();
    while (k > 0 && frames_[k - 1].end > into) { --k; }
    if (k == frames_.size()) { return frames_.back().rest; }
    const Made& frame = frames_[k];
    if (k == 0) { return frame.places.front(); }
    const Ticks begin = frames_[k - 1].end;
    const auto parts = static_cast<std::int64_t>(frame.places.size());
    const std::int64_t part = (into - begin).value * parts / (frame.end - begin).value;
    return frame.places[static_cast<std::size_t>(std::clamp<std::int64_t>(part, 0, parts - 1))];
}

EpochEnd MadeFrames::end_behind(FrameNumber number) const {
    const Made& last = frame(number);
    return {.kind = last.complete ? EpochEnd::Kind::Complete : EpochEnd::Kind::Interrupted,
            .ran = number,
            .place = last.rest,
            .positions = last.positions,
            .has_pulses = last.has_pulses};
}

void MadeFrames::list_rests(FrameNumber first, StaticVector<FrameRest, kMaxRests>& rests) const {
    rests.clear();
    for (FrameNumber k = std::max(first, oldest()); k <= newest_; ++k) {
        const Made& made = frame(k);
        rests.append({k, made.rest, made.complete, digest_of(made.positions)});
    }
}

}  // namespace lockstep
