// The shell's words for the remedies of faults and refusals.
#pragma once

#include <string>

#include "core/faults.hpp"

namespace lockstep {

/// The command that carries the remedy out. core/make_fault_reference.py reads this table, too.
inline std::string shell_words(Remedy remedy) {
    switch (remedy) {
        case Remedy::Home: return "lockstep home";
        case Remedy::Resume: return "lockstep resume";
        case Remedy::Stop: return "lockstep stop";
        case Remedy::Reset: return "lockstep reset";
        case Remedy::Status: return "lockstep status";
        case Remedy::Timing: return "lockstep doctor --timing";
        case Remedy::Incident: return "lockstep analyze --incident";
        case Remedy::RunRest: return "lockstep run FILE --from-line LINE, with the line that lockstep status names";
        case Remedy::Take: return "give the command again with --take";
        case Remedy::Wait:
        case Remedy::Again: break;
    }
    return plain_words(remedy);
}

}  // namespace lockstep
