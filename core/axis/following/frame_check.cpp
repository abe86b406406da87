#include "core/axis/following/frame_check.hpp"

#include <span>

namespace lockstep {

FaultCode check_track(const AxisTrack& track, Ticks ticks, bool last, const AxisLimits& limits, MotionPoint& from) {
    if (track.from != from.position) { return FaultCode::FrameDiscontinuous; }
    MotionPoint point = from;
    const std::span<const Piece> body(track.body.begin(), track.body.end());
    if (const FaultCode fault = check_pieces(body, limits, point); fault != FaultCode::None) { return fault; }
    if (total_ticks(body) != ticks || (last && !track.tail.empty())) { return FaultCode::BadProgram; }

    MotionPoint end = point;
    const std::span<const Piece> tail(track.tail.begin(), track.tail.end());
    if (const FaultCode fault = check_pieces(tail, limits, end); fault != FaultCode::None) { return fault; }
    if (!may_rest(end, limits)) { return FaultCode::FrameBeyondLimits; }
    from = point;
    return FaultCode::None;
}

}  // namespace lockstep
