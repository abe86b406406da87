// A directory of a test's own, removed with all that is in it: the same test may run in two programs at once.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "core/check.hpp"

namespace lockstep {

class TemporaryDirectory {
public:
    TemporaryDirectory() {
        std::string name = (std::filesystem::temp_directory_path() / "lockstep-XXXXXX").string();
        check(mkdtemp(name.data()) != nullptr, "a temporary directory can be made");
        path_ = name;
    }
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
    ~TemporaryDirectory() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace lockstep
