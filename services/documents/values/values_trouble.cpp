#include "services/documents/values/values_trouble.hpp"

#include "services/documents/values/values_document.hpp"
#include "services/files/directories.hpp"

namespace lockstep {

std::optional<std::string> values_file_trouble(const std::string& machine) {
    const auto file = values_file(machine);
    const auto values = read_values(file);
    if (values) { return std::nullopt; }
    return "the coordinator cannot start on this host, because the machine's offsets and tools cannot be read:\n" +
           to_text(file.string(), values.error()) + "correct the file, or remove it to begin without offsets and tools";
}

}  // namespace lockstep
