// The input is a sender's settings, a byte 0, and a machine's file. The result is a machine's file with these values,
// or errors.
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "services/documents/edit/kept_settings.hpp"
#include "services/documents/machine_file.hpp"
#include "tests/fuzz/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace lockstep;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const std::size_t middle = std::min(bytes.find('\0'), bytes.size());
    const auto settings = settings_from_text(bytes.substr(0, middle));
    if (!settings) {
        require(!settings.error().empty() && settings.error()[0].line >= 1, "a refusal has a line");
        return 0;
    }
    const auto edited = with_settings(bytes.substr(std::min(middle + 1, bytes.size())), *settings);
    if (!edited) {
        require(!edited.error().empty() && !edited.error()[0].message.empty(), "a refusal has a text");
        return 0;
    }
    const auto again = with_settings(*edited, *settings);
    require(again.has_value() && *again == *edited, "settings that are in the file already change nothing");
    return 0;
}
