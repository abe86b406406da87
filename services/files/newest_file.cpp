#include "services/files/newest_file.hpp"

#include "services/files/text_file.hpp"

namespace lockstep {

void NumberedText::write(std::uint64_t number, const std::string& text) {
    std::error_code ignored;  // the folder may have been removed, or its disk mounted later
    std::filesystem::create_directories(path_.parent_path(), ignored);
    const auto written = replace_text_file(path_, text);
    if (written) { kept_ = number; }
    if (!written && !failed_) { on_failure_(written.error()); }
    failed_ = !written;
}

}  // namespace lockstep
