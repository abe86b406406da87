// A hash of each of many results, kept in a file. So a change of code that should not change results shows that it
// changes none. If it should, write the file again with LOCKSTEP_WRITE_HASHES=1, and say in the commit what changes.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iomanip>
#include <string>
#include <vector>

namespace lockstep {

/// FNV-1a.
inline std::uint32_t hash_of(const std::string& text) {
    std::uint32_t hash = 2'166'136'261;
    for (const char c : text) { hash = (hash ^ static_cast<unsigned char>(c)) * 16'777'619; }
    return hash;
}

/// Compares the results 0 to `count` - 1 with those of the file, whose path is from the project's folder.
inline void expect_recorded(const char* path, std::uint32_t count,
                            const std::function<std::string(std::uint32_t)>& result_of) {
    constexpr std::uint32_t kInALine = 10;
    constexpr std::size_t kShown = 10'000;
    if (std::getenv("LOCKSTEP_WRITE_HASHES") != nullptr) {
        std::ofstream file(path);
        file << std::hex << std::setfill('0');
        for (std::uint32_t k = 0; k < count; ++k) {
            file << std::setw(8) << hash_of(result_of(k)) << ((k + 1) % kInALine == 0 ? '\n' : ' ');
        }
        return;
    }
    std::ifstream file(path);
    for (std::uint32_t k = 0; k < count; ++k) {
        std::uint32_t recorded = 0;
        ASSERT_TRUE(file >> std::hex >> recorded) << path << " has too few hashes";
        const std::string result = result_of(k);
        ASSERT_EQ(hash_of(result), recorded) << "result " << k << " of " << path << " is now\n"
                                             << result.substr(0, kShown);
    }
}

}  // namespace lockstep
