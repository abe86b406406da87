// The words of grbl's protocol for the remedies of faults.
#pragma once

#include <string>

#include "core/faults.hpp"

namespace lockstep::grbl {

/// What a sender sends to carry the remedy out.
inline std::string sender_words(Remedy remedy) {
    switch (remedy) {
        case Remedy::Home: return "$H";
        case Remedy::Resume: return "~";
        case Remedy::Stop: return "Ctrl-X";
        case Remedy::Reset: return "$X";
        case Remedy::Status: return "?";
        case Remedy::Wait:
        case Remedy::Again:
        case Remedy::Timing:
        case Remedy::Incident:
        case Remedy::RunRest:
        case Remedy::Take: break;
    }
    return plain_words(remedy);
}

}  // namespace lockstep::grbl
