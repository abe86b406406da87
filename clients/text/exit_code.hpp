// The command's exit codes for a script; documented in --help.
#pragma once

namespace lockstep {

enum ExitCode : int {
    kExitDone = 0,
    kExitFailed = 1,       // it was tried and did not succeed: a refusal, a fault, a log that is not exact
    kExitBadInput = 2,     // bad usage, or a file that cannot be read or understood: nothing was done
    kExitUnreachable = 3,  // no coordinator of that machine answers
};

}  // namespace lockstep
