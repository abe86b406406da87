#include "services/axis/axis_notices.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

#include "services/runtime/log.hpp"

namespace lockstep {
namespace {

std::string remedy(FaultCode fault) {
    const FaultText* text = find_fault(fault);
    return text == nullptr ? std::string() : std::string(text->cause) + "; " + remedy_text(*text);
}

std::string what_of(const AxisNotice& fault) {
    return fault.fault == FaultCode::FollowingError ? fmt::format("{} steps differ: ", fault.number) : "";
}

}  // namespace

void log_notice(const AxisNotice& notice) {
    using Kind = AxisNotice::Kind;
    switch (notice.kind) {
        case Kind::PositionProved: return log_info("homed: the device is at the kept position");
        case Kind::PositionUnproved:
            return log_event(spdlog::level::info, notice.fault, "not homed: " + remedy(notice.fault));
        case Kind::OwnerAdopted: return log_info("follows the owner of term {}", notice.number);
        case Kind::EpochBegun: return log_info("epoch {} begun", notice.number);
        case Kind::EpochEnded: return log_info("epoch {} ended, at rest", notice.number);
        case Kind::FrameRefused:
            return log_event(spdlog::level::err, notice.fault, "frame {} refused: {}", notice.number,
                             remedy(notice.fault));
        case Kind::Vetoed: return log_info("frame {} and those after it are vetoed", notice.number);
        case Kind::Touched: return log_info("the probe touched at tick {}", notice.number);
        case Kind::StepsCorrected: return log_warning("{} steps were lost; makes them up", notice.number);
        case Kind::HomingStage: return log_info("homing: {}", name_of(static_cast<HomingStage>(notice.number)));
        case Kind::Homed: return log_info("homed and parked");
        case Kind::Fault: return log_event(spdlog::level::err, notice.fault, what_of(notice) + remedy(notice.fault));
        case Kind::Reset: return log_info("reset");
        case Kind::CommandRefused:
            return log_event(spdlog::level::warn, notice.fault, "command refused: " + remedy(notice.fault));
    }
}

}  // namespace lockstep
