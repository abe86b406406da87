#include "services/files/diagnostic.hpp"

#include <fmt/format.h>

namespace lockstep {

std::string to_text(const std::string& file, const Diagnostic& diagnostic) {
    std::string place = file;
    if (diagnostic.line > 0) { place += fmt::format(":{}:{}", diagnostic.line, diagnostic.column); }
    return place + ": error: " + diagnostic.message;
}

std::string to_text(const std::string& file, const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) { text += to_text(file, diagnostic) + "\n"; }
    return text;
}

}  // namespace lockstep
