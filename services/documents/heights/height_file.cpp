#include "services/documents/heights/height_file.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/parse_number.hpp"
#include "services/documents/text/trimmed.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

constexpr double kFarthest_mm = 1e6;

std::optional<HeightPoint> point_of(std::string_view line) {
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t comma = line.find(',');
        const bool is_last = i + 1 == values.size();
        if (is_last != (comma == line.npos)) { return std::nullopt; }
        const auto value = parse_number<double>(trimmed(line.substr(0, comma)));
        if (!value || !(std::abs(*value) <= kFarthest_mm)) { return std::nullopt; }
        values[i] = *value;
        line.remove_prefix(is_last ? line.size() : comma + 1);
    }
    return HeightPoint{values[0], values[1], values[2]};
}

}  // namespace

std::expected<HeightMap, Diagnostics> parse_height_map(std::string_view text) {
    std::vector<HeightPoint> points;
    int number = 0;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(end == text.npos ? text.size() : end + 1);
        if (++number == 1 && line == kHeightColumns) { continue; }
        if (line.empty()) { continue; }
        const auto point = point_of(line);
        if (!point) {
            return std::unexpected(Diagnostics{
                {number, 1, "this is not a point: write x_mm,y_mm,z_mm as three numbers of at most 1000000 mm"}});
        }
        points.push_back(*point);
    }
    auto map = HeightMap::make(points);
    if (!map) { return std::unexpected(Diagnostics{{.message = map.error().text()}}); }
    return *std::move(map);
}

std::expected<HeightMap, Diagnostics> load_height_map(const std::filesystem::path& path) {
    const auto text = read_text_file(path);
    if (!text) { return std::unexpected(Diagnostics{text.error()}); }
    return parse_height_map(*text);
}

}  // namespace lockstep
