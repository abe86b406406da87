#include "clients/scenario/runner/control_groups.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <thread>
#include <vector>

namespace lockstep::scenario {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr std::string_view kName = "lockstep-scenario-";

std::vector<fs::path> folders_in(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (entry.is_directory(error) && !entry.is_symlink(error)) { found.push_back(entry.path()); }
    }
    return found;
}

bool is_left(const std::string& group) {
    if (!group.starts_with(kName)) { return false; }
    std::error_code error;
    return group == own_control_group() || !fs::exists("/proc/" + group.substr(kName.size()), error);
}

/// Searches the single hierarchy of groups, or each one if there are several.
std::vector<fs::path> groups_left() {
    std::vector<fs::path> hierarchies = folders_in("/sys/fs/cgroup");
    hierarchies.emplace_back("/sys/fs/cgroup");
    std::vector<fs::path> left;
    for (const fs::path& hierarchy : hierarchies) {
        std::ranges::copy_if(folders_in(hierarchy), std::back_inserter(left),
                             [](const fs::path& path) { return is_left(path.filename()); });
    }
    return left;
}

/// Removes the inner groups first. The kernel refuses to remove a group that is not empty.
void remove_group(const fs::path& group) {
    for (const fs::path& inner : folders_in(group)) { remove_group(inner); }
    rmdir(group.c_str());
}

}  // namespace

std::string own_control_group() { return std::string(kName) + std::to_string(getpid()); }

void remove_control_groups() {
    constexpr int kTries = 100;  // a killed process takes a moment to end
    for (int tries = 0; tries < kTries; ++tries) {
        const auto left = groups_left();
        if (left.empty()) { return; }
        std::ranges::for_each(left, remove_group);
        std::this_thread::sleep_for(20ms);
    }
}

}  // namespace lockstep::scenario
