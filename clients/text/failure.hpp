// Why a command failed: as text on standard error, as JSON in an ErrorReport.
#pragma once

#include <string>
#include <utility>

#include "clients/text/exit_code.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

struct Failure {
    ExitCode exit = kExitFailed;
    std::string file;    // the file with the errors; empty if none
    Diagnostics errors;  // each with the next step for the user
};

inline Failure failed(std::string why) { return {kExitFailed, {}, {{.message = std::move(why)}}}; }
inline Failure bad_input(std::string why) { return {kExitBadInput, {}, {{.message = std::move(why)}}}; }
inline Failure bad_file(std::string file, Diagnostics errors) {
    return {kExitBadInput, std::move(file), std::move(errors)};
}
inline Failure unreachable(std::string why) { return {kExitUnreachable, {}, {{.message = std::move(why)}}}; }

}  // namespace lockstep
