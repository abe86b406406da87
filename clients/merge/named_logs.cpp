#include "clients/merge/named_logs.hpp"

#include <algorithm>

namespace lockstep::merge {

namespace fs = std::filesystem;

std::expected<std::vector<fs::path>, std::string> named_logs(const std::vector<fs::path>& names) {
    std::vector<fs::path> logs;
    for (const fs::path& name : names) {
        std::error_code error;
        if (!fs::is_directory(name, error)) {
            logs.push_back(name);
            continue;
        }
        const std::size_t before = logs.size();
        for (const auto& entry : fs::directory_iterator(name, error)) {
            if (entry.path().extension() == ".lcm") { logs.push_back(entry.path()); }
        }
        if (logs.size() == before) { return std::unexpected(name.string() + ": no file *.lcm is in this directory"); }
        std::sort(logs.begin() + static_cast<std::ptrdiff_t>(before), logs.end());
    }
    return logs;
}

}  // namespace lockstep::merge
