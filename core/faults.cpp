#include "core/faults.hpp"

#include <algorithm>
#include <array>

namespace lockstep {
namespace {

constexpr std::array kFaults{
#define X(name, number, text, cause, remedy) FaultText{FaultCode::name, text, cause, remedy},
    LOCKSTEP_FAULTS(X)
#undef X
};

}  // namespace

const FaultText* find_fault(FaultCode code) {
    const auto* found =
        std::find_if(kFaults.begin(), kFaults.end(), [&](const FaultText& f) { return f.code == code; });
    return found == kFaults.end() ? nullptr : found;
}

const FaultText* find_fault(std::string_view name) {
    const auto* found =
        std::find_if(kFaults.begin(), kFaults.end(), [&](const FaultText& f) { return f.name == name; });
    return found == kFaults.end() ? nullptr : found;
}

std::string_view name_of(FaultCode code) {
    if (code == FaultCode::None) { return "none"; }
    const FaultText* text = find_fault(code);
    return text == nullptr ? "unknown" : text->name;
}

}  // namespace lockstep
