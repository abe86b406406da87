#include "clients/merge/named_logs.hpp"

#include <algorithm>

#include "services/files/access.hpp"

namespace lockstep::merge {

namespace fs = std::filesystem;

std::expected<std::vector<GivenLog>, std::string> named_logs(const std::vector<fs::path>& names) {
    std::vector<GivenLog> logs;
    for (const fs::path& name : names) {
        std::error_code error;
        if (!fs::is_directory(name, error)) {
            logs.push_back({name, true});
            continue;
        }
        const std::size_t before = logs.size();
        for (const auto& entry : fs::directory_iterator(name, error)) {
            if (entry.path().extension() == ".lcm") { logs.push_back({entry.path(), false}); }
        }
        if (error) { return std::unexpected(name.string() + ": " + why_not_read(name, error.value())); }
        if (logs.size() == before) { return std::unexpected(name.string() + ": no file *.lcm is in this directory"); }
        std::ranges::sort(logs.begin() + static_cast<std::ptrdiff_t>(before), logs.end(), {}, &GivenLog::path);
    }
    return logs;
}

}  // namespace lockstep::merge
