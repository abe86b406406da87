// An error in a file that a person wrote, in the format that editors and compilers use.
#pragma once

#include <string>
#include <vector>

namespace lockstep {

struct Diagnostic {
    int line = 0;    // from 1; 0: the whole file
    int column = 0;  // from 1
    std::string message;
};

using Diagnostics = std::vector<Diagnostic>;

/// "file:line:column: error: message", or "file: error: message".
std::string to_text(const std::string& file, const Diagnostic& diagnostic);

/// One line for each diagnostic.
std::string to_text(const std::string& file, const Diagnostics& diagnostics);

}  // namespace lockstep
