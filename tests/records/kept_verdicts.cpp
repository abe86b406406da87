#include "tests/records/kept_verdicts.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

namespace lockstep::records {
namespace {

std::optional<std::filesystem::path> file_of(const std::string& record) {
    const char* const folder = std::getenv("LOCKSTEP_VERDICTS");
    if (folder == nullptr) { return std::nullopt; }
    return std::filesystem::path(folder) / record;
}

ToolVerdicts verdicts_of(const Judgement& judgement) { return std::to_array(judgement.verdict); }

}  // namespace

void keep_verdicts(const std::string& record, const Judgement& judgement) {
    const auto file = file_of(record);
    if (!file) { return; }
    std::filesystem::create_directories(file->parent_path());
    std::ofstream out(*file);
    for (const Verdict verdict : verdicts_of(judgement)) { out << static_cast<int>(verdict) << '\n'; }
}

ToolVerdicts verdicts_about(const std::string& record, const std::function<Judgement()>& judge) {
    if (const auto file = file_of(record)) {
        std::ifstream in(*file);
        ToolVerdicts kept{};
        for (Verdict& verdict : kept) {
            int number = 0;
            in >> number;
            verdict = static_cast<Verdict>(number);
        }
        if (in) { return kept; }
    }
    return verdicts_of(judge());
}

}  // namespace lockstep::records
