#include "clients/supervisor/edit_machine.hpp"

#include "services/files/text_file.hpp"

namespace lockstep {

std::expected<void, Failure> edit_machine(const std::filesystem::path& named, const EditText& edit) {
    std::error_code error;
    const std::filesystem::path found = std::filesystem::canonical(named, error);
    const std::filesystem::path file = error ? named : found;
    const auto text = read_text_file(file);
    if (!text) { return std::unexpected(bad_file(file.string(), {text.error()})); }
    const auto edited = edit(*text);
    if (!edited) { return std::unexpected(bad_file(file.string(), edited.error())); }
    const auto written = replace_text_file(file, *edited);
    return written ? std::expected<void, Failure>{} : std::unexpected(failed(written.error()));
}

}  // namespace lockstep
