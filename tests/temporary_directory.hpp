// A directory for one test, removed with its contents at the end. Its name is unique: two programs may run the same
// test.
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
