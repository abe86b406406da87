// Enumerations of core whose values have the numbers of those of the machine's file.
#pragma once

#include <cstddef>

#include "core/enumeration.hpp"
#include "core/machine.hpp"
#include "services/documents/machine_proto.hpp"

namespace lockstep {

/// Whether the file's value and core's have the same number.
constexpr bool has_number_of(auto ours, auto of_file) { return static_cast<int>(ours) == static_cast<int>(of_file); }

static_assert(kCountOf<StepMethod> == proto::Method_ARRAYSIZE);
static_assert(has_number_of(StepMethod::Ranade, proto::RANADE) &&
              has_number_of(StepMethod::Spielauer, proto::SPIELAUER) && has_number_of(StepMethod::Lai, proto::LAI) &&
              has_number_of(StepMethod::Lam, proto::LAM) && has_number_of(StepMethod::Carrica, proto::CARRICA));

static_assert(kCountOf<TimeSource> == proto::TimeSource_ARRAYSIZE);
static_assert(has_number_of(TimeSource::Shared, proto::SHARED) && has_number_of(TimeSource::Network, proto::NETWORK) &&
              has_number_of(TimeSource::Ptp, proto::PTP));

static_assert(kCountOf<TouchInMotion> == proto::TouchInMotion_ARRAYSIZE);
static_assert(has_number_of(TouchInMotion::Nothing, proto::NOTHING) &&
              has_number_of(TouchInMotion::Hold, proto::HOLD) && has_number_of(TouchInMotion::Fault, proto::FAULT));

static_assert(kCountOf<InputUse> == proto::InputUse_ARRAYSIZE);
static_assert(has_number_of(InputUse::EmergencyStop, proto::EMERGENCY_STOP) &&
              has_number_of(InputUse::Door, proto::DOOR) && has_number_of(InputUse::Program, proto::PROGRAM) &&
              has_number_of(InputUse::Probe, proto::PROBE) && has_number_of(InputUse::Home, proto::HOME) &&
              has_number_of(InputUse::LimitMin, proto::LIMIT_MIN) &&
              has_number_of(InputUse::LimitMax, proto::LIMIT_MAX));

static_assert(kCountOf<OutputUse> == proto::OutputUse_ARRAYSIZE);
#define X(use, key, has_number, may_be_analog) static_assert(has_number_of(OutputUse::use, proto::key));
LOCKSTEP_OUTPUT_USES(X)
#undef X

/// The value in core. Protobuf accepts any number for an enumeration: the first value if it has none of this number.
template <typename Enum>
constexpr Enum value_of(auto of_file) {
    const auto number = static_cast<std::size_t>(of_file);
    return number < kCountOf<Enum> ? static_cast<Enum>(number) : Enum{};
}

}  // namespace lockstep
