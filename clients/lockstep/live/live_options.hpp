// What is common to the verbs' command lines.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace lockstep {

/// What every verb that speaks to a machine takes.
struct LiveOptions {
    std::string machine_file;
    bool json = false;
};

void add_live_options(CLI::App& verb, LiveOptions& options);

/// Examples, one per line, then the exit codes.
std::string footer(const std::string& examples);

}  // namespace lockstep
