#include "clients/lockstep/height_option.hpp"

#include <memory>

#include "services/documents/heights/height_file.hpp"

namespace lockstep {

Argument add_height_map(Verb verb, std::string& file) {
    return verb.add_option("--height-map", file,
                           "bend the program to the surface of this file: x_mm,y_mm,z_mm of each point of a grid, in "
                           "machine coordinates, as lockstep probe surface writes it. Z is unchanged at the point with "
                           "the least X and Y: set Z0 there");
}

std::expected<void, Failure> read_heights(const std::string& file, GcodeSwitches& switches) {
    if (file.empty()) { return {}; }
    auto map = load_height_map(file);
    if (!map) { return std::unexpected(bad_file(file, map.error())); }
    switches.heights = std::make_shared<const HeightMap>(*std::move(map));
    return {};
}

}  // namespace lockstep
