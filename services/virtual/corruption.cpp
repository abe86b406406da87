#include "services/virtual/corruption.hpp"

namespace lockstep {
namespace {

class Alterer {
public:
    explicit Alterer(std::mt19937_64& random) : random_(random) {}

    Alteration operator()(Frame& frame) {
        constexpr std::array kWays{Alteration::FrameEpoch,  Alteration::FrameSequence, Alteration::FrameStart,
                                   Alteration::FrameTicks,  Alteration::FrameFrom,     Alteration::FrameSpeed,
                                   Alteration::FrameAbsurd, Alteration::FrameTravel,   Alteration::FrameAxes,
                                   Alteration::FrameTerm};
        const Alteration way = kWays[index(kWays.size())];
        AxisTrack& track = frame.axes[index(frame.axes.size())];
        Piece& piece = track.body.begin()[index(track.body.size())];
        switch (way) {
            case Alteration::FrameEpoch: frame.epoch += coin() ? 1 + index(3) : random_(); break;
            case Alteration::FrameSequence: frame.number += coin() ? 1 + index(3) : random_(); break;
            case Alteration::FrameStart: frame.start += Ticks{1 + static_cast<std::int64_t>(index(99))}; break;
            case Alteration::FrameTicks: frame.ticks += Ticks{coin() ? -1 : 1}; break;
            case Alteration::FrameFrom: track.from = track.from + Displacement::steps(coin() ? -1 : 1); break;
            case Alteration::FrameSpeed: piece.velocity.raw = std::int64_t{1} << 62; break;
            case Alteration::FrameAbsurd: piece = {{word()}, {word()}, {word()}}; break;
            case Alteration::FrameTravel: track.from = track.from + Displacement::steps(std::int64_t{1} << 40); break;
            case Alteration::FrameAxes: coin() ? frame.axes.pop_back() : frame.axes.push_back(track); break;
            default: frame.term = {random_(), random_()}; break;
        }
        return way;
    }

    Alteration operator()(AxisState& state) {
        constexpr std::array kWays{Alteration::StateAxis, Alteration::StateStamp, Alteration::StateIdentity,
                                   Alteration::StatePosition, Alteration::StateTerm};
        const Alteration way = kWays[index(kWays.size())];
        switch (way) {
            case Alteration::StateAxis:
                state.axis = coin() ? state.axis + 1 : static_cast<std::uint32_t>(random_());
                break;
            case Alteration::StateStamp:
                state.stamp += coin() ? -static_cast<Slot>(1 + index(1000)) : word() / 4;
                break;
            case Alteration::StateIdentity: state.identity = random_(); break;
            case Alteration::StateTerm: state.term = {random_(), random_()}; break;
            default: state.position = state.position + Displacement::steps(1 + static_cast<std::int64_t>(index(1000)));
        }
        return way;
    }

    Alteration operator()(MachineState& state) {
        state.term = {random_(), random_()};
        return Alteration::MachineTerm;
    }

    Alteration operator()(AxisCommand& command) {
        command.term = {random_(), random_()};
        command.sequence += index(1000);
        command.kind = static_cast<AxisCommandKind>(index(3));
        return Alteration::CommandTerm;
    }

    Alteration operator()(Command&) { return Alteration::None; }
    Alteration operator()(ProgramPart&) { return Alteration::None; }
    Alteration operator()(Reply&) { return Alteration::None; }
    Alteration operator()(ClockRequest&) { return Alteration::None; }
    Alteration operator()(ClockReply&) { return Alteration::None; }

private:
    std::size_t index(std::size_t size) { return static_cast<std::size_t>(random_() % size); }
    bool coin() { return random_() % 2 == 0; }
    std::int64_t word() { return static_cast<std::int64_t>(random_()); }

    std::mt19937_64& random_;
};

}  // namespace

std::string_view name_of(Alteration alteration) {
    return pick_name({"none", "frame epoch", "frame number", "frame start", "frame ticks", "frame from", "frame speed",
                      "frame absurd", "frame travel", "frame axes", "frame term", "state axis", "state stamp",
                      "state identity", "state position", "state term", "machine term", "command term"},
                     alteration);
}

Alteration alter(VirtualMessage& message, std::mt19937_64& random) { return std::visit(Alterer(random), message); }

}  // namespace lockstep
