#include "core/faults.hpp"

#include <algorithm>
#include <array>

namespace lockstep {
namespace {

constexpr std::array kFaults{
#define X(name, number, text, cause, by_hand, remedies) FaultText{FaultCode::name, text, cause, by_hand, remedies},
    LOCKSTEP_FAULTS(X)
#undef X
};

std::string_view text_of(Remedy remedy) {
    switch (remedy) {
        case Remedy::Wait: return "wait until it has ended";
        case Remedy::Home: return "lockstep home";
        case Remedy::Resume: return "lockstep resume";
        case Remedy::Stop: return "lockstep stop";
        case Remedy::Reset: return "lockstep reset";
        case Remedy::Status: return "lockstep status";
        case Remedy::Again: break;
    }
    return "give the command again";
}

}  // namespace

std::string remedy_text(const FaultText& fault) {
    std::string text(fault.by_hand);
    if (!text.empty() && fault.remedies.count > 0) { text += "; then: "; }
    for (const Remedy& remedy : fault.remedies.list()) {
        const bool is_first = &remedy == fault.remedies.list().data();
        if (!is_first) { text += fault.remedies.is_choice ? ", or: " : ", "; }
        text += text_of(remedy);
    }
    return text;
}

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
