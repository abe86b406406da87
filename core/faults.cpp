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

constexpr std::array kRemedies{Remedy::Wait,     Remedy::Home,    Remedy::Resume, Remedy::Stop,
                               Remedy::Reset,    Remedy::Status,  Remedy::Again,  Remedy::Timing,
                               Remedy::Incident, Remedy::RunRest, Remedy::Take};

/// Puts the words in the places of the remedies' names.
std::string with_words(std::string_view by_hand, RemedyWords words) {
    std::string text(by_hand);
    for (const Remedy remedy : kRemedies) {
        const std::string name = words_to_fill_in(remedy);
        const std::size_t at = text.find(name);
        if (at != text.npos) { text.replace(at, name.size(), words(remedy)); }
    }
    return text;
}

}  // namespace

std::string_view name_of(Remedy remedy) {
    switch (remedy) {
        case Remedy::Wait: return "wait";
        case Remedy::Home: return "home";
        case Remedy::Resume: return "resume";
        case Remedy::Stop: return "stop";
        case Remedy::Reset: return "reset";
        case Remedy::Status: return "status";
        case Remedy::Again: return "again";
        case Remedy::Timing: return "timing";
        case Remedy::Incident: return "incident";
        case Remedy::RunRest: return "run-rest";
        case Remedy::Take: break;
    }
    return "take";
}

std::string plain_words(Remedy remedy) {
    switch (remedy) {
        case Remedy::Wait: return "wait until it has ended";
        case Remedy::Home: return "home the axes";
        case Remedy::Resume: return "resume the job";
        case Remedy::Stop: return "stop the job";
        case Remedy::Reset: return "reset the machine";
        case Remedy::Status: return "look at the machine's state";
        case Remedy::Again: return "give the command again";
        case Remedy::Timing: return "measure which ones the hosts need";
        case Remedy::Incident: return "analyze the records of the incident";
        case Remedy::RunRest: return "begin at the line that the machine's state names";
        case Remedy::Take: break;
    }
    return "give the command again as a takeover";
}

std::string words_to_fill_in(Remedy remedy) { return "{" + std::string(name_of(remedy)) + "}"; }

std::string remedy_text(const FaultText& fault, RemedyWords words) {
    std::string text = with_words(fault.by_hand, words);
    if (!text.empty() && fault.remedies.count > 0) { text += "; then: "; }
    for (const Remedy& remedy : fault.remedies.list()) {
        const bool is_first = &remedy == fault.remedies.list().data();
        if (!is_first) { text += fault.remedies.is_choice ? ", or: " : ", "; }
        text += words(remedy);
    }
    return text;
}

FaultText for_board(FaultText fault) {
    if (is_emergency_stop(fault.code)) { return fault; }
    Remedies& remedies = fault.remedies;
    const auto end = remedies.steps.begin() + static_cast<std::ptrdiff_t>(remedies.count);
    remedies.count =
        static_cast<std::size_t>(std::remove(remedies.steps.begin(), end, Remedy::Home) - remedies.steps.begin());
    return fault;
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
